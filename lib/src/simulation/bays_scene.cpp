// A building of bays, and the part of the way through it that the stations need.

#include <algorithm>
#include <cmath>
#include <string>

#include "simulation/bay_plan.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

void require(bool holds, const std::string& field, double value, const std::string& bound) {
  if (!holds) throw InvalidOptions("bays: " + field + " = " + std::to_string(value) + "; needs " + bound);
}

/// `length_m` of a path about its middle.
Points middle_part(const Points& path, double length_m) {
  const double begin = (path_length_m(path) - length_m) / 2, end = begin + length_m;
  Points part{along_path(path, begin).position};
  double at = 0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    at += (path[i] - path[i - 1]).norm();
    if (at > begin && at < end) part.push_back(path[i]);
  }
  part.push_back(along_path(path, end).position);
  return part;
}

}  // namespace

void BaysOptions::validate() const {
  require(storeys >= 1 && storeys <= 10, "storeys", storeys, "1..10");
  require(bays_along >= 7 && bays_along <= 200, "bays_along", bays_along, "7..200");
  require(bays_across >= 3 && bays_across <= 20, "bays_across", bays_across, "3..20");
  require(path_length_m >= 8 && path_length_m <= 20000, "path_length_m", path_length_m, "8..20000");
  require(clutter >= 0 && clutter <= 10, "clutter", clutter, "0..10");
  require(partitions >= 0 && partitions <= 20, "partitions", partitions, "0..20");
}

Scene make_bays_scene(const BaysOptions& options, Rng& rng) {
  options.validate();
  const BayPlan plan = draw_bay_plan(options, rng);
  Scene scene;
  add_bays(scene.mesh, plan);
  add_bay_core(scene.mesh, plan);
  for (int storey = 0; storey < plan.storeys; ++storey) add_bay_clutter(scene.mesh, plan, options, storey, rng);
  scene.path = middle_part(path_through(plan), options.path_length_m);
  scene.free_half_width_m = 0.35;  // of a flight of stairs with its handrails
  return scene;
}

}  // namespace tcm_icp
