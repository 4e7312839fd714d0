#include "tcm_icp/graph/correspondence_measure.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMaxSamples = 2000;  // a share is then known to about 0.01

void require_points(const Points& a, const Points& b) {
  if (a.empty() || b.empty()) throw InvalidInput("an empty cloud has no correspondence with another");
}

double mean_nearest_distance(const Points& points, const NeighborIndex& index) {
  const Points sample = even_sample(points, kMaxSamples);
  double sum = 0;
  for (const auto& p : sample) sum += std::sqrt(index.nearest(p).squared_distance_m2);
  return sum / static_cast<double>(sample.size());
}

}  // namespace

double correspondence_distance(const IndexedPoints& a, const IndexedPoints& b) {
  require_points(a.points, b.points);
  return (mean_nearest_distance(a.points, b.index) + mean_nearest_distance(b.points, a.index)) / 2;
}

double overlap_share(const PyramidLevel& a, const PyramidLevel& b, const Eigen::Isometry3d& T_a_b, double radius_m) {
  require_points(a.cloud.points, b.cloud.points);
  if (!(radius_m > 0)) throw InvalidInput("the radius of an overlap must be positive, not " + std::to_string(radius_m));
  const Eigen::Isometry3d T_b_a = T_a_b.inverse();
  const Points sample = even_sample(a.cloud.points, kMaxSamples);
  const auto near = std::count_if(sample.begin(), sample.end(),
                                  [&](const auto& p) { return b.index.nearest_within(T_b_a * p, radius_m).found(); });
  return static_cast<double>(near) / static_cast<double>(sample.size());
}

double overlap(const PyramidLevel& a, const PyramidLevel& b, const Eigen::Isometry3d& T_a_b, double radius_m) {
  return std::max(overlap_share(a, b, T_a_b, radius_m), overlap_share(b, a, T_a_b.inverse(), radius_m));
}

}  // namespace tcm_icp
