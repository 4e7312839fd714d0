#pragma once
// Defects put into a scan on purpose: the experiments of the paper on noise, occlusion, sparsity, isolated points and
// blurred features.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

struct DegradationOptions {
  double occlusion_share = 0;  ///< 0..0.95 of the points hidden, by sectors about the vertical and by boxes
  double removal_share = 0;    ///< 0..0.99 of the points that are left removed, anywhere
  double noise_share = 0;      ///< 0..1 of the points moved by normal noise
  double sigma_m = 0;          ///< [m] >= 0, standard deviation of the noise on each axis; 0: the median point spacing
  double blur_share = 0;       ///< 0..1 as many points added about edges and corners
  double isolated_share = 0;   ///< 0..1 as many points added away from all surfaces
  void validate() const;       ///< throws InvalidOptions; at least one share must be above 0
};

/// What one kind of defect did.
struct DegradationStep {
  std::string kind;  ///< "occlusion", "removal", "noise", "blur", "isolated"
  double share = 0;  ///< as asked for
  std::size_t points_before = 0, points_after = 0;
  std::size_t changed = 0;  ///< points hidden, removed, moved or added
  double length_m = 0;      ///< [m] noise and blur: standard deviation; isolated: least distance to the scan; else 0
};

struct DegradedCloud {
  static constexpr std::uint32_t kAdded = std::numeric_limits<std::uint32_t>::max();
  Points points;
  std::vector<std::uint32_t> source;  ///< index of the point each came from; kAdded where there is none
  std::vector<DegradationStep> steps;
};

/// Puts in what is asked for, in the order of the fields: what is hidden is no longer there to be blurred, and isolated
/// points come last. Shares count the points there are before the step, rounded to whole points.
/// The input's z axis is taken for the vertical. Edges and corners are the twentieth of the points with the largest
/// surface variation; blurring puts points about them with a standard deviation of three times the median spacing.
/// Isolated points are uniform in the scan's box, at least five spacings from every point.
/// @param seed, name  each kind draws from its own stream of both: one more kind leaves the draws of the others alone
/// @throws InvalidOptions
/// @throws InvalidInput  if there are fewer than 3 points, or a length is to come from the spacing and that is 0
/// Cost O(N log N), and normals of at most 100,000 points for blurring.
DegradedCloud degrade(const Points& points, const DegradationOptions& options, std::uint64_t seed,
                      std::string_view name, int num_threads);

}  // namespace tcm_icp
