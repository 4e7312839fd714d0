#pragma once
// Scans of rooms made of boxes, from one place, by exact rays.

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp::testing {

struct BoxRoom {
  Eigen::AlignedBox3d walls;               ///< seen from within
  std::vector<Eigen::AlignedBox3d> boxes;  ///< seen from outside
};

/// A room of 8 x 6 x 3 m with what hides parts of it from any place.
inline BoxRoom furnished_room() {
  const auto box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
    return Eigen::AlignedBox3d(Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1));
  };
  return {box(0, 0, 0, 8, 6, 3),
          {box(1, 4, 0, 2.5, 4.8, 0.8), box(4, 1, 0, 4.6, 1.6, 2.2), box(6, 4, 0.7, 7.2, 5, 0.8),
           box(5.5, 2.5, 1.2, 5.9, 2.9, 3), box(0.3, 0.5, 0, 0.9, 1.4, 1.1), box(3, 4.9, 0, 3.3, 5.3, 1.7)}};
}

/// Rays evenly over the sphere: a Fibonacci lattice.
inline Points rays_over_sphere(std::size_t num_rays) {
  Points rays;
  for (std::size_t i = 0; i < num_rays; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(num_rays);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    rays.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return rays;
}

/// Of a spinning scanner: 32 lines from -30 to 10 degrees, a ray every 0.3 degrees.
inline Points rays_of_spinning_scanner(const Eigen::Quaterniond& attitude) {
  Points rays;
  for (int line = 0; line < 32; ++line) {
    const double elevation = (-30 + 40 * line / 31.0) * std::numbers::pi / 180;
    for (int k = 0; k < 1200; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / 1200;
      rays.push_back(attitude * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation)));
    }
  }
  return rays;
}

/// Points with exact normals, in the frame of the room.
inline Cloud scan_room(const BoxRoom& room, const Eigen::Vector3d& from, const Points& rays) {
  Cloud cloud;
  for (const Eigen::Vector3d& ray : rays) {
    double nearest = std::numeric_limits<double>::infinity();
    int nearest_axis = 0;
    const auto hit = [&](const Eigen::AlignedBox3d& box, bool inside) {
      double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
      int enter_axis = 0, leave_axis = 0;
      for (int k = 0; k < 3; ++k) {
        const double a = (box.min()[k] - from[k]) / ray[k], b = (box.max()[k] - from[k]) / ray[k];
        if (std::min(a, b) > enter) enter = std::min(a, b), enter_axis = k;
        if (std::max(a, b) < leave) leave = std::max(a, b), leave_axis = k;
      }
      const double range = inside ? leave : enter;
      if (enter > leave || range <= 0 || range >= nearest) return;
      nearest = range, nearest_axis = inside ? leave_axis : enter_axis;
    };
    hit(room.walls, true);
    for (const auto& box : room.boxes) hit(box, false);
    cloud.points.push_back(from + nearest * ray);
    cloud.normals.push_back(Eigen::Vector3d::Unit(nearest_axis));  // of either sign: nobody tells a scan's normals
  }
  return cloud;
}

inline Cloud scan_room(const BoxRoom& room, const Eigen::Vector3d& from, std::size_t num_rays) {
  return scan_room(room, from, rays_over_sphere(num_rays));
}

}  // namespace tcm_icp::testing
