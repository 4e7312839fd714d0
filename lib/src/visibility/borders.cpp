#include "tcm_icp/visibility/borders.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "visibility/seen_through.hpp"

namespace tcm_icp {
namespace {

constexpr int kDirections = 8, kMostOpen = 5;  // of eight: a leaf is open on all sides
// As seen from the scanner: where the next point of a surface would be, and where an opening shows, whose directions
// and those about them must all be of what lies behind it.
constexpr double kDegree = EIGEN_PI / 180, kNext = 1 * kDegree;
constexpr std::array kOpen{2 * kDegree, 3 * kDegree};

// How far along a unit vector a point has to move to be seen from the place in a direction that differs by so much;
// 0 where it never will.
double step_m(const Eigen::Vector3d& place, const Eigen::Vector3d& point, const Eigen::Vector3d& along, double angle) {
  const Eigen::Vector3d ray = point - place;
  const double range = ray.norm();
  const double towards = std::acos(std::clamp(ray.dot(along) / range, -1.0, 1.0));
  return towards > angle ? range * std::sin(angle) / std::sin(towards - angle) : 0;
}

bool sees_through(const Sight& sight, const Eigen::Vector3d& point, const Eigen::Vector3d& along, double voxel_m) {
  return std::all_of(sight.images.begin(), sight.images.end(), [&](const RangeImage& image) {
    return std::any_of(kOpen.begin(), kOpen.end(), [&](double angle) {
      const double step = step_m(image.place(), point, along, angle);
      return step > 0 && seen_at(image, point + step * along, voxel_m) == Seen::kThrough;
    });
  });
}

}  // namespace

Cloud find_borders(const SightedScan& scan) {
  Cloud out;
  if (!scan.sight.sees_space()) return out;
  const double voxel_m = scan.surfaces.voxel_size_m;
  const Points& points = scan.surfaces.cloud.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& n = scan.sight.facing[i];
    if (n.isZero()) continue;
    const Eigen::Vector3d u = n.unitOrthogonal(), v = n.cross(u);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int num_open = 0;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * EIGEN_PI * k / kDirections;
      const Eigen::Vector3d outwards = std::cos(angle) * u + std::sin(angle) * v;
      if (!sees_through(scan.sight, points[i], outwards, voxel_m)) continue;
      const double next_m = std::max(step_m(scan.sight.places.front(), points[i], outwards, kNext), 1.5 * voxel_m);
      if (scan.surfaces.index.nearest_within(points[i] + next_m * outwards, 0.7 * next_m).found()) continue;
      sum += outwards;
      ++num_open;
    }
    if (num_open == 0 || num_open > kMostOpen) continue;
    out.points.push_back(points[i]);
    out.normals.push_back(sum.normalized());
  }
  return out;
}

}  // namespace tcm_icp
