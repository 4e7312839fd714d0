# The commit that is built, for --version: TCM_ICP_COMMIT, "unknown" outside a repository. Configuring runs again after each
# commit. Packagers without a repository give -D TCM_ICP_BUILD_COMMIT=....
set(TCM_ICP_BUILD_COMMIT "" CACHE STRING "Commit that --version says; empty: asked of git")
set(TCM_ICP_COMMIT "${TCM_ICP_BUILD_COMMIT}")
if(NOT TCM_ICP_COMMIT)
  set(TCM_ICP_COMMIT unknown)
  find_program(GIT_PROGRAM git)
  if(GIT_PROGRAM)
    execute_process(COMMAND ${GIT_PROGRAM} describe --always --abbrev=10 --dirty=+ --exclude=*
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} RESULT_VARIABLE failed OUTPUT_VARIABLE described ERROR_QUIET
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    execute_process(COMMAND ${GIT_PROGRAM} rev-parse --git-path logs/HEAD WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                    OUTPUT_VARIABLE log ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT failed)
      set(TCM_ICP_COMMIT "${described}")
      cmake_path(ABSOLUTE_PATH log BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      if(EXISTS ${log})
        set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${log})
      endif()
    endif()
  endif()
endif()
configure_file(${PROJECT_SOURCE_DIR}/lib/src/core/build_commit.hpp.in ${PROJECT_BINARY_DIR}/lib/build_commit.hpp @ONLY)
