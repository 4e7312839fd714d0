# What belongs beside the binaries: licence, notes on the parts they are linked with, change log, man page.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/third_party_notes DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TCM_ICP_BUILD_APP)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/man/tcm-icp.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
