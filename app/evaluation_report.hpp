#pragma once
// What an evaluation found, as tables and as JSON.

#include <filesystem>
#include <iosfwd>

#include "tcm_icp/evaluation/cloud_distance.hpp"
#include "tcm_icp/evaluation/metrics.hpp"

namespace tcm_icp::app {

struct Evaluation {
  Truth truth;  ///< with the tolerance that was used
  SceneScore score;
  CloudComparison clouds;
  double min_overlap = 0;
  std::uint64_t seed = 0;
};

void print_evaluation(const Evaluation& evaluation, std::ostream& out);

/// @throws OutputError
void write_evaluation(const Evaluation& evaluation, const std::filesystem::path& path);

}  // namespace tcm_icp::app
