#pragma once
// What a conventional method says of one pair of scans.

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/run_context.hpp"

namespace tcm_icp {

/// The scans a conventional method is given: what the registration by TCM works with, too.
struct PairInput {
  std::vector<Points> scans;  ///< one point a voxel, each scan in its local frame [m]
  double voxel_size_m = 0;    ///< [m] of these points; common to the set
  double spacing_m = 0;       ///< [m] median over the scans of their point spacing before that
  /// T_common_local where initial poses are given; otherwise a method finds its start by itself.
  std::vector<std::optional<Eigen::Isometry3d>> T_init;
};

struct PairFit {
  std::size_t source = 0, target = 0;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  int icp_iterations = 0;
  int ransac_iterations = 0;
  bool converged = false;  ///< by the method's own criterion; a fit that did not is the best it came to
  double mean_distance_m = std::numeric_limits<double>::quiet_NaN();  ///< [m] of source points to the target
  double share = 0;  ///< of the smaller scan's points: source points with a partner in the target
};

struct PairFits {
  std::vector<PairFit> pairs;
  double feature_voxel_m = 0;  ///< [m] features were computed at; 0 where there are none
};

/// Fits every pair of a set. @throws Cancelled
using PairMethod = std::function<PairFits(const PairInput&, const RunContext&)>;

}  // namespace tcm_icp
