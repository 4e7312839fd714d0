#include "simulation/park_furniture.hpp"

#include <array>
#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kWood = 0.4;
constexpr double kGranite = 0.45;

Isometry3d raised(const Isometry3d& T, double z) { return T * Translation3d(0, 0, z); }

}  // namespace

void add_picnic_table(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.8, 1.1);
  add_box(mesh, T, box(-x, x, -0.38, 0.38, 0.7, 0.76), kWood);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * 0.7;
    add_box(mesh, T, box(-x, x, y - 0.13, y + 0.13, 0.42, 0.47), kWood);
    const double leg = side * 0.7 * x;
    add_box(mesh, T, box(leg - 0.04, leg + 0.04, -0.75, 0.75, 0.34, 0.42), kWood);
    for (const double foot : {-0.5, 0.5})
      add_box(mesh, T, box(leg - 0.04, leg + 0.04, foot - 0.05, foot + 0.05, -kObjectFooting_m, 0.7), kWood);
  }
}

void add_bench(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double x = uniform(rng, 0.7, 1.0);
  add_box(mesh, T, box(-x, x, -0.22, 0.22, 0.4, 0.46), kWood);
  add_box(mesh, T, box(-x, x, 0.2, 0.25, 0.55, 0.85), kWood);
  for (const double side : {-0.8, 0.8})
    add_box(mesh, T, box(side * x - 0.05, side * x + 0.05, -0.2, 0.25, -kObjectFooting_m, side > 0 ? 0.85 : 0.8), 0.3);
}

void add_boulder(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  constexpr int kSides = 7;
  const double size = uniform(rng, 0.3, 0.9);
  // Three uneven rings and a top.
  std::array<std::array<Vector3d, kSides>, 3> rings;
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    const double z = size * (0.45 * static_cast<double>(ring) - 0.3);
    const double radius = size * (ring == 0 ? 0.9 : ring == 1 ? 1.0 : 0.6);
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      const double r = radius * uniform(rng, 0.75, 1.2);
      rings[ring][static_cast<std::size_t>(i)] = T * Vector3d(r * std::cos(angle), r * std::sin(angle), z);
    }
  }
  const Vector3d top = T * Vector3d(0, 0, 0.85 * size);
  for (std::size_t i = 0; i < kSides; ++i) {
    const std::size_t next = (i + 1) % kSides;
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring)
      add_quad(mesh, rings[ring][i], rings[ring][next], rings[ring + 1][next], rings[ring + 1][i], kGranite);
    mesh.triangles.push_back({rings.back()[i], rings.back()[next], top, kGranite});
  }
}

void add_log(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double length = uniform(rng, 1.5, 4);
  const double radius = uniform(rng, 0.12, 0.28);
  const Isometry3d lying =
      T * Translation3d(-length / 2, 0, 0.8 * radius) * Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitY());
  add_frustum(mesh, lying, {radius, 0.8 * radius, length, 10}, 0.35);
}

void add_fire_ring(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double radius = uniform(rng, 0.4, 0.6);
  add_frustum(mesh, raised(T, -kObjectFooting_m), {radius, radius, kObjectFooting_m + 0.35, 14}, kGranite);
  add_frustum(mesh, raised(T, -kObjectFooting_m), {radius - 0.15, radius - 0.15, kObjectFooting_m + 0.35, 14},
              kGranite);
  add_box(mesh, T, box(-0.3, 0.3, -0.25, 0.25, 0.4, 0.43), 0.2);
}

void add_boat(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double half = uniform(rng, 1.7, 2.4);
  const double width = uniform(rng, 0.35, 0.65);
  const auto at = [&](double x, double y, double z) -> Vector3d { return T * Vector3d(x, y, z); };
  for (const double side : {-1.0, 1.0}) {
    const double y = side * width;
    add_quad(mesh, at(-half, 0.6 * y, 0.5), at(0.4 * half, y, 0.45), at(0.4 * half, 0.4 * y, 0.05),
             at(-half, 0.3 * y, 0.05), 0.7);
    add_quad(mesh, at(0.4 * half, y, 0.45), at(half, 0, 0.6), at(0.9 * half, 0, 0.1), at(0.4 * half, 0.4 * y, 0.05),
             0.7);
  }
  add_quad(mesh, at(-half, -0.6 * width, 0.5), at(-half, 0.6 * width, 0.5), at(-half, 0.3 * width, 0.05),
           at(-half, -0.3 * width, 0.05), 0.7);
  add_quad(mesh, at(-half, -0.3 * width, 0.05), at(-half, 0.3 * width, 0.05), at(0.9 * half, 0, 0.1),
           at(0.9 * half, 0, 0.1), 0.6);
  for (const double x : {-0.5, 0.1})
    add_box(mesh, T, box(x * half, x * half + 0.25, -0.8 * width, 0.8 * width, 0.3, 0.34), kWood);
}

void add_jetty(TriangleMesh& mesh, const Isometry3d& T, double length_m) {
  add_box(mesh, T, box(-0.9, 0.9, -length_m, 0, 0.7, 0.8), kWood);
  for (double y = 0.2; y < length_m; y += 2.2) {
    for (const double side : {-0.9, 0.9}) {
      add_frustum(mesh, T * Translation3d(side, -y, -2), {0.09, 0.09, 3.7, 8}, kWood);
      add_box(mesh, T, box(side - 0.03, side + 0.03, -std::min(y + 2.2, length_m), -y, 1.55, 1.62), kWood);
    }
  }
}

void add_fountain(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double radius = uniform(rng, 2.2, 3.2);
  for (const double r : {radius, radius - 0.35})
    add_frustum(mesh, raised(T, -kObjectFooting_m), {r, r, kObjectFooting_m + 0.6, 28}, kGranite);
  add_frustum(mesh, raised(T, 0.6), {radius, radius - 0.35, 0.001, 28}, kGranite);
  add_frustum(mesh, raised(T, -kObjectFooting_m), {0.3, 0.22, kObjectFooting_m + 1.9, 14}, kGranite);
  add_frustum(mesh, raised(T, 1.6), {0.2, 1.0, 0.35, 20}, kGranite);
  add_frustum(mesh, raised(T, 1.9), {0.14, 0.05, 0.7, 10}, kGranite);
}

void add_statue(TriangleMesh& mesh, const Isometry3d& T, Rng& rng) {
  const double height = uniform(rng, 1.6, 2.4);
  add_box(mesh, T, box(-0.9, 0.9, -0.7, 0.7, -kObjectFooting_m, 0.3), kGranite);
  add_box(mesh, T, box(-0.6, 0.6, -0.45, 0.45, 0.3, height), kGranite);
  for (const double side : {-1.0, 1.0}) {
    add_frustum(mesh, T * Translation3d(0.12, side * 0.13, height), {0.1, 0.13, 0.95, 10}, 0.25);
    const Isometry3d arm = T * Translation3d(0, side * 0.3, height + 1.5) *
                           Eigen::AngleAxisd(side > 0 ? 2.6 : 1.2, Vector3d(1, 0.4, 0).normalized());
    add_frustum(mesh, arm, {0.08, 0.06, 0.7, 8}, 0.25);
  }
  add_frustum(mesh, raised(T, height + 0.9), {0.28, 0.33, 0.65, 12}, 0.25);
  add_frustum(mesh, raised(T, height + 1.55), {0.33, 0.08, 0.12, 12}, 0.25);
  add_frustum(mesh, raised(T, height + 1.62), {0.12, 0.1, 0.28, 10}, 0.25);
}

}  // namespace tcm_icp
