// A large building that repeats itself: what is alike in it, and what is not.

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/bay_plan.hpp"
#include "simulation/scene_walk.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scene.hpp"
#include "tcm_icp/simulation/scene_set.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

Scene make(std::uint64_t seed, const BaysOptions& options = {}) {
  Rng rng = make_stream(seed, "test");
  return make_bays_scene(options, rng);
}

BayPlan plan_of(std::uint64_t seed, const BaysOptions& options = {}) {
  Rng rng = make_stream(seed, "test");
  return draw_bay_plan(options, rng);
}

BaysOptions bare() {
  BaysOptions options;
  options.clutter = 0;
  options.partitions = 0;
  return options;
}

/// Of rays from random places of bays behind the lifts, the share that meets the same after a shift. A range of one bay
/// keeps the ends of the building and the lifts out of sight.
double share_alike(const Scene& scene, const BayPlan& plan, const Vector3d& shift) {
  constexpr int kRays = 3000;
  const RayCaster caster(scene.mesh);
  Rng rng = make_stream(3, "rays");
  int alike = 0;
  for (int i = 0; i < kRays; ++i) {
    const double x = plan.bay_m * (plan.well + 3 + (plan.along - plan.well - 5) * uniform01(rng));
    const double y = plan.width_m() * uniform01(rng);
    const Vector3d from(x, y, 2.2 * uniform01(rng));
    const Vector3d direction = uniform_direction(rng);
    alike += testing::sees_the_same(caster, from, shift, direction, plan.bay_m);
  }
  return static_cast<double>(alike) / kRays;
}

TEST(BaysScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  testing::expect_same_and_another(make(1), make(1), make(2));
}

TEST(BaysScene, BaysAndStoreysAreAlikeButForClutter) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const BayPlan plan = plan_of(seed, bare());
    const Scene empty = make(seed, bare()), furnished = make(seed);
    for (const Vector3d& shift : {Vector3d(plan.bay_m, 0, 0), Vector3d(0, 0, plan.storey_m)}) {
      EXPECT_EQ(share_alike(empty, plan, shift), 1) << "seed " << seed;
      // Half a bay farther, floors and ceilings are alike, and little else.
      EXPECT_LT(share_alike(empty, plan, shift + Vector3d(plan.bay_m / 2, 0, 0)), 0.85) << "seed " << seed;
      const double share = share_alike(furnished, plan, shift);
      EXPECT_LT(share, 0.97) << "seed " << seed;  // enough to tell them apart
      EXPECT_GT(share, 0.6) << "seed " << seed;   // and yet alike
    }
  }
}

TEST(BaysScene, MoreClutterLeavesLessAlike) {
  const BayPlan plan = plan_of(5);
  const Vector3d shift(plan.bay_m, 0, 0);
  BaysOptions options = bare();
  double before = 1;
  for (const double clutter : {0.3, 1.0, 3.0}) {
    options.clutter = clutter;
    const double share = share_alike(make(5, options), plan, shift);
    EXPECT_LT(share, before) << clutter;
    before = share;
  }
}

TEST(BaysScene, LeavesRoomToStandAnywhereAlongThePath) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    BaysOptions options;
    options.storeys = 1 + static_cast<int>(seed % 3);
    options.clutter = 3;
    options.path_length_m = options.storeys == 1 ? 80 : 180;
    const Scene scene = make(seed, options);
    testing::expect_room_to_stand(scene, 0.3, seed);
  }
}

TEST(BaysScene, IsClosed) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Scene scene = make(seed);
    testing::expect_closed(scene, seed);
  }
}

TEST(BaysScene, ThePathIsAsLongAsAskedForAndLeadsUpTheStairs) {
  for (const int storeys : {1, 2, 3}) {
    for (const double length_m : {8.0, 96.0, 400.0}) {
      BaysOptions options;
      options.storeys = storeys;
      options.path_length_m = length_m;
      const Scene scene = make(7, options);
      const BayPlan plan = plan_of(7, options);
      EXPECT_NEAR(path_length_m(scene.path), length_m, 1e-9);
      const bool is_long = length_m > 20;
      if (storeys == 2 && is_long) {
        EXPECT_NEAR(scene.path.front().z(), 0, 1e-9);
        EXPECT_NEAR(scene.path.back().z(), plan.storey_m, 1e-9);
      }
      for (const auto& p : scene.path) EXPECT_LE(p.z(), plan.floor_m(storeys - 1) + 1e-9);
    }
  }
}

SceneSet simulate(int num_scans, std::uint64_t seed, int num_threads) {
  SceneSetOptions options = default_scene_set(SceneKind::kBays);
  options.num_scans = num_scans;
  options.scanner.step_deg = 1.5;
  RunContext context;
  context.seed = seed;
  context.num_threads = num_threads;
  return simulate_scene_set(options, context);
}

TEST(BaysScene, NeighboursShareThreeTenthsOnTheStairsToo) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Eigen::MatrixXd overlap = simulate(12, seed, 1).truth.overlap;
    for (Eigen::Index i = 0; i + 1 < overlap.rows(); ++i)
      EXPECT_GT(std::max(overlap(i, i + 1), overlap(i + 1, i)), 0.3) << "seed " << seed << ", scan " << i;
    EXPECT_LT(std::max(overlap(0, 11), overlap(11, 0)), 0.1);  // one above the other, a floor between
  }
}

TEST(BaysScene, ScansAreTheSameForAnyNumberOfThreads) {
  const SceneSet one = simulate(2, 4, 1), three = simulate(2, 4, 3);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(one.scans[i].cloud.points, three.scans[i].cloud.points);
}

TEST(BaysScene, RefusesWhatCannotBe) {
  const auto refuses = [](auto change) {
    BaysOptions options;
    change(options);
    EXPECT_THROW(make(1, options), InvalidOptions);
  };
  refuses([](BaysOptions& o) { o.storeys = 0; });
  refuses([](BaysOptions& o) { o.bays_along = 3; });
  refuses([](BaysOptions& o) { o.bays_across = 2; });
  refuses([](BaysOptions& o) { o.clutter = NAN; });
  refuses([](BaysOptions& o) { o.partitions = -1; });
  refuses([](BaysOptions& o) { o.path_length_m = 0; });
  SceneSetOptions set = default_scene_set(SceneKind::kBays);
  EXPECT_EQ(scene_kind_from_name(scene_name(set.scene)), set.scene);
  use_sensor(set, SensorKind::kAerial);
  EXPECT_THROW(set.validate(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
