// Any bytes as the file of --gnss.

#include <set>

#include "fuzz_file.hpp"
#include "tcm_icp/survey/control_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tcm_icp;
  const fuzz::FuzzFile file({reinterpret_cast<const char*>(data), size}, ".csv");
  try {
    std::set<std::string> scans;
    for (const auto& position : read_scanner_positions(file.path(), {"a.ply", "hall.ptx#1", "hall.ptx#2"})) {
      fuzz::require(position.is_scanner && scans.insert(position.scan).second, "each scan has one scanner");
      fuzz::require(position.measured.allFinite() && position.given.allFinite(), "coordinates are finite");
      fuzz::require((position.sigma_given_m.array() > 0).all(), "standard deviations are above 0");
    }
  } catch (const Error&) {
    // refused: as good
  }
  return 0;
}
