#include "simulation/site_plan.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

Eigen::Matrix2d axes(const Footprint& f) {
  Eigen::Matrix2d out;
  out << std::cos(f.heading_rad), -std::sin(f.heading_rad), std::sin(f.heading_rad), std::cos(f.heading_rad);
  return out;
}

/// Too far apart to touch, however they are turned: most are, in a town.
bool far_apart(const Footprint& a, const Footprint& b) {
  const double reach = a.half_size_m.norm() + b.half_size_m.norm();
  return (a.centre - b.centre).squaredNorm() > reach * reach;
}

/// True where an edge direction of `a` is a line between the two.
bool separated_by_axes_of(const Footprint& a, const Footprint& b) {
  const Eigen::Matrix2d b_in_a = axes(a).transpose() * axes(b);
  const Eigen::Vector2d distance = (axes(a).transpose() * (b.centre - a.centre)).cwiseAbs();
  const Eigen::Vector2d reach = a.half_size_m + b_in_a.cwiseAbs() * b.half_size_m;
  return (distance.array() > reach.array()).any();
}

}  // namespace

bool overlap(const Footprint& a, const Footprint& b) {
  return !far_apart(a, b) && !separated_by_axes_of(a, b) && !separated_by_axes_of(b, a);
}

bool SitePlan::is_free(const Footprint& footprint, double margin_m) const {
  Footprint wider = footprint;
  wider.half_size_m.array() += margin_m;
  return std::none_of(taken_.begin(), taken_.end(), [&](const Footprint& f) { return overlap(wider, f); });
}

}  // namespace tcm_icp
