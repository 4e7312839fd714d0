// Registers scans in files and writes the folder that `tcm-icp register` writes.
//   register_files OUT SCAN...

#include <iostream>
#include <string>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_inputs.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: register_files OUT SCAN...\n";
    return 1;
  }
  try {
    const std::vector<std::string> names(argv + 2, argv + argc);
    const auto scans = tcm_icp::scans_in_files(tcm_icp::find_scans(names).scans);  // folders and patterns, too
    const tcm_icp::Registration result = tcm_icp::register_scans(scans);
    for (const auto& scan : result.scans) {
      std::cout << scan.name << ": " << to_string(scan.verdict) << " (" << scan.text << ")\n";
    }
    tcm_icp::RegistrationFolder folder;
    folder.path = argv[1];
    tcm_icp::write_registration(folder, scans, result);
    return result.all_registered() ? 0 : 3;
  } catch (const tcm_icp::Error& e) {
    std::cerr << e.what() << '\n';
    return 2;
  }
}
