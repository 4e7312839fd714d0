#include "tcm_icp/coarse/slide_axes.hpp"

#include <array>
#include <cmath>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

// What lies along the slide, the better it is known: all surfaces at first, those within 6 degrees in the end.
constexpr std::array kMostAlongCosines{1.0, 0.5, 0.25, 0.1, 0.1};

// Of normals within `most` of being across `axis`, of trace 1.
Eigen::Matrix3d spread(const Points& normals, const Eigen::Vector3d& axis, double most) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& n : normals) {
    if (std::abs(n.dot(axis)) <= most) sum += n * n.transpose();
  }
  return sum.trace() > 0 ? Eigen::Matrix3d(sum / sum.trace()) : sum;
}

}  // namespace

Eigen::Matrix3d slide_axes(const Points& target_normals, const Points& source_normals,
                           const Eigen::Matrix3d& R_target_source) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (const double most : kMostAlongCosines) {
    const Eigen::Vector3d axis = axes.col(0), of_source = R_target_source.transpose() * axis;
    const Eigen::Matrix3d source = spread(source_normals, of_source, most);
    axes = symmetric_eigen3(spread(target_normals, axis, most) + R_target_source * source * R_target_source.transpose())
               .vectors;
  }
  return axes;
}

}  // namespace tcm_icp
