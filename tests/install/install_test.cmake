# Installs the build into an empty prefix, then configures, builds and runs the consumer against that prefix alone.
# Run by ctest with the variables tests/install/CMakeLists.txt sets; a failing step ends the script and the test.
cmake_minimum_required(VERSION 3.25)

set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
foreach(cgal_first OFF ON)
  set(consumer_build ${WORK_DIR}/build_cgal_first_${cgal_first})
  # A warning of the package file would meet every user: it is an error here.
  run(${CMAKE_COMMAND} -Werror=dev -S ${CONSUMER_DIR} -B ${consumer_build} -G ${GENERATOR} -D CGAL_FIRST=${cgal_first}
      -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D CMAKE_CXX_COMPILER=${CXX_COMPILER})
  run(${CMAKE_COMMAND} --build ${consumer_build})
  run(${consumer_build}/consumer)
endforeach()

# The examples, as one outside the repository would build them; each registers what it is made for.
set(examples_build ${WORK_DIR}/build_examples)
run(${CMAKE_COMMAND} -Werror=dev -S ${EXAMPLES_DIR} -B ${examples_build} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D CMAKE_CXX_COMPILER=${CXX_COMPILER})
run(${CMAKE_COMMAND} --build ${examples_build})
file(GLOB town ${TOWN_DIR}/*.ply)
list(SORT town)
run(${examples_build}/register_files ${WORK_DIR}/registered ${TOWN_DIR})
run(${examples_build}/register_clouds ${town})
run(${examples_build}/progress_and_links ${town})
run(${examples_build}/own_reader)
if(NOT EXISTS ${WORK_DIR}/registered/report.html)
  message(FATAL_ERROR "register_files wrote no report")
endif()

set(expected share/doc/tcm_icp/LICENSE)
if(WITH_APP)
  run(${prefix}/bin/tcm-icp --version)
  list(APPEND expected share/man/man1/tcm-icp.1 share/bash-completion/completions/tcm-icp share/zsh/site-functions/_tcm-icp
       share/fish/vendor_completions.d/tcm-icp.fish)
endif()
foreach(file IN LISTS expected)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()

# A path of the machine that built it would break the package on every other one.
file(GLOB package_files ${prefix}/lib*/cmake/tcm_icp/*.cmake ${prefix}/lib/*/cmake/tcm_icp/*.cmake)
if(NOT package_files)
  message(FATAL_ERROR "no CMake package was installed")
endif()
foreach(file IN LISTS package_files)
  file(READ ${file} text)
  string(FIND "${text}" "${BUILD_DIR}" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${file} names the build folder")
  endif()
endforeach()
