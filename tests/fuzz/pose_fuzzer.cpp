// Any bytes as poses.json, and as the file of --init.

#include "fuzz_file.hpp"
#include "tcm_icp/io/pose_io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tcm_icp;
  const fuzz::FuzzFile file({reinterpret_cast<const char*>(data), size}, ".json");
  try {
    for (const auto& scan : read_pose_file(file.path()).scans) {
      fuzz::require(scan.T_reference_scan.matrix().allFinite(), "poses are finite");
    }
  } catch (const Error&) {
    // refused: as good
  }
  try {
    for (const auto& pose : read_initial_poses(file.path(), {"a.ply", "b.ply"})) {
      fuzz::require(!pose || pose->matrix().allFinite(), "initial poses are finite");
    }
  } catch (const Error&) {
    // refused: as good
  }
  return 0;
}
