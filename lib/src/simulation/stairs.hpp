#pragma once
// Stairs between two storeys alike.

#include <Eigen/Geometry>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

/// Two flights side by side in an opening of the floors: up along x to a landing half way, and back.
class Stairs {
 public:
  Stairs(const Eigen::AlignedBox2d& opening, double storey_m);

  /// Of both flights: what an opening needs along y.
  static constexpr double width_m() { return 2 * (kFlightMiddle_m + kHalfFlight_m); }

  /// What an opening needs along x.
  static double length_m(double storey_m);

  /// From before the first step on the floor at `floor_m` to behind the last one.
  Points path(double floor_m) const;

  /// Steps, landing and handrails.
  void add_to(TriangleMesh& mesh, double floor_m) const;

  /// Handrails around the opening in the floor at `floor_m`.
  void guard(TriangleMesh& mesh, double floor_m) const;

 private:
  static int num_steps(double storey_m);

  static constexpr double kTread_m = 0.28;
  static constexpr double kLanding_m = 1.3;
  static constexpr double kHalfFlight_m = 0.7;
  static constexpr double kFlightMiddle_m = 0.85;  ///< of either flight, from the middle of both

  const Eigen::AlignedBox2d opening_;
  const double middle_m_;  ///< along y
  const double half_rise_m_;
  const int num_steps_;  ///< of a flight; the last is the landing or the floor
  const double end_m_;   ///< of the flights, where the landing begins
};

}  // namespace tcm_icp
