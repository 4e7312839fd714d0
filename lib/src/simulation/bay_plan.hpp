#pragma once
// The plan of a building whose bays and storeys are alike.

#include <Eigen/Geometry>

#include "simulation/box.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {

/// Columns stand at every (i, j) times `bay_m`, from a corner of the outer walls; bay (i, j) lies between columns i and
/// i + 1 along x, j and j + 1 along y. Sizes are those of the whole building.
struct BayPlan {
  static constexpr double kSlab_m = 0.25;       ///< thickness of a floor
  static constexpr double kBeam_m = 0.35;       ///< from the ceiling down
  static constexpr double kHalfBeam_m = 0.15;   ///< half the width
  static constexpr double kHalfAisle_m = 0.75;  ///< kept free to either side of the path

  int along = 10, across = 3, storeys = 2;
  double bay_m = 6, storey_m = 3.6;  ///< from column to column; from floor to floor
  double half_column_m = 0.25;
  bool has_round_columns = false;
  double sill_m = 0.9, half_window_m = 2;
  int well = 3;  ///< the bay along x with the stairs; lifts are in the next one, and the bay before is open

  int core_row() const { return across / 2; }  ///< the bays along y with stairs and lifts, between two aisles
  double length_m() const { return along * bay_m; }
  double width_m() const { return across * bay_m; }
  double floor_m(int storey) const { return storey * storey_m; }
  double ceiling_m(int storey) const { return floor_m(storey) + storey_m - kSlab_m; }
  bool has_stairs() const { return storeys > 1; }

  Eigen::AlignedBox2d bay(int i, int j) const {
    return {bay_m * Eigen::Vector2d(i, j), bay_m * Eigen::Vector2d(i + 1, j + 1)};
  }
  /// Between the beams around the stairs: the floors above the ground are open here.
  Eigen::AlignedBox2d opening() const {
    const Eigen::AlignedBox2d b = bay(well, core_row());
    return {b.min().array() + kHalfBeam_m, b.max().array() - kHalfBeam_m};
  }
};

/// @pre options are valid. The building is as long as the path asks for, at least.
BayPlan draw_bay_plan(const BaysOptions& options, Rng& rng);

/// On each storey down one aisle and back the other, up the stairs between storeys; the stations' height above it is
/// that above the floor, give or take half a step on stairs.
Points path_through(const BayPlan& plan);

/// The way around on one storey alone, from the front of the stairs back to it.
Points path_around(const BayPlan& plan, int storey);

/// Floors, ceilings, outer walls, columns and beams, lamps and radiators: alike in all bays.
void add_bays(TriangleMesh& mesh, const BayPlan& plan);

/// The lifts and the stairs: the same on all storeys.
void add_bay_core(TriangleMesh& mesh, const BayPlan& plan);

/// What no two bays have in common, on one storey.
void add_bay_clutter(TriangleMesh& mesh, const BayPlan& plan, const BaysOptions& options, int storey, Rng& rng);

}  // namespace tcm_icp
