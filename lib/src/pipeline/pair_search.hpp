#pragma once
// Which pairs of scans to try for links, and in which order; the coarse aligners behind it.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "pose_graph.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"

namespace tcm_icp {

class PairSearch {
 public:
  /// Keeps references: all four must outlive the search.
  PairSearch(const std::vector<PreparedScan>& scans, const std::vector<std::string>& files,
             const PipelineOptions& options, const RunContext& context);
  ~PairSearch();

  /// Never tries this pair.
  void leave_out(std::size_t a, std::size_t b);

  /// Tries all pairs by height maps, and the pairs of scans that clear links did not join to the largest group by
  /// features, then by slides.
  void run(PoseGraph& graph);

  /// Tries the pairs of `wanted` scans with any other by the next method that they were not tried by: height maps,
  /// features, slides of the poses that those fitted to (slide_search.hpp). Links go to the graph. False where no pair
  /// was left. Each scan is tried with the ten others it most likely overlaps with, by coarse height maps; once they
  /// were tried by all methods, wanted scans are tried with twice as many. Cost: some 50 ms of processor time a pair
  /// and method, 1 ms to rank a pair.
  bool extend(PoseGraph& graph, const std::vector<bool>& wanted);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
