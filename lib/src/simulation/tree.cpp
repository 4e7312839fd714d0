#include "simulation/tree.hpp"

#include <algorithm>
#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kBark = 0.35;
constexpr double kLeaf = 0.45;

/// Frame at `base` whose z axis points to `azimuth_rad` and rises by `elevation_rad`.
Isometry3d limb_frame(const Vector3d& base, double azimuth_rad, double elevation_rad) {
  return Translation3d(base) * Eigen::AngleAxisd(azimuth_rad, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(std::numbers::pi / 2 - elevation_rad, Vector3d::UnitY());
}

/// A limb and the place where it ends.
Vector3d add_limb(TriangleMesh& mesh, const Isometry3d& T_world_limb, double length_m, double radius_m) {
  add_frustum(mesh, T_world_limb, {radius_m, 0.45 * radius_m, length_m, 5}, kBark);
  return T_world_limb * Vector3d(0, 0, length_m);
}

void add_trunk(TriangleMesh& mesh, const Isometry3d& T_world_tree, double height_m, double radius_m, double top_share) {
  add_frustum(mesh, T_world_tree * Translation3d(0, 0, -kObjectFooting_m),
              {radius_m, top_share * radius_m, kObjectFooting_m + height_m, 12}, kBark);
}

void add_twigs(TriangleMesh& mesh, const Vector3d& fork, double azimuth_rad, double radius_m, Rng& rng) {
  const int count = 2 + static_cast<int>(uniform_index(rng, 3));
  for (int i = 0; i < count; ++i) {
    const double azimuth = azimuth_rad + uniform(rng, -1.1, 1.1);
    const double elevation = uniform(rng, 0.1, 1.2);
    const double length = uniform(rng, 0.6, 1.5);
    const Vector3d end = add_limb(mesh, limb_frame(fork, azimuth, elevation), length, 0.45 * radius_m);
    const double half = uniform(rng, 0.45, 0.85);
    add_foliage(mesh, Isometry3d(Translation3d(end)),
                {Vector3d(half, half, 0.8 * half), static_cast<int>(90 * half), 0.16}, kLeaf, rng);
  }
}

}  // namespace

void add_broadleaf_tree(TriangleMesh& mesh, const Isometry3d& T_world_tree, Rng& rng) {
  const double height = uniform(rng, 2.2, 4.2);
  const double radius = uniform(rng, 0.11, 0.26);
  add_trunk(mesh, T_world_tree, height, radius, 0.8);
  const int count = 4 + static_cast<int>(uniform_index(rng, 4));
  const double first = uniform(rng, 0, 2 * std::numbers::pi);
  for (int i = 0; i < count; ++i) {
    const double azimuth = first + 2 * std::numbers::pi * i / count + uniform(rng, -0.4, 0.4);
    const double elevation = uniform(rng, 0.4, 1.3);
    const double length = uniform(rng, 1.2, 2.8);
    const double at = height * uniform(rng, 0.8, 1);
    const Vector3d base = T_world_tree * Vector3d(0, 0, at);
    const Vector3d fork = add_limb(mesh, limb_frame(base, azimuth, elevation), length, 0.5 * radius);
    add_twigs(mesh, fork, azimuth, 0.5 * radius, rng);
  }
}

void add_pine(TriangleMesh& mesh, const Isometry3d& T_world_tree, Rng& rng) {
  const double height = uniform(rng, 7, 15);
  const double radius = 0.018 * height * uniform(rng, 0.8, 1.2);
  add_trunk(mesh, T_world_tree, height, radius, 0.2);
  const double reach = uniform(rng, 1.3, 2.4);
  for (double z = height * uniform(rng, 0.3, 0.5); z < height; z += uniform(rng, 0.7, 1.3)) {
    const int count = 3 + static_cast<int>(uniform_index(rng, 3));
    const double first = uniform(rng, 0, 2 * std::numbers::pi);
    const double length = reach * std::max(0.25, (height - z) / (0.6 * height));
    for (int i = 0; i < count; ++i) {
      const double azimuth = first + 2 * std::numbers::pi * i / count + uniform(rng, -0.3, 0.3);
      const Isometry3d T = limb_frame(T_world_tree * Vector3d(0, 0, z), azimuth, uniform(rng, -0.15, 0.35));
      const Vector3d end = add_limb(mesh, T, length, 0.03);
      for (const Vector3d& tuft : {end, Vector3d(T * Vector3d(0, 0, 0.6 * length))})
        add_foliage(mesh, Isometry3d(Translation3d(tuft)), {Vector3d(0.4, 0.4, 0.25), 22, 0.17}, kLeaf, rng);
    }
  }
}

}  // namespace tcm_icp
