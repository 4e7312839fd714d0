#include "simulation/room_furniture.hpp"

#include <algorithm>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

void add_legs(TriangleMesh& mesh, const Isometry3d& T, double x, double y, double height_m) {
  for (const double px : {-x, x})
    for (const double py : {-y, y}) add_box(mesh, T, box(px - 0.03, px + 0.03, py - 0.03, py + 0.03, 0, height_m), 0.3);
}

}  // namespace

void add_desk(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.6, 0.9);
  add_box(mesh, T, box(-x, x, -0.4, 0.4, 0.7, 0.74), 0.6);
  add_legs(mesh, T, x - 0.05, 0.35, 0.7);
  const double screen = uniform(rng, -0.5, 0.5) * x;
  add_box(mesh, T, box(screen - 0.28, screen + 0.28, 0.1, 0.14, 0.84, 1.2), 0.15);
  add_box(mesh, T, box(screen - 0.12, screen + 0.12, 0.08, 0.22, 0.74, 0.84), 0.2);
  const double side = uniform01(rng) < 0.5 ? -1 : 1;
  add_box(mesh, T, box(side * (x - 0.25) - 0.2, side * (x - 0.25) + 0.2, -0.3, 0.3, 0, 0.6), 0.5);
  const double pile = uniform(rng, 0.02, 0.25);
  add_box(mesh, T, box(-side * (x - 0.2) - 0.12, -side * (x - 0.2) + 0.12, -0.25, 0.05, 0.74, 0.74 + pile), 0.7);
}

void add_chair(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double back = uniform(rng, 0.8, 1.05);
  add_box(mesh, T, box(-0.23, 0.23, -0.22, 0.22, 0.42, 0.47), 0.4);
  add_box(mesh, T, box(-0.22, 0.22, 0.18, 0.22, 0.55, back), 0.4);
  add_legs(mesh, T, 0.19, 0.18, 0.42);
}

void add_meeting_table(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.9, 1.6);
  add_box(mesh, T, box(-x, x, -0.5, 0.5, 0.7, 0.75), 0.6);
  add_legs(mesh, T, x - 0.1, 0.4, 0.7);
  for (const double side : {-1.0, 1.0}) {
    for (double at = -x + 0.35; at < x - 0.2; at += 0.75) {
      if (uniform01(rng) < 0.2) continue;
      const double turn = (side > 0 ? 0 : std::numbers::pi) + uniform(rng, -0.4, 0.4);
      const double gap = uniform(rng, 0.6, 0.85);
      add_chair(mesh, T * upright_pose({at, side * gap, 0}, turn), rng);
    }
  }
}

void add_shelf(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.4, 1.2);
  const double height = uniform(rng, 1.1, 2.2);
  for (const double side : {-x, x}) add_box(mesh, T, box(side - 0.015, side + 0.015, -0.16, 0.16, 0, height), 0.5);
  for (double z = 0.05; z < height; z += 0.35) {
    add_box(mesh, T, box(-x, x, -0.16, 0.16, z, z + 0.02), 0.5);
    for (double at = -x + 0.03; at < x - 0.15;) {
      const double thickness = uniform(rng, 0.04, 0.3);
      const double book = uniform(rng, 0.12, 0.3);
      const double depth = uniform(rng, 0.1, 0.24);
      const double end = std::min(at + thickness, x - 0.03);
      if (uniform01(rng) < 0.75) add_box(mesh, T, box(at, end, 0.15 - depth, 0.15, z + 0.02, z + 0.02 + book), 0.5);
      at += thickness;
    }
  }
}

void add_cupboard(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.4, 0.9);
  const double height = uniform(rng, 0.8, 2.1);
  add_box(mesh, T, box(-x, x, -0.25, 0.3, 0, height), 0.55);
  add_box(mesh, T, box(-0.04, -0.02, -0.28, -0.25, 0.45 * height, 0.55 * height), 0.3);
  if (height > 1.4) return;
  const double thing = uniform(rng, 0.1, 0.4);
  const double at = uniform(rng, -0.6, 0.6) * x;
  add_box(mesh, T, box(at - 0.15, at + 0.15, -0.1, 0.2, height, height + thing), 0.4);
}

void add_sofa(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.7, 1.1);
  add_box(mesh, T, box(-x, x, -0.4, 0.4, 0.1, 0.42), 0.4);
  add_box(mesh, T, box(-x, x, 0.2, 0.4, 0.42, 0.8), 0.4);
  for (const double side : {-1.0, 1.0})
    add_box(mesh, T, box(side * (x - 0.08) - 0.08, side * (x - 0.08) + 0.08, -0.4, 0.4, 0.42, 0.6), 0.4);
}

void add_potted_plant(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double height = uniform(rng, 0.6, 1.5);
  add_frustum(mesh, T, {0.13, 0.19, 0.35, 12}, 0.4);
  add_frustum(mesh, T * Translation3d(0, 0, 0.3), {0.02, 0.01, height, 5}, 0.3);
  add_foliage(mesh, T * Translation3d(0, 0, 0.35 + 0.7 * height), {Vector3d(0.3, 0.3, 0.4 * height), 130, 0.1}, 0.45,
              rng);
}

}  // namespace tcm_icp
