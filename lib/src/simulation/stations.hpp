#pragma once
// Where scans are taken along a scene's path.

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scene_set.hpp"

namespace tcm_icp {

/// A turn to any heading after a tilt of up to `max_tilt_deg` about a level axis.
Eigen::Isometry3d random_level_turn(double max_tilt_deg, Rng& rng);

/// T_world_scanner of station `index`: evenly along the path, off its middle by as much as there is room. Stations
/// share out the path, or lie `station_spacing_m` apart about its middle where an overlap is asked for. A tripod is
/// levelled to half a degree and looks anywhere; a platform looks ahead.
Eigen::Isometry3d make_station(const Scene& scene, const SceneSetOptions& options, int index, Rng& rng);

/// The distance along the path at which scans share `*options.overlap`, by the larger of the two directions, on average
/// over four places; the longest there is, about a third of the path, where they share more even so.
double spacing_for_overlap(const Scene& scene, const SceneSetOptions& options, std::uint64_t seed, int num_threads);

}  // namespace tcm_icp
