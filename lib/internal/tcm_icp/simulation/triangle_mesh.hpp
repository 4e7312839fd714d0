#pragma once
// Surfaces of a made-up scene: triangles and the shapes built from them.

#include <Eigen/Geometry>
#include <vector>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

struct Triangle {
  Eigen::Vector3d a, b, c;    ///< [m] corners; both sides reflect
  double reflectivity = 0.5;  ///< 0..1, share of the light that comes back at normal incidence
};

struct TriangleMesh {
  std::vector<Triangle> triangles;
};

/// Two triangles a b c and a c d.
void add_quad(TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d, double reflectivity);

/// Box between two opposite corners [m] of the object's frame.
void add_box(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_object, const Eigen::AlignedBox3d& box,
             double reflectivity);

/// A frustum of `sides` sides on the object's z axis, from z = 0 to `height_m`; open at both ends.
struct Frustum {
  double bottom_radius_m = 1;
  double top_radius_m = 1;
  double height_m = 1;
  int sides = 12;
};
void add_frustum(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_object, const Frustum& frustum,
                 double reflectivity);

/// `count` small triangles of random place and attitude in the ellipsoid with semi-axes `radii_m` about the object's
/// origin, denser towards its surface: light passes between them, as through a crown.
struct Foliage {
  Eigen::Vector3d radii_m = Eigen::Vector3d::Ones();
  int count = 500;
  double leaf_size_m = 0.2;
};
void add_foliage(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_object, const Foliage& foliage,
                 double reflectivity, Rng& rng);

}  // namespace tcm_icp
