#include "tcm_icp/simulation/triangle_mesh.hpp"

#include <cmath>
#include <numbers>

#include "simulation/draw.hpp"

namespace tcm_icp {

void add_quad(TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d, double reflectivity) {
  mesh.triangles.push_back({a, b, c, reflectivity});
  mesh.triangles.push_back({a, c, d, reflectivity});
}

void add_box(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_object, const Eigen::AlignedBox3d& box,
             double reflectivity) {
  // Eigen numbers the corners by bits: x + 2 y + 4 z.
  const auto corner = [&](int i) -> Eigen::Vector3d {
    return T_world_object * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  };
  constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) add_quad(mesh, corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3]), reflectivity);
}

void add_frustum(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_object, const Frustum& frustum,
                 double reflectivity) {
  const auto ring = [&](int i, double radius, double z) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * i / frustum.sides;
    return T_world_object * Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int i = 0; i < frustum.sides; ++i) {
    add_quad(mesh, ring(i, frustum.bottom_radius_m, 0), ring(i + 1, frustum.bottom_radius_m, 0),
             ring(i + 1, frustum.top_radius_m, frustum.height_m), ring(i, frustum.top_radius_m, frustum.height_m),
             reflectivity);
  }
}

void add_foliage(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_object, const Foliage& foliage,
                 double reflectivity, Rng& rng) {
  for (int i = 0; i < foliage.count; ++i) {
    const double share = std::sqrt(uniform01(rng));  // of the radius: leaves grow where there is light
    const Eigen::Vector3d direction = uniform_direction(rng);
    const Eigen::Vector3d side = uniform_direction(rng);
    const Eigen::Vector3d other_side = uniform_direction(rng);
    const Eigen::Vector3d at = T_world_object * (share * foliage.radii_m).cwiseProduct(direction).eval();
    mesh.triangles.push_back(
        {at, at + foliage.leaf_size_m * side, at + foliage.leaf_size_m * other_side, reflectivity});
  }
}

}  // namespace tcm_icp
