#include "tcm_icp/baselines/principal_axes.hpp"

#include <cmath>
#include <limits>

#include "core/decompositions.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

struct Axes {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d directions;  ///< columns, by ascending variance; a rotation
};

Axes principal_axes(const Points& points) {
  if (points.empty()) throw InvalidInput("principal axes of a cloud without points");
  const PointMoments moments(points);
  Axes axes;
  axes.centroid = moments.mean;
  axes.directions = symmetric_eigen3(moments.covariance).vectors;
  if (axes.directions.determinant() < 0) axes.directions.col(0) *= -1;
  return axes;
}

}  // namespace

std::array<Eigen::Isometry3d, 4> principal_axes_alignments(const Points& target, const Points& source) {
  const Axes to = principal_axes(target), from = principal_axes(source);
  std::array<Eigen::Isometry3d, 4> out;
  // Proper sign combinations: none turned, or two of the three.
  const std::array<Eigen::Vector3d, 4> signs{Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -1, -1),
                                             Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)};
  for (std::size_t k = 0; k < signs.size(); ++k) {
    out[k].setIdentity();
    out[k].linear() = to.directions * signs[k].asDiagonal() * from.directions.transpose();
    out[k].translation() = to.centroid - out[k].linear() * from.centroid;
  }
  return out;
}

double mean_nearest_distance(const Points& source, const NeighborIndex& target,
                             const Eigen::Isometry3d& T_target_source) {
  if (source.empty() || target.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  double sum_m = 0;
  for (const auto& p : source) sum_m += std::sqrt(target.nearest(T_target_source * p).squared_distance_m2);
  return sum_m / static_cast<double>(source.size());
}

Eigen::Isometry3d coarse_alignment_by_axes(const Points& target, const NeighborIndex& target_index,
                                           const Points& source) {
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& T : principal_axes_alignments(target, source)) {
    const double mean_m = mean_nearest_distance(source, target_index, T);
    if (mean_m < least_m) {
      least_m = mean_m;
      best = T;
    }
  }
  return best;
}

}  // namespace tcm_icp
