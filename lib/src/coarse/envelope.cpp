#include "envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decompositions.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {

int Envelope::num_occupied() const {
  return static_cast<int>(std::count_if(lowest.begin(), lowest.end(), [](float h) { return !std::isnan(h); }));
}

Eigen::Matrix3d levelling_rotation(const Eigen::Vector3d& up) { return rotation_between(up, Eigen::Vector3d::UnitZ()); }

Envelope make_envelope(const Points& points, const Eigen::Matrix3d& R_level_scan, double cell_m) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(R_level_scan * p);
  Envelope out;
  out.cell_m = cell_m;
  out.width = static_cast<int>(box.sizes().x() / cell_m) + 1;
  out.height = static_cast<int>(box.sizes().y() / cell_m) + 1;
  const auto size = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  out.lowest.assign(size, std::numeric_limits<float>::quiet_NaN());
  out.highest = out.lowest;
  for (const auto& point : points) {
    const Eigen::Vector3d p = R_level_scan * point;  // turned twice: that takes less time than keeping them
    const auto column = static_cast<std::size_t>((p.x() - box.min().x()) / cell_m);
    const auto row = static_cast<std::size_t>((p.y() - box.min().y()) / cell_m);
    const std::size_t k = row * static_cast<std::size_t>(out.width) + column;
    const auto h = static_cast<float>((p.z() - box.min().z()) / cell_m);
    // Written so that a NaN gives way.
    if (!(out.lowest[k] <= h)) out.lowest[k] = h;
    if (!(out.highest[k] >= h)) out.highest[k] = h;
  }
  return out;
}

double roughness(const Envelope& envelope, const std::vector<float>& heights) {
  std::vector<double> steps;
  const auto width = static_cast<std::size_t>(envelope.width);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (std::isnan(heights[k])) continue;
    const bool has_right = (k + 1) % width != 0 && !std::isnan(heights[k + 1]);
    const bool has_below = k + width < heights.size() && !std::isnan(heights[k + width]);
    if (has_right) steps.push_back(std::abs(heights[k + 1] - heights[k]));
    if (has_below) steps.push_back(std::abs(heights[k + width] - heights[k]));
  }
  if (steps.empty()) return std::numeric_limits<double>::infinity();
  return std::sqrt(quantile(steps, 0.5) * quantile(steps, 0.75));
}

}  // namespace tcm_icp
