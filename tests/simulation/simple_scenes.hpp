#pragma once
// Scenes of which every return is known.

#include <Eigen/Geometry>

#include "tcm_icp/simulation/lidar.hpp"

namespace tcm_icp::testing {

/// A room of 8 x 6 x 4 m about the origin, seen from inside.
inline RayCaster room(double reflectivity = 1) {
  TriangleMesh mesh;
  add_box(mesh, Eigen::Isometry3d::Identity(), {Eigen::Vector3d(-4, -3, -2), Eigen::Vector3d(4, 3, 2)}, reflectivity);
  return RayCaster(mesh);
}

inline RayCaster ground() {
  TriangleMesh mesh;
  add_quad(mesh, {-500, -500, 0}, {500, -500, 0}, {500, 500, 0}, {-500, 500, 0}, 0.3);
  return RayCaster(mesh);
}

inline LidarScan scan_with(const RayCaster& scene, const Eigen::Isometry3d& T_world_scanner,
                           const ScannerOptions& options, int num_threads = 1) {
  Rng rng = make_stream(11, "test");
  return simulate_scan(scene, T_world_scanner, options, rng, num_threads);
}

}  // namespace tcm_icp::testing
