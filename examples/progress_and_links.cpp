// Shows progress, stops when told to, and prints which pairs of scans hold the result together.
//   progress_and_links SCAN SCAN...

#include <filesystem>
#include <iostream>
#include <thread>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

int main(int argc, char** argv) {
  const std::vector<std::filesystem::path> files(argv + 1, argv + argc);
  tcm_icp::RunContext context;
  context.num_threads = static_cast<int>(std::thread::hardware_concurrency());
  context.on_progress = [](const tcm_icp::Progress& p) {
    std::cerr << p.stage << ' ' << p.done << " of " << p.total << '\n';
    return tcm_icp::Continue::kYes;  // kStop ends the run with Cancelled
  };
  try {
    const tcm_icp::Registration result = tcm_icp::register_scans(files, {}, context);
    for (const auto& link : result.links) {
      std::cout << result.scans[link.a].name << " - " << result.scans[link.b].name << ": " << to_string(link.verdict)
                << ", overlap " << link.overlap << ", residual " << 1000 * link.residual_m << " mm\n";
    }
    return result.all_registered() ? 0 : 3;
  } catch (const tcm_icp::Error& e) {
    std::cerr << e.what() << '\n';
    return 2;
  }
}
