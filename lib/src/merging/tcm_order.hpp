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

class TcmOrder {
 public:
  /// Keeps references: all three must outlive it.
  TcmOrder(const std::vector<PreparedScan>& scans, const MergeOptions& options, const RunContext& context);

  struct Next {
    std::size_t position = 0;  ///< among the choices
    TcmTerms terms;            ///< of its scan against S, where the order takes them
  };
  /// The choice with the least tau against S, or as the options ask for. @pre choices is not empty
  Next next(const ScanPyramid& s, const std::vector<MergeChoice>& choices);

  void grown() { s_cloud_.reset(); }  ///< S is another one from now on

 private:
  std::vector<TcmTerms> measure(const ScanPyramid& s, const std::vector<MergeChoice>& choices);

  const std::vector<PreparedScan>& scans_;
  const MergeOptions& options_;
  const RunContext& context_;
  std::vector<std::optional<RobustTcmCloud>> clouds_;  ///< of the scans, once they are asked for
  std::optional<RobustTcmCloud> s_cloud_;
  std::size_t num_random_ = 0;
};

}  // namespace tcm_icp
