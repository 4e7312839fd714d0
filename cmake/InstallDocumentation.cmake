# What belongs beside the binaries: licence, notes on the parts they are linked with, change log, man page, completions.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT documentation)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/third_party_notes ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT documentation)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/manual COMPONENT documentation
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.csv" PATTERN "results" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/datasets/town DESTINATION ${CMAKE_INSTALL_DOCDIR}/datasets COMPONENT documentation)
if(TCM_ICP_BUILD_APP)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/man/tcm-icp.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
endif()
# Where the shells look for completions.
if(TCM_ICP_BUILD_APP)
  set(completions ${PROJECT_SOURCE_DIR}/app/completions)
  install(FILES ${completions}/tcm-icp.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME tcm-icp
          COMPONENT program)
  install(FILES ${completions}/_tcm-icp DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
  install(FILES ${completions}/tcm-icp.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
          COMPONENT program)
endif()
