#include "local_normals.hpp"

#include <Eigen/Eigenvalues>

namespace tcm_icp {
namespace {

constexpr std::size_t kMinNeighbors = 3;
// A neighbourhood whose second axis is shorter than this share of its first is a line.
constexpr double kMinAxisRatio = 0.2;

}  // namespace

Points local_normals(const Points& points, const RadiusNeighbors& neighbors, double radius_m) {
  Points normals(points.size(), Eigen::Vector3d::Zero());
  const double squared_radius_m2 = radius_m * radius_m;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // About the point itself: one pass, and no digits lost far from the origin.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    std::size_t count = 0;
    for (const std::uint32_t j : neighbors.of(i)) {
      const Eigen::Vector3d d = points[j] - points[i];
      if (d.squaredNorm() > squared_radius_m2) continue;
      sum += d;
      squares += d * d.transpose();
      ++count;
    }
    if (count < kMinNeighbors) continue;
    solver.computeDirect(squares - sum * sum.transpose() / static_cast<double>(count + 1));
    const Eigen::Vector3d values = solver.eigenvalues();
    if (!(values[1] > kMinAxisRatio * kMinAxisRatio * values[2])) continue;
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    if (normal.allFinite()) normals[i] = normal.normalized();
  }
  return normals;
}

}  // namespace tcm_icp
