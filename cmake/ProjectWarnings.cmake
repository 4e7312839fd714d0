# Flags only our own targets see: linked as $<BUILD_INTERFACE:tcm_icp_dev_flags>, so they are never exported.
add_library(tcm_icp_dev_flags INTERFACE)
target_compile_options(tcm_icp_dev_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wextra-semi
  # False alarms of g++ 12 on Eigen's allocations and std::string's appends.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-alloc-size-larger-than> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  # The same bits on every machine: no fused multiply-add that only some processors have.
  -ffp-contract=off)
if(TCM_ICP_WARNINGS_AS_ERRORS)
  target_compile_options(tcm_icp_dev_flags INTERFACE -Werror)
endif()
if(TCM_ICP_SANITIZE)
  target_compile_options(tcm_icp_dev_flags INTERFACE
    -fsanitize=${TCM_ICP_SANITIZE} -fno-omit-frame-pointer
    # Undefined behaviour ends the test instead of printing a line that nobody reads.
    -fno-sanitize-recover=all)
  target_link_options(tcm_icp_dev_flags INTERFACE -fsanitize=${TCM_ICP_SANITIZE})
endif()
