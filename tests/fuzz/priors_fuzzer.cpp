// Any bytes as the file of --init, for the standard deviations in it.

#include <cmath>

#include "fuzz_file.hpp"
#include "tcm_icp/io/pose_io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tcm_icp;
  const fuzz::FuzzFile file({reinterpret_cast<const char*>(data), size}, ".json");
  try {
    for (const auto& sigmas : read_initial_sigmas(file.path(), {"a.ply", "b.ply"})) {
      if (!sigmas) continue;
      fuzz::require(std::isfinite(sigmas->position_m) && sigmas->position_m > 0, "positions have weights");
      fuzz::require(std::isfinite(sigmas->rotation_rad) && sigmas->rotation_rad > 0, "rotations have weights");
    }
  } catch (const Error&) {
    // refused: as good
  }
  return 0;
}
