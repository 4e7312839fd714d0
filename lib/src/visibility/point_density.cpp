#include "tcm_icp/visibility/point_density.hpp"

#include <cmath>
#include <numbers>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kSamples = 3000;
constexpr std::size_t kNeighbors = 24;
// Of variances: the plane of the neighbours is one.
constexpr double kMaxThickness = 0.02;
// Of the farthest neighbour's distance: the middle of neighbours that lie on all sides.
constexpr double kMaxOffCentre = 0.25;

}  // namespace

DensitySamples sample_densities(const Points& points, std::span<const float> counts, const NeighborIndex& index,
                                Rng& rng) {
  DensitySamples out;
  std::vector<Neighbor> neighbors;
  for (const std::size_t i : sample_indices(rng, points.size(), kSamples)) {
    index.nearest_k(points[i], kNeighbors + 1, neighbors);  // itself among them
    if (neighbors.size() <= kNeighbors) continue;
    const double count = static_cast<double>(neighbors.size());
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double stands_for = 0;
    for (const auto& n : neighbors) {
      mean += points[n.index] / count;
      stands_for += counts[n.index];
    }
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& n : neighbors) {
      spread += (points[n.index] - mean) * (points[n.index] - mean).transpose() / count;
    }
    const auto [variances, axes] = symmetric_eigen3(spread);
    const double reach = std::sqrt(neighbors.back().squared_distance_m2);
    if (!(variances[1] > 0) || !(variances[0] < kMaxThickness * variances[2])) continue;
    if (!((mean - points[i]).norm() < kMaxOffCentre * reach)) continue;
    // An ellipse that is filled evenly has half axes of two standard deviations.
    const double area = 4 * std::numbers::pi * std::sqrt(variances[1] * variances[2]) / stands_for;
    out.points.push_back(points[i]);
    out.normals.push_back(axes.col(0));
    out.log_area.push_back(std::log(area));
  }
  return out;
}

}  // namespace tcm_icp
