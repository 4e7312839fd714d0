#pragma once
// Poles and the wires between them.

#include <Eigen/Geometry>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// A pole of `height_m` with an arm along y; the places on it that carry wires.
Points add_utility_pole(TriangleMesh& mesh, const Eigen::Isometry3d& T_world_pole, double height_m);

/// A wire that hangs through by `sag_m` in its middle.
void add_wire(TriangleMesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double sag_m);

/// A wire between each place of one pole and the same of the next; 2 % of the span as sag.
void add_span(TriangleMesh& mesh, const Points& from, const Points& to);

}  // namespace tcm_icp
