#pragma once
// Made-up scenes: surfaces, and where a surveyor can stand.

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/triangle_mesh.hpp"

namespace tcm_icp {

struct Scene {
  TriangleMesh mesh;  ///< z up [m]
  Points path;        ///< polyline on the ground [m], >= 2 points, clear of objects: stations are chosen along it
  double free_half_width_m = 1.2;  ///< to either side of the path there is room for a station
};

struct TownOptions {
  double half_size_m = 30;  ///< [m] >= 10; the built-up square reaches this far from its middle along x and y
  int num_buildings = 8;    ///< 0..1000, gabled houses with recessed windows
  int num_sheds = 4;        ///< 0..1000, garages: boxes with flat roofs
  int num_trees = 14;       ///< 0..1000
  int num_bushes = 8;       ///< 0..1000
  int num_cars = 7;         ///< 0..1000, parked at the kerbs
  int num_lamps = 6;        ///< 0..1000, lamp posts with an arm
  int num_fences = 3;       ///< 0..1000
  void validate() const;    ///< throws InvalidOptions
};

/// A street that bends through uneven ground, with houses on both sides: no symmetry, no repetition. Houses are turned
/// with the street, each by a few degrees of its own.
/// @throws InvalidOptions  if a field is out of bounds, or an object finds no room (which and how many is said)
Scene make_town_scene(const TownOptions& options, Rng& rng);

struct StreetOptions {
  double length_m = 600;  ///< [m] 40..20000
  void validate() const;  ///< throws InvalidOptions
};

/// A winding street between houses, terraces and gardens, no two of which are alike, with a second row behind them.
/// @throws InvalidOptions
Scene make_street_scene(const StreetOptions& options, Rng& rng);

struct UrbanOptions {
  double length_m = 80;   ///< [m] 40..20000
  void validate() const;  ///< throws InvalidOptions
};

/// A street around a corner: houses, rows of trees with branches and leaves, wires on poles.
/// @throws InvalidOptions
Scene make_urban_scene(const UrbanOptions& options, Rng& rng);

struct CanopyOptions {
  double length_m = 80;   ///< [m] 40..2000, along the shore
  void validate() const;  ///< throws InvalidOptions
};

/// A trail along the shore of a lake: water that reflects next to nothing, open forest of pines and broadleaf trees,
/// and what a park has: tables, benches, signs, boulders, boats, a jetty, parked cars, a power line.
/// @throws InvalidOptions
Scene make_canopy_scene(const CanopyOptions& options, Rng& rng);

struct OrchardOptions {
  double length_m = 80;   ///< [m] 40..2000, of the way between the rows
  void validate() const;  ///< throws InvalidOptions
};

/// Ten rows of fruit trees, 4.5 m apart, a tree every 4 m: each a little off its place, a few missing, no two alike.
/// The way leads along the middle aisle.
/// @throws InvalidOptions
Scene make_orchard_scene(const OrchardOptions& options, Rng& rng);

struct TunnelOptions {
  double length_m = 80;   ///< [m] 40..2000, of the way
  void validate() const;  ///< throws InvalidOptions
};

/// A round tunnel of equal rings, lamps and cabinets every so many rings, pipes along a wall, and a few things left
/// behind. How wide it is, how its rings are and how it bends is drawn. No end is in sight.
/// @throws InvalidOptions
Scene make_tunnel_scene(const TunnelOptions& options, Rng& rng);

struct MotorwayOptions {
  double length_m = 80;   ///< [m] 40..2000, of the way
  void validate() const;  ///< throws InvalidOptions
};

/// A motorway between rails on posts, a wall of equal panels on one side, trees and bushes on the other; lamps, signs
/// on gantries, marker posts. The path leads along the middle of one carriageway.
/// @throws InvalidOptions
Scene make_motorway_scene(const MotorwayOptions& options, Rng& rng);

struct InteriorOptions {
  double length_m = 30;   ///< [m] 15..500, of the corridor
  void validate() const;  ///< throws InvalidOptions
};

/// One storey: a corridor with furnished rooms of unequal width on either side and open doors. The path leads from a
/// room through the corridor and its rooms.
/// @throws InvalidOptions
Scene make_interior_scene(const InteriorOptions& options, Rng& rng);

struct StoreysOptions {
  int storeys = 3;        ///< 2..10, alike but for furniture
  double length_m = 12;   ///< [m] 12..500, of the corridors
  void validate() const;  ///< throws InvalidOptions
};

/// Storeys of a corridor and rooms, as in make_interior_scene, above one another: walls, doors, windows and lamps to
/// the millimetre, what stands about on each its own. Stairs at one end of the corridors join them. The path leads
/// through two rooms of each storey, and up the stairs between.
/// @throws InvalidOptions
Scene make_storeys_scene(const StoreysOptions& options, Rng& rng);

struct PlazaOptions {
  double half_size_m = 30;  ///< [m] 22..200, of the square
  void validate() const;    ///< throws InvalidOptions
};

/// A paved square before a building that is its own mirror image, with town houses on the other sides, a fountain,
/// trees, lamps and benches.
/// @throws InvalidOptions
Scene make_plaza_scene(const PlazaOptions& options, Rng& rng);

struct BaysOptions {
  int storeys = 2;            ///< 1..10, alike; stairs join them
  int bays_along = 10;        ///< 7..200; more where the path asks for it
  int bays_across = 3;        ///< 3..20
  double clutter = 1;         ///< 0..10, things a bay on average: what tells bays apart; 0 leaves out pipes, too
  int partitions = 2;         ///< 0..20, walls between two columns on each storey
  double path_length_m = 96;  ///< [m] 8..20000
  void validate() const;      ///< throws InvalidOptions
};

/// A large building with columns every few metres. Bays and storeys are alike to the millimetre, but for lifts and
/// stairs in one place, the same on all storeys, and clutter. The way leads around on each storey, along one aisle and
/// back along another, and up the stairs between; the path is the middle of it.
/// @throws InvalidOptions
Scene make_bays_scene(const BaysOptions& options, Rng& rng);

struct BlockOptions {
  double perimeter_m = 240;  ///< [m] 120..20000, of the street's middle line
  void validate() const;     ///< throws InvalidOptions
};

/// The same around an irregular block: the path ends where it began.
/// @throws InvalidOptions
Scene make_block_scene(const BlockOptions& options, Rng& rng);

struct TownGridOptions {
  double length_m = 840;  ///< [m] 400..50000, of all streets together
  void validate() const;  ///< throws InvalidOptions
};

/// As many streets along as across, 70 m or more apart, none quite straight. The path leads along every street, so that
/// stations of crossing streets see one another: loops everywhere, and no station sees more than a few others.
/// @throws InvalidOptions
Scene make_town_grid_scene(const TownGridOptions& options, Rng& rng);

/// The point at `distance_m` along a polyline and the direction there [rad]; the ends where the distance is beyond
/// them.
struct PathPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double heading_rad = 0;
};
PathPoint along_path(const Points& path, double distance_m);
double path_length_m(const Points& path);

}  // namespace tcm_icp
