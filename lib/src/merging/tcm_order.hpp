#pragma once
// Which scan is merged next: lines 4 and 5 of Algorithm 1.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/merging/merge_options.hpp"
#include "tcm_icp/tcm/merge_order.hpp"
#include "tcm_icp/tcm/robust_tcm.hpp"

namespace tcm_icp {

/// A scan that may be merged, where it lies.
struct MergeChoice {
  std::size_t scan = 0;
  Eigen::Isometry3d T_reference_scan = Eigen::Isometry3d::Identity();
};

/// How a choice fits S.
struct MergeMeasure {
  TcmTerms terms;
  double overlap = 0;  ///< 0..1; where the order asks for it
};

class TcmOrder {
 public:
  /// Keeps references: all three must outlive it.
  TcmOrder(const std::vector<PreparedScan>& scans, const MergeOptions& options, const RunContext& context);

  /// The pyramid's level of S that choices are measured at. Where nothing is fitted to S the order moves no pose, and
  /// is worth no more than a coarse one costs: S is put together and indexed anew for every scan that may be next.
  std::size_t level() const;

  /// Of choices against S at level(). Thread-safe.
  std::vector<MergeMeasure> measure(const PyramidLevel& s, const std::vector<MergeChoice>& choices) const;

  /// Position of the choice with the least tau, or as the options ask for. @pre choices is not empty
  std::size_t next(const std::vector<MergeChoice>& choices, const std::vector<MergeMeasure>& measures);

 private:
  TcmTerms terms(const RobustTcmCloud& s, const MergeChoice& choice) const;

  const std::vector<PreparedScan>& scans_;
  const MergeOptions& options_;
  const RunContext& context_;
  std::size_t num_random_ = 0;
};

}  // namespace tcm_icp
