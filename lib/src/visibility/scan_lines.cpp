#include "tcm_icp/visibility/scan_lines.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

namespace tcm_icp {
namespace {

constexpr std::size_t kMaxLooks = 30000;
constexpr std::size_t kInARow = 5;
// Widths of a piece across by its length: what is left of the directions' error, in radians.
constexpr double kMaxWidth = 0.05;

}  // namespace

LinePieces find_line_pieces(const Points& points, const NeighborIndex& index) {
  LinePieces pieces;
  std::vector<Neighbor> neighbors;
  const std::size_t count = std::min(kMaxLooks, points.size());
  for (std::size_t i = 0; i < count; ++i) {
    index.nearest_k(points[i * points.size() / count], kInARow, neighbors);
    if (neighbors.size() < kInARow) continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& n : neighbors) mean += points[n.index] / static_cast<double>(kInARow);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& n : neighbors) spread += (points[n.index] - mean) * (points[n.index] - mean).transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(spread);
    if (!(axes.eigenvalues()[1] < kMaxWidth * kMaxWidth * axes.eigenvalues()[2])) continue;
    pieces.middles.push_back(mean);
    pieces.directions.push_back(axes.eigenvectors().col(2).normalized());
  }
  return pieces;
}

}  // namespace tcm_icp
