#pragma once
// A scan along its own axes, in units of its own size.

#include <Eigen/Geometry>
#include <optional>

#include "hidden_share.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

struct UnitFrame {
  Eigen::Isometry3d T_cloud_axes = Eigen::Isometry3d::Identity();
  double unit_m = 1;        ///< [m] middle edge of the box, in the cloud's unit
  Eigen::AlignedBox3f box;  ///< of 94 % of the points along each axis, unit edges
  UnitCloud cloud;          ///< points drawn

  Eigen::Vector3f to_unit(const Eigen::Vector3d& p) const {
    return (T_cloud_axes.inverse() * p / unit_m).cast<float>();
  }
  Eigen::Vector3d from_axes(const Eigen::Vector3d& p) const { return T_cloud_axes * (unit_m * p); }
  Eigen::Vector3d from_unit(const Eigen::Vector3f& p) const { return T_cloud_axes * (unit_m * p.cast<double>()); }
};

/// At most `count` points that have a normal, drawn at random; nothing where there are fewer than `least`, or their
/// middle edge is zero.
std::optional<UnitFrame> find_unit_frame(const Cloud& cloud, std::size_t count, std::size_t least, Rng& rng);

}  // namespace tcm_icp
