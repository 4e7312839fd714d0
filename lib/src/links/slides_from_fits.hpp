#pragma once
// Poses of pairs by slides from those that they were fitted to (slide_search.hpp). Where a pose is right but for a
// slide, it is most often one that free space vetoes.

#include <memory>
#include <mutex>
#include <vector>

#include "links/pair_fits.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

class SlidesFromFits {
 public:
  /// Keeps references: all must outlive the search.
  /// @param store  where searches are kept; nullptr: nowhere
  SlidesFromFits(const std::vector<PreparedScan>& scans, const PairFits& fits, const RunContext& context,
                 const StepStore* store);

  /// Of each pair; none of one that was not fitted.
  std::vector<std::vector<PoseCandidate>> candidates(const ScanPairs& pairs);

 private:
  const Cloud& borders_of(std::size_t scan);
  std::vector<PoseCandidate> slides(std::size_t a, std::size_t b, const std::vector<Eigen::Isometry3d>& poses);

  const std::vector<PreparedScan>& scans_;
  const PairFits& fits_;
  const RunContext& context_;
  const StepStore* store_;
  std::vector<Cloud> borders_;  // of a scan, once they are asked for
  std::unique_ptr<std::once_flag[]> found_borders_;
};

}  // namespace tcm_icp
