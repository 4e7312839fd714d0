#pragma once
// What `tcm-icp degrade` did, as a table and as degraded.json.

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tcm_icp/evaluation/degradation.hpp"

namespace tcm_icp::app {

struct DegradedFile {
  std::string name;
  std::size_t points_before = 0, points_after = 0;
  std::vector<DegradationStep> steps;
};

struct DegradationReport {
  std::string command_line;
  std::uint64_t seed = 0;
  std::vector<DegradedFile> files;
};

void print_degradation(const DegradationReport& report, std::ostream& out);

/// @throws OutputError
void write_degradation(const DegradationReport& report, const std::filesystem::path& path);

}  // namespace tcm_icp::app
