#include "simulation/palace.hpp"

#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/facade.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kStone = 0.6;
constexpr double kRoof = 0.35;
constexpr double kDepth_m = 14;
constexpr double kPavilion_m = 5;
constexpr double kStandsOut_m = 1.5;
constexpr int kStoreys = 3;

FacadeStyle palace_style(Rng& rng) {
  FacadeStyle s;
  s.ground_storey_m = uniform(rng, 4.2, 4.8);
  s.storey_m = uniform(rng, 3.8, 4.3);
  s.column_m = uniform(rng, 3, 3.6);
  s.window_width_m = 1.4;
  s.window_height_m = 2.3;
  s.recess_m = 0.35;
  s.cornice_m = 0.6;
  s.blank_share = 0;
  s.has_bands = true;
  s.reflectivity = kStone;
  return s;
}

/// The wing at positive x, walls and roof.
TriangleMesh make_wing(const FacadeStyle& style, double half_width_m, Rng& rng) {
  TriangleMesh wing;
  const double top = facade_height_m(style, kStoreys), inner = half_width_m - kPavilion_m;
  add_facade(wing, Isometry3d::Identity(), inner, kStoreys, style, rng);
  add_facade(wing, upright_pose({inner, -kStandsOut_m, 0}, 0), kPavilion_m, kStoreys, style, rng);
  add_facade(wing, upright_pose({half_width_m, -kStandsOut_m, 0}, std::numbers::pi / 2), kDepth_m + kStandsOut_m,
             kStoreys, plain_back(style), rng);
  add_quad(wing, {inner, -kStandsOut_m, -1}, {inner, 0, -1}, {inner, 0, top}, {inner, -kStandsOut_m, top}, kStone);
  add_box(wing, Isometry3d::Identity(), box(0, half_width_m, 0, kDepth_m, top, top + 0.9), kStone);
  const auto hip = [&](double y) -> Vector3d { return {half_width_m - 4, y, top + 3.8}; };
  for (const auto& [eave, ridge] : {std::pair(0.6, 5.0), {kDepth_m - 0.6, kDepth_m - 5}})
    add_quad(wing, {0, eave, top + 0.9}, {half_width_m - 0.6, eave, top + 0.9}, hip(ridge), {0, ridge, top + 3.8},
             kRoof);
  add_quad(wing, {half_width_m - 0.6, 0.6, top + 0.9}, {half_width_m - 0.6, kDepth_m - 0.6, top + 0.9},
           hip(kDepth_m - 5), hip(5), kRoof);
  add_box(wing, Isometry3d::Identity(), box(inner - 1, inner, 5.5, 6.5, top + 2.5, top + 5.2), 0.4);  // a chimney
  return wing;
}

/// Half of the portico: three columns, steps, beam and pediment.
void add_half_portico(TriangleMesh& half, double height_m) {
  const Isometry3d I = Isometry3d::Identity();
  for (const double x : {1.1, 3.1, 5.1}) {
    add_frustum(half, I * Translation3d(x, -3.4, 0.6), {0.45, 0.38, height_m - 1.0, 16}, kStone);
    for (const double z : {0.6, height_m - 0.65}) add_box(half, I, box(x - 0.6, x + 0.6, -4, -2.8, z, z + 0.3), kStone);
  }
  for (int step = 0; step < 4; ++step)
    add_box(half, I, box(0, 6.2 + 0.35 * step, -4.3 - 0.35 * step, 0, -1, 0.6 - 0.15 * step), kStone);
  add_box(half, I, box(0, 5.9, -4.1, 0, height_m - 0.35, height_m + 0.7), kStone);
  half.triangles.push_back({{0, -4.1, height_m + 0.7}, {5.9, -4.1, height_m + 0.7}, {0, -4.1, height_m + 2.9}, kStone});
  add_quad(half, {5.9, -4.1, height_m + 0.7}, {5.9, 1, height_m + 0.7}, {0, 1, height_m + 2.9},
           {0, -4.1, height_m + 2.9}, kRoof);
}

/// Stacked rings; an even number of sides is its own mirror image.
void add_dome(TriangleMesh& mesh, const Isometry3d& T, double radius_m) {
  constexpr int kSides = 24, kRings = 5;
  add_frustum(mesh, T, {radius_m, radius_m, 3.5, kSides}, kStone);
  add_frustum(mesh, T * Translation3d(0, 0, 3.5), {1.12 * radius_m, radius_m, 0.4, kSides}, kStone);
  for (int ring = 0; ring < kRings; ++ring) {
    const auto at = [&](int i) { return std::numbers::pi / 2 * i / (kRings + 0.6); };
    const double z = radius_m * std::sin(at(ring)), next = radius_m * std::sin(at(ring + 1));
    add_frustum(mesh, T * Translation3d(0, 0, 3.9 + z),
                {radius_m * std::cos(at(ring)), radius_m * std::cos(at(ring + 1)), next - z, kSides}, kRoof);
  }
  add_frustum(mesh, T * Translation3d(0, 0, 3.9 + 0.95 * radius_m), {0.6, 0.5, 1.8, 12}, kStone);
}

}  // namespace

void add_palace(TriangleMesh& mesh, const Isometry3d& T_world_palace, double half_width_m, Rng& rng) {
  const FacadeStyle style = palace_style(rng);
  TriangleMesh half = make_wing(style, half_width_m, rng);
  add_half_portico(half, facade_height_m(style, kStoreys) - 2.5);
  for (const double side : {1.0, -1.0}) {
    const auto at = [&](const Vector3d& p) -> Vector3d {
      return T_world_palace * Vector3d(side * p.x(), p.y(), p.z());
    };
    for (const Triangle& t : half.triangles) mesh.triangles.push_back({at(t.a), at(t.b), at(t.c), t.reflectivity});
  }
  add_dome(mesh, T_world_palace * Translation3d(0, kDepth_m / 2, facade_height_m(style, kStoreys) + 0.9), 4.8);
}

}  // namespace tcm_icp
