// Registers clouds in memory: reads the points of files, as a program that has clouds from elsewhere would have them.
//   register_clouds SCAN SCAN...

#include <iostream>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

int main(int argc, char** argv) {
  try {
    std::vector<tcm_icp::Cloud> clouds;
    for (int i = 1; i < argc; ++i) {
      tcm_icp::ScanReader reader(argv[i], tcm_icp::ReadAttributes::kNo);
      tcm_icp::PointBlock block;
      clouds.emplace_back();
      while (reader.read(block)) {
        clouds.back().points.insert(clouds.back().points.end(), block.points.begin(), block.points.end());
      }
    }
    const tcm_icp::Registration result = tcm_icp::register_scans(clouds);
    for (const auto& scan : result.scans) {
      std::cout << scan.name << ", " << to_string(scan.status) << ", probability " << scan.probability << '\n';
      if (scan.is_registered()) std::cout << scan.T_reference_scan.matrix() << '\n';
    }
    return result.all_registered() ? 0 : 3;
  } catch (const tcm_icp::Error& e) {
    std::cerr << e.what() << '\n';
    return 2;
  }
}
