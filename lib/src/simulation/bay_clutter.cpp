// What tells the bays of a storey apart.

#include <array>
#include <cmath>
#include <numbers>

#include "simulation/bay_plan.hpp"
#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/hall_objects.hpp"
#include "simulation/room_furniture.hpp"
#include "simulation/site_plan.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Isometry3d;
using Eigen::Vector2d;

constexpr int kAttempts = 30;  ///< at a place for one thing; what finds none is left out

class Clutter {
 public:
  Clutter(TriangleMesh& mesh, const BayPlan& plan, int storey, Rng& rng)
      : mesh_(mesh), plan_(plan), storey_(storey), rng_(rng) {
    keep_path_free();
    for (const int i : {plan.well, plan.well + 1}) take(plan.bay(i, plan.core_row()));
    const double half = plan.half_column_m;
    for (int i = 0; i <= plan.along; ++i)
      for (int j = 0; j <= plan.across; ++j) site_.take({plan.bay_m * Vector2d(i, j), 0, {half, half}});
  }

  /// Between two neighbouring columns, up to the beam.
  void add_partition() {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const bool is_along = uniform01(rng_) < 0.5;
      const Vector2d column = random_bay().min();
      const double half = plan_.bay_m / 2 - plan_.half_column_m - 0.03;
      Vector2d middle = column;
      middle[is_along ? 0 : 1] += plan_.bay_m / 2;
      if (column[is_along ? 1 : 0] == 0) continue;  // an outer wall
      const Footprint spot{middle, is_along ? 0 : std::numbers::pi / 2, {half, 0.06}};
      if (!site_.is_free(spot, 0)) continue;
      site_.take(spot);
      const double top = plan_.storey_m - BayPlan::kSlab_m - BayPlan::kBeam_m;
      return add_box(mesh_, standing(spot), box(-half, half, -0.06, 0.06, 0, top), 0.7);
    }
  }

  void add_thing() {
    struct Kind {
      void (*add)(TriangleMesh&, const Isometry3d&, Rng&);
      Vector2d half_size_m;
    };
    const std::array<Kind, 9> kinds{{{add_crates, {0.95, 0.45}},
                                     {add_crates, {0.95, 0.45}},
                                     {add_machine, {1.1, 0.6}},
                                     {add_rack, {1.35, 0.5}},
                                     {add_shelf, {1.2, 0.18}},
                                     {add_desk, {0.9, 0.45}},
                                     {add_cupboard, {0.9, 0.32}},
                                     {add_chair, {0.3, 0.3}},
                                     {add_potted_plant, {0.35, 0.35}}}};
    const Kind& kind = kinds[uniform_index(rng_, kinds.size())];
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const double quarter = std::numbers::pi / 2 * static_cast<double>(uniform_index(rng_, 4));
      const double turn = uniform(rng_, -0.1, 0.1);
      const AlignedBox2d bay = random_bay();
      const double reach = kind.half_size_m.maxCoeff() + 0.2;  // off the outer walls and what hangs on them
      const double x = uniform(rng_, bay.min().x() + reach, bay.max().x() - reach);
      const double y = uniform(rng_, bay.min().y() + reach, bay.max().y() - reach);
      const Footprint spot{{x, y}, quarter + turn, kind.half_size_m};
      if (!site_.is_free(spot, 0.05)) continue;
      site_.take(spot);
      return kind.add(mesh_, standing(spot), rng_);
    }
  }

  /// One or two bays long, below the beams.
  void add_pipe() {
    const double radius = uniform(rng_, 0.06, 0.18);
    const double share = uniform(rng_, 0.08, 0.92);
    const AlignedBox2d bay = random_bay();
    const double length = plan_.bay_m * (1 + static_cast<double>(uniform_index(rng_, 2)));
    const double end = std::min(bay.min().x() + length, plan_.length_m());
    const double y = bay.min().y() + share * plan_.bay_m;
    const AlignedBox2d area(Vector2d(bay.min().x(), y - radius), Vector2d(end, y + radius));
    for (const int i : {plan_.well, plan_.well + 1})
      if (area.intersects(plan_.bay(i, plan_.core_row()))) return;
    const double z = plan_.ceiling_m(storey_) - BayPlan::kBeam_m - 0.05 - radius;
    const Isometry3d T_world_pipe =
        upright_pose({bay.min().x(), y, z}, 0) * Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY());
    add_frustum(mesh_, T_world_pipe, {radius, radius, end - bay.min().x(), 14}, 0.4);
  }

  /// From floor to ceiling, beside a column.
  void add_riser() {
    const double radius = uniform(rng_, 0.06, 0.18);
    const Vector2d beside = random_bay().min() + Vector2d(plan_.half_column_m + radius + 0.05, radius + 0.05);
    const Footprint spot{beside, 0, {radius, radius}};
    if (!site_.is_free(spot, 0)) return;
    site_.take(spot);
    add_frustum(mesh_, standing(spot), {radius, radius, plan_.storey_m - BayPlan::kSlab_m, 14}, 0.4);
  }

 private:
  void keep_path_free() {
    constexpr double kHalf = BayPlan::kHalfAisle_m;
    const Points way = path_around(plan_, storey_);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const AlignedBox2d strip = AlignedBox2d(way[i].head<2>()).extend(way[i + 1].head<2>());
      take({strip.min().array() - kHalf, strip.max().array() + kHalf});
    }
    // From there to the stairs.
    const AlignedBox2d front = plan_.bay(plan_.well - 1, plan_.core_row());
    take({Vector2d(front.center().x(), front.min().y()), front.max()});
  }

  void take(const AlignedBox2d& area) { site_.take({area.center(), 0, area.sizes() / 2}); }

  AlignedBox2d random_bay() {
    const auto i = uniform_index(rng_, static_cast<std::uint64_t>(plan_.along));
    const auto j = uniform_index(rng_, static_cast<std::uint64_t>(plan_.across));
    return plan_.bay(static_cast<int>(i), static_cast<int>(j));
  }

  Isometry3d standing(const Footprint& spot) const {
    return upright_pose({spot.centre.x(), spot.centre.y(), plan_.floor_m(storey_)}, spot.heading_rad);
  }

  TriangleMesh& mesh_;
  const BayPlan& plan_;
  const int storey_;
  Rng& rng_;
  SitePlan site_;
};

}  // namespace

void add_bay_clutter(TriangleMesh& mesh, const BayPlan& plan, const BaysOptions& options, int storey, Rng& rng) {
  Clutter clutter(mesh, plan, storey, rng);
  for (int i = 0; i < options.partitions; ++i) clutter.add_partition();
  const double num_things = options.clutter * plan.along * plan.across;
  for (int i = 0; i < std::lround(num_things / 12); ++i) {
    clutter.add_pipe();
    clutter.add_riser();
  }
  for (int i = 0; i < std::lround(num_things); ++i) clutter.add_thing();
}

}  // namespace tcm_icp
