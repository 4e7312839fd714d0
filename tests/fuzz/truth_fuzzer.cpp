// Any bytes as truth.json.

#include "fuzz_file.hpp"
#include "tcm_icp/evaluation/truth.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tcm_icp;
  const fuzz::FuzzFile file({reinterpret_cast<const char*>(data), size}, ".json");
  try {
    for (const auto& scan : read_truth(file.path()).scans) {
      fuzz::require(scan.T_world_scan.matrix().allFinite(), "poses are finite");
    }
  } catch (const Error&) {
    // refused: as good
  }
  return 0;
}
