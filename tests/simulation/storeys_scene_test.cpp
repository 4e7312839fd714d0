// Storeys above one another: what is alike in them, and what is not.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/scene_walk.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scene.hpp"
#include "tcm_icp/simulation/scene_set.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

using testing::kEye_m;

Scene make(std::uint64_t seed, const StoreysOptions& options = {}) {
  Rng rng = make_stream(seed, "test");
  return make_storeys_scene(options, rng);
}

double top_of_path_m(const Scene& scene) {
  double top = 0;
  for (const auto& p : scene.path) top = std::max(top, p.z());
  return top;
}

/// Of rays from places on the ground floor's path, the share that meets the same from `shift` farther.
double share_alike(const Scene& scene, const Vector3d& shift) {
  constexpr int kRays = 3000;
  const RayCaster caster(scene.mesh);
  Rng rng = make_stream(3, "rays");
  int alike = 0;
  for (int i = 0; i < kRays; ++i) {
    // In the corridor, where stairs are far.
    const Vector3d from(1 + 7 * uniform01(rng), uniform01(rng) - 0.5, kEye_m);
    const Vector3d direction = uniform_direction(rng);
    alike += testing::sees_the_same(caster, from, shift, direction, 30);
  }
  return static_cast<double>(alike) / kRays;
}

TEST(StoreysScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  testing::expect_same_and_another(make(1), make(1), make(2));
}

TEST(StoreysScene, StoreysAreAlikeButForWhatStandsAbout) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Scene scene = make(seed);
    const double storey_m = top_of_path_m(scene) / 2;
    for (const double up_m : {storey_m, 2 * storey_m}) {
      const double share = share_alike(scene, {0, 0, up_m});
      EXPECT_GT(share, 0.7) << "seed " << seed;
      EXPECT_LT(share, 0.98) << "seed " << seed;
    }
    EXPECT_LT(share_alike(scene, {0, 0, storey_m + 0.5}), 0.6) << "seed " << seed;
  }
}

TEST(StoreysScene, LeavesRoomToStandAnywhereAlongThePath) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    StoreysOptions options;
    options.storeys = 2 + static_cast<int>(seed % 3);
    options.length_m = 12 + 4.0 * static_cast<double>(seed);
    const Scene scene = make(seed, options);
    testing::expect_room_to_stand(scene, 0.1, seed);
  }
}

TEST(StoreysScene, IsClosedAndOneStoreySeesNoOther) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Scene scene = make(seed);
    const RayCaster caster(scene.mesh);
    testing::expect_closed(scene, seed);
    const double storey_m = top_of_path_m(scene) / 2;
    for (double x = 0.5; x < 9; x += 0.5) {
      const auto ceiling = caster.first_hit({x, 0.5, kEye_m}, Vector3d::UnitZ(), 300);
      ASSERT_TRUE(ceiling);
      EXPECT_LT(ceiling->range_m, storey_m - kEye_m);
    }
  }
}

TEST(StoreysScene, ThePathLeadsUpAllStairsAndIsAsLongAsAskedFor) {
  SceneSetOptions options = default_scene_set(SceneKind::kStoreys);
  options.scanner.step_deg = 2;
  RunContext context;
  for (const int num_scans : {20, 60}) {
    options.num_scans = num_scans;
    const SceneSet set = simulate_scene_set(options, context);
    EXPECT_NEAR(set.scene.path.front().z(), 0, 1e-9);
    EXPECT_NEAR(set.scene.path.back().z(), top_of_path_m(set.scene), 1e-9);
    EXPECT_NEAR(path_length_m(set.scene.path), num_scans * options.station_spacing_m,
                0.25 * num_scans * options.station_spacing_m);
  }
}

TEST(StoreysScene, ScansOfEachStoreyShareMuchAndTheStairsShareSomeWithBoth) {
  SceneSetOptions options = default_scene_set(SceneKind::kStoreys);
  options.scanner.step_deg = 2;
  RunContext context;
  for (const std::uint64_t seed : {1U, 2U}) {
    context.seed = seed;
    const SceneSet set = simulate_scene_set(options, context);
    const Eigen::MatrixXd& overlap = set.truth.overlap;
    for (Eigen::Index i = 0; i < overlap.rows(); ++i) {
      double best = 0;
      for (Eigen::Index j = 0; j < overlap.cols(); ++j)
        if (j != i) best = std::max({best, overlap(i, j), overlap(j, i)});
      EXPECT_GT(best, 0.1) << "seed " << seed << ", scan " << i;
    }
    const Eigen::Index last = overlap.rows() - 1;
    EXPECT_LT(std::max(overlap(0, last), overlap(last, 0)), 0.1);  // one above the other, two floors between
  }
}

TEST(StoreysScene, RefusesWhatCannotBeBuilt) {
  for (const auto& [storeys, length_m] :
       {std::pair(1, 20.0), std::pair(11, 20.0), std::pair(3, 11.0), std::pair(3, double{NAN})}) {
    StoreysOptions options;
    options.storeys = storeys;
    options.length_m = length_m;
    EXPECT_THROW(options.validate(), InvalidOptions) << storeys << ", " << length_m;
  }
  SceneSetOptions aerial = default_scene_set(SceneKind::kStoreys);
  use_sensor(aerial, SensorKind::kAerial);
  EXPECT_THROW(aerial.validate(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
