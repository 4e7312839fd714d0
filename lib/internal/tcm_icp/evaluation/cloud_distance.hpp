#pragma once
// The registered cloud against the cloud of the truth, as a whole.

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/evaluation/truth.hpp"

namespace tcm_icp {

/// Distances from each point of one cloud to the nearest of another.
struct DirectedDistance {
  std::size_t num_points = 0;
  double mean_m = 0;     ///< [m]
  double std_dev_m = 0;  ///< [m] of the distances
  double max_m = 0;      ///< [m] directed Hausdorff distance
};

/// @throws InvalidInput  if a cloud is empty or a coordinate is not finite
/// Cost O((N + M) log M) on `num_threads` threads, whose number does not change the result.
DirectedDistance directed_distance(const Points& from, const Points& to, int num_threads);

struct CloudComparison {
  std::size_t num_points = 0;            ///< of registered scans
  double rms_m = 0;                      ///< [m] root mean square of how far they are from where they belong
  DirectedDistance registered_to_truth;  ///< wrong poses make it large
  DirectedDistance truth_to_registered;  ///< scans that are missing do, too
  double hausdorff_m() const { return std::max(registered_to_truth.max_m, truth_to_registered.max_m); }
};

/// Compares the scans at their estimated poses with all scans of the reference's group at their true ones, both in the
/// frame of the reference scan. The same points stand in both clouds, so that exact poses give zeros; a sample's points
/// lie farther apart than those of the files, so distances of displaced points come out a little too large.
/// @param estimates, reference, points  as score_poses() takes them; `points` a sample of each scan
/// @param rms_points  how many of the points of registered scans `rms_m` is taken over: an even draw of `rng`
/// @throws InvalidInput  if the lengths differ, the reference has no estimate or there are no points
CloudComparison compare_clouds(const Truth& truth, const std::vector<std::optional<Eigen::Isometry3d>>& estimates,
                               std::size_t reference, const std::vector<Points>& points, std::size_t rms_points,
                               Rng& rng, int num_threads);

/// How many of `total` samples each of these scans gets, in proportion to its number of points (all of them where there
/// are no more); the remainder goes to the first of the largest fractions.
std::vector<std::size_t> share_out(std::size_t total, const std::vector<std::uint64_t>& num_points);

}  // namespace tcm_icp
