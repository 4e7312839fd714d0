#include "simulation/stairs.hpp"

#include <cmath>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kMetal = 0.35;

/// Posts and two rails between two places on floors or steps.
void add_handrail(TriangleMesh& mesh, const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  const Vector3d ahead = way.normalized();
  const int num_gaps = std::max(1, static_cast<int>(std::lround(way.norm() / 1.2)));
  for (int i = 0; i <= num_gaps; ++i) {
    const Isometry3d T_world_post(Eigen::Translation3d(from + way * i / num_gaps));
    add_box(mesh, T_world_post, box(-0.02, 0.02, -0.02, 0.02, 0, 1), kMetal);
  }
  const Isometry3d T_world_rail =
      upright_pose(from, std::atan2(way.y(), way.x())) * Eigen::AngleAxisd(-std::asin(ahead.z()), Vector3d::UnitY());
  for (const double z : {0.5, 1.0}) {
    const Vector3d lift = T_world_rail.linear().transpose() * Vector3d(0, 0, z);
    add_box(mesh, T_world_rail * Eigen::Translation3d(lift), box(0, way.norm(), -0.025, 0.025, -0.025, 0.025), kMetal);
  }
}

}  // namespace

Stairs::Stairs(const Eigen::AlignedBox2d& opening, double storey_m)
    : opening_(opening),
      middle_m_(opening_.center().y()),
      half_rise_m_(storey_m / 2),
      num_steps_(num_steps(storey_m)),
      end_m_(opening_.min().x() + kTread_m * (num_steps_ - 1)) {}

int Stairs::num_steps(double storey_m) { return static_cast<int>(std::ceil(storey_m / 2 / 0.175)); }

double Stairs::length_m(double storey_m) { return kTread_m * (num_steps(storey_m) - 1) + kLanding_m; }

Points Stairs::path(double floor_m) const {
  // Through the middle of every tread.
  const double foot = opening_.min().x() - kTread_m / 2, head = end_m_ + kTread_m / 2, turn = end_m_ + kLanding_m / 2;
  const double up = middle_m_ - kFlightMiddle_m, back = middle_m_ + kFlightMiddle_m;
  const double half_way = floor_m + half_rise_m_, top = half_way + half_rise_m_;
  return {{foot - 0.6, up, floor_m}, {foot, up, floor_m},    {head, up, half_way}, {turn, up, half_way},
          {turn, back, half_way},    {head, back, half_way}, {foot, back, top},    {foot - 0.6, back, top}};
}

void Stairs::add_to(TriangleMesh& mesh, double floor_m) const {
  const Isometry3d T_world_foot(Eigen::Translation3d(opening_.min().x(), middle_m_, floor_m));
  const double run = end_m_ - opening_.min().x(), riser = half_rise_m_ / num_steps_;
  const double inner = kFlightMiddle_m - kHalfFlight_m, outer = kFlightMiddle_m + kHalfFlight_m;
  for (int i = 1; i < num_steps_; ++i) {
    const double x = kTread_m * (i - 1), z = riser * i, z_back = half_rise_m_ + z;
    add_box(mesh, T_world_foot, box(x, x + kTread_m, -outer, -inner, z - 0.3, z), kConcrete);
    add_box(mesh, T_world_foot, box(run - x - kTread_m, run - x, inner, outer, z_back - 0.3, z_back), kConcrete);
  }
  const double end = run + kLanding_m;
  add_box(mesh, T_world_foot, box(run, end, -outer, outer, half_rise_m_ - 0.3, half_rise_m_), kConcrete);
  const auto rail = [&](const Vector3d& from, const Vector3d& to) {
    add_handrail(mesh, T_world_foot * from, T_world_foot * to);
  };
  const double half = half_rise_m_, top = 2 * half_rise_m_;
  for (const double y : {-outer + 0.05, -inner - 0.05}) rail({0, y, riser}, {run, y, half});
  for (const double y : {outer - 0.05, inner + 0.05}) rail({run, y, half + riser}, {0, y, top});
  rail({run, -outer + 0.05, half}, {end - 0.05, -outer + 0.05, half});
  rail({end - 0.05, -outer + 0.05, half}, {end - 0.05, outer - 0.05, half});
  rail({end - 0.05, outer - 0.05, half}, {run, outer - 0.05, half});
}

void Stairs::guard(TriangleMesh& mesh, double floor_m) const {
  const Vector3d low(opening_.min().x(), opening_.min().y(), floor_m);
  const Vector3d high(opening_.max().x(), opening_.max().y(), floor_m);
  const double outer = kFlightMiddle_m + kHalfFlight_m;
  for (const double y : {low.y(), high.y()}) add_handrail(mesh, {low.x(), y, floor_m}, {high.x(), y, floor_m});
  add_handrail(mesh, {high.x(), low.y(), floor_m}, {high.x(), high.y(), floor_m});
  add_handrail(mesh, low, {low.x(), middle_m_ - outer, floor_m});
  add_handrail(mesh, {low.x(), middle_m_ + outer, floor_m}, {low.x(), high.y(), floor_m});
}

}  // namespace tcm_icp
