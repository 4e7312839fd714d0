#include "simulation/overhead_line.hpp"

#include "simulation/box.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

Points add_utility_pole(TriangleMesh& mesh, const Isometry3d& T_world_pole, double height_m) {
  add_frustum(mesh, T_world_pole * Translation3d(0, 0, -kObjectFooting_m), {0.15, 0.1, kObjectFooting_m + height_m, 12},
              0.4);
  const double arm = height_m - 0.5;
  add_box(mesh, T_world_pole, box(-0.06, 0.06, -1, 1, arm, arm + 0.12), 0.4);
  Points carriers;
  for (const double y : {-0.9, 0.0, 0.9}) {
    const double top = y == 0 ? height_m + 0.15 : arm + 0.3;
    add_box(mesh, T_world_pole, box(-0.05, 0.05, y - 0.05, y + 0.05, top - 0.2, top), 0.6);
    carriers.push_back(T_world_pole * Vector3d(0, y, top));
  }
  return carriers;
}

void add_wire(TriangleMesh& mesh, const Vector3d& from, const Vector3d& to, double sag_m) {
  constexpr int kPieces = 16;
  constexpr double kHalfWidth_m = 0.012;
  const auto at = [&](int i) -> Vector3d {
    const double share = static_cast<double>(i) / kPieces;
    return from + share * (to - from) - Vector3d(0, 0, 4 * sag_m * share * (1 - share));
  };
  const Vector3d side = kHalfWidth_m * (to - from).cross(Vector3d::UnitZ()).normalized();
  for (int i = 0; i < kPieces; ++i) {
    // Two strips across each other: some width from every side.
    for (const Vector3d& half : {side, Vector3d(0, 0, kHalfWidth_m)})
      add_quad(mesh, at(i) - half, at(i + 1) - half, at(i + 1) + half, at(i) + half, 0.3);
  }
}

void add_span(TriangleMesh& mesh, const Points& from, const Points& to) {
  for (std::size_t i = 0; i < from.size(); ++i) add_wire(mesh, from[i], to[i], 0.02 * (to[i] - from[i]).norm());
}

}  // namespace tcm_icp
