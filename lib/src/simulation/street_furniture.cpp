#include "simulation/street_furniture.hpp"

#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

}  // namespace

void add_van(TriangleMesh& mesh, const Isometry3d& T_world_van, Rng& rng) {
  const double half_length = uniform(rng, 2.3, 2.9);
  const double height = uniform(rng, 2.0, 2.7);
  const double bonnet = uniform(rng, 0.6, 1.2);
  add_box(mesh, T_world_van, box(-half_length, half_length - bonnet, -0.95, 0.95, 0.35, height), 0.6);
  add_box(mesh, T_world_van, box(half_length - bonnet, half_length, -0.92, 0.92, 0.35, 1.15), 0.6);
  for (const double x : {-0.6 * half_length, 0.65 * half_length}) {
    for (const double side : {-1.0, 1.0}) {
      const Isometry3d T_world_wheel = T_world_van * Translation3d(x, side * 0.75, 0.35) *
                                       Eigen::AngleAxisd(-side * std::numbers::pi / 2, Vector3d::UnitX());
      add_frustum(mesh, T_world_wheel, {0.35, 0.35, 0.22, 14}, 0.1);
    }
  }
}

void add_sign(TriangleMesh& mesh, const Isometry3d& T_world_sign, Rng& rng) {
  const double height = uniform(rng, 2.4, 3.6);
  const int num_plates = 1 + static_cast<int>(uniform_index(rng, 2));
  add_frustum(mesh, T_world_sign * Translation3d(0, 0, -kObjectFooting_m), {0.04, 0.04, kObjectFooting_m + height, 8},
              0.5);
  for (int i = 0; i < num_plates; ++i) {
    const double half = uniform(rng, 0.25, 0.45);
    const double top = height - 0.8 * i;
    add_box(mesh, T_world_sign, box(-0.06, -0.04, -half, half, top - 0.6, top), 0.9);
  }
}

void add_bollard(TriangleMesh& mesh, const Isometry3d& T_world_bollard, Rng& rng) {
  const double radius = uniform(rng, 0.06, 0.16);
  const double height = uniform(rng, 0.7, 1.1);
  add_frustum(mesh, T_world_bollard * Translation3d(0, 0, -kObjectFooting_m),
              {radius, radius, kObjectFooting_m + height, 10}, 0.5);
}

void add_cabinet(TriangleMesh& mesh, const Isometry3d& T_world_cabinet, Rng& rng) {
  const double x = uniform(rng, 0.25, 0.9);
  const double y = uniform(rng, 0.18, 0.35);
  const double height = uniform(rng, 0.8, 1.7);
  add_box(mesh, T_world_cabinet, box(-x, x, -y, y, -kObjectFooting_m, height), 0.5);
}

void add_poster_column(TriangleMesh& mesh, const Isometry3d& T_world_column, Rng& rng) {
  const double radius = uniform(rng, 0.45, 0.75);
  const double height = uniform(rng, 2.4, 3.3);
  add_frustum(mesh, T_world_column * Translation3d(0, 0, -kObjectFooting_m),
              {radius, radius, kObjectFooting_m + height, 20}, 0.7);
  add_frustum(mesh, T_world_column * Translation3d(0, 0, height), {1.15 * radius, 0.05, 0.4, 20}, 0.4);
}

void add_shelter(TriangleMesh& mesh, const Isometry3d& T_world_shelter, Rng& rng) {
  const double x = uniform(rng, 1.4, 2.4);
  add_box(mesh, T_world_shelter, box(-x - 0.1, x + 0.1, -0.8, 0.8, 2.3, 2.42), 0.5);
  add_box(mesh, T_world_shelter, box(-x, x, 0.68, 0.72, 0.3, 2.1), 0.15);
  for (const double px : {-x, x})
    for (const double py : {-0.6, 0.7})
      add_box(mesh, T_world_shelter, box(px - 0.05, px + 0.05, py - 0.05, py + 0.05, -kObjectFooting_m, 2.3), 0.5);
  add_box(mesh, T_world_shelter, box(-0.7 * x, 0.7 * x, 0.2, 0.55, 0.42, 0.5), 0.5);
}

void add_garden_wall(TriangleMesh& mesh, const Isometry3d& T_world_wall, double length_m, Rng& rng) {
  const double height = uniform(rng, 0.5, 2.2);
  add_box(mesh, T_world_wall, box(-length_m / 2, length_m / 2, -0.15, 0.15, -kObjectFooting_m, height), 0.5);
}

void add_hedge(TriangleMesh& mesh, const Isometry3d& T_world_hedge, double length_m, Rng& rng) {
  const double height = uniform(rng, 0.7, 1.8);
  const double spacing = 0.7;
  for (double x = -length_m / 2 + 0.4; x < length_m / 2 - 0.3; x += spacing)
    add_foliage(mesh, T_world_hedge * Translation3d(x, 0, height / 2), {Vector3d(0.5, 0.4, height / 2), 180, 0.16}, 0.4,
                rng);
}

}  // namespace tcm_icp
