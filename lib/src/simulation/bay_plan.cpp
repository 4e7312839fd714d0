#include "simulation/bay_plan.hpp"

#include "simulation/draw.hpp"
#include "simulation/stairs.hpp"

namespace tcm_icp {

using Eigen::Vector2d;
using Eigen::Vector3d;

BayPlan draw_bay_plan(const BaysOptions& options, Rng& rng) {
  BayPlan plan;
  plan.along = options.bays_along;
  plan.across = options.bays_across;
  plan.storeys = options.storeys;
  plan.bay_m = uniform(rng, 5, 7.5);
  plan.storey_m = uniform(rng, 3.2, 4);
  plan.half_column_m = uniform(rng, 0.2, 0.3);
  plan.has_round_columns = uniform01(rng) < 0.5;
  plan.sill_m = uniform(rng, 0.8, 1.1);
  plan.half_window_m = plan.bay_m * uniform(rng, 0.25, 0.38);
  plan.well = 2 + static_cast<int>(uniform_index(rng, 3));
  while (path_length_m(path_through(plan)) < options.path_length_m) ++plan.along;
  return plan;
}

Points path_around(const BayPlan& plan, int storey) {
  const auto at = [&](int i, int j) -> Vector3d {
    const Vector2d middle = plan.bay(i, j).center();
    return {middle.x(), middle.y(), plan.floor_m(storey)};
  };
  const int front = plan.well - 1, end = plan.along - 1, row = plan.core_row();
  return {at(front, row), at(front, row + 1), at(end, row + 1), at(end, row - 1), at(front, row - 1), at(front, row)};
}

Points path_through(const BayPlan& plan) {
  const Stairs stairs(plan.opening(), plan.storey_m);
  Points path = path_around(plan, 0);
  for (int storey = 1; storey < plan.storeys; ++storey)
    for (const Points& part : {stairs.path(plan.floor_m(storey - 1)), path_around(plan, storey)})
      path.insert(path.end(), part.begin(), part.end());
  return path;
}

}  // namespace tcm_icp
