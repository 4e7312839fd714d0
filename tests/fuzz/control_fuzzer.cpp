// Any bytes as the file of --control.

#include "fuzz_file.hpp"
#include "tcm_icp/survey/control_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tcm_icp;
  const fuzz::FuzzFile file({reinterpret_cast<const char*>(data), size}, ".csv");
  try {
    const auto points = read_control_file(file.path(), {"a.ply", "hall.ptx#1", "hall.ptx#2", "b.las#ft"});
    fuzz::require(!points.empty(), "a file that is read has a point");
    for (const auto& point : points) {
      fuzz::require(!point.name.empty(), "points have names");
      fuzz::require(point.measured.allFinite() && point.given.allFinite(), "coordinates are finite");
      fuzz::require((point.sigma_given_m.array() > 0).all(), "standard deviations are above 0");
      fuzz::require((point.sigma_measured_m.array() >= 0).all(), "standard deviations are not below 0");
    }
  } catch (const Error&) {
    // refused: as good
  }
  return 0;
}
