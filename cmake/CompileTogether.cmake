# Most of a source's compile time is headers: several sources of a folder in one translation unit cost half as much.
# Turned off, each source is compiled by itself, which shows what it forgot to include.
option(TCM_ICP_UNITY "Compile several sources of a folder together" ON)

# compile_together(TARGET SIZE): up to SIZE sources of a folder in one translation unit. Called when all are listed.
function(compile_together target size)
  if(NOT TCM_ICP_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Said of classes in headers, for which it takes the sources.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    math(EXPR unit "0${num_in_${folder}} / ${size}")
    math(EXPR num_in_${folder} "0${num_in_${folder}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${target}_${folder}_${unit})
  endforeach()
endfunction()
