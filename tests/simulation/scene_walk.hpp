#pragma once
// What holds of every scene that stations lead through.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "simulation/draw.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp::testing {

constexpr double kEye_m = 1.5;

inline bool sees_the_same(const RayCaster& caster, const Eigen::Vector3d& from, const Eigen::Vector3d& shift,
                          const Eigen::Vector3d& direction, double range_m) {
  const auto here = caster.first_hit(from, direction, range_m);
  const auto there = caster.first_hit(from + shift, direction, range_m);
  return here.has_value() == there.has_value() && (!here || std::abs(here->range_m - there->range_m) < 1e-6);
}

/// Of rays to all sides from the path, each turned with it, the share that goes as far (to 5 cm) from `shift_m` farther
/// along; over places 2 m apart.
inline double share_seen_alike(const Scene& scene, double shift_m, std::uint64_t seed) {
  constexpr double kRange_m = 60, kAlike_m = 0.05;
  const RayCaster caster(scene.mesh);
  Rng rng = make_stream(seed, "rays");
  int num_alike = 0, num_rays = 0;
  const auto range_m = [&](double along_m, const Eigen::Vector3d& direction) {
    const PathPoint at = along_path(scene.path, along_m);
    const Eigen::Isometry3d eye = upright_pose(at.position + Eigen::Vector3d(0, 0, kEye_m), at.heading_rad);
    const auto hit = caster.first_hit(eye.translation(), eye.linear() * direction, kRange_m);
    return hit ? hit->range_m : kRange_m;
  };
  for (double s = 0; s + shift_m < path_length_m(scene.path); s += 2) {
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d direction = uniform_direction(rng);
      num_alike += std::abs(range_m(s, direction) - range_m(s + shift_m, direction)) < kAlike_m;
      ++num_rays;
    }
  }
  return static_cast<double>(num_alike) / num_rays;
}

/// Two scenes of one seed, and one of another.
inline void expect_same_and_another(const Scene& a, const Scene& b, const Scene& c) {
  ASSERT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
  for (std::size_t i = 0; i < a.mesh.triangles.size(); ++i) {
    ASSERT_TRUE(a.mesh.triangles[i].a.allFinite());
    ASSERT_EQ(a.mesh.triangles[i].a, b.mesh.triangles[i].a);
  }
  EXPECT_EQ(a.path, b.path);
  EXPECT_NE(a.path, c.path);
}

/// Anywhere along the path and to either side of it: nothing within `clear_m` of the eye, ground under it.
inline void expect_room_to_stand(const Scene& scene, double clear_m, std::uint64_t seed) {
  const RayCaster caster(scene.mesh);
  for (double s = 0; s < path_length_m(scene.path); s += 0.7) {
    const PathPoint at = along_path(scene.path, s);
    const Eigen::Vector3d left(-std::sin(at.heading_rad), std::cos(at.heading_rad), 0);
    for (const double share : {-1.0, 0.0, 1.0}) {
      const Eigen::Vector3d eye = at.position + share * scene.free_half_width_m * left + Eigen::Vector3d(0, 0, kEye_m);
      EXPECT_GT(caster.distance_m(eye), clear_m) << "seed " << seed << ", " << s << " m";
      const auto ground = caster.first_hit(eye, -Eigen::Vector3d::UnitZ(), 10);
      ASSERT_TRUE(ground);
      EXPECT_NEAR(ground->range_m, kEye_m, 0.1) << "seed " << seed << ", " << s << " m";  // half a step of stairs
    }
  }
}

/// No ray from the path leaves the building.
inline void expect_closed(const Scene& scene, std::uint64_t seed) {
  const RayCaster caster(scene.mesh);
  Rng rng = make_stream(seed, "rays");
  for (double s = 0; s < path_length_m(scene.path); s += 3) {
    const Eigen::Vector3d eye = along_path(scene.path, s).position + Eigen::Vector3d(0, 0, kEye_m);
    for (int i = 0; i < 300; ++i) EXPECT_TRUE(caster.first_hit(eye, uniform_direction(rng), 300)) << "seed " << seed;
  }
}

}  // namespace tcm_icp::testing
