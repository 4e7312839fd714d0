#include <gtest/gtest.h>

#include <functional>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scene.hpp"
#include "tcm_icp/simulation/scene_set.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

Scene street(std::uint64_t seed, double length_m = 150) {
  Rng rng = make_stream(seed, "test");
  return make_street_scene({length_m}, rng);
}

Scene block(std::uint64_t seed, double perimeter_m = 200) {
  Rng rng = make_stream(seed, "test");
  return make_block_scene({perimeter_m}, rng);
}

Scene town_grid(std::uint64_t seed, double length_m = 420) {
  Rng rng = make_stream(seed, "test");
  return make_town_grid_scene({length_m}, rng);
}

SceneSet simulate(SceneKind kind, int num_scans, std::uint64_t seed, int num_threads = 1) {
  SceneSetOptions options = default_scene_set(kind);
  options.num_scans = num_scans;
  options.scanner.step_deg = 2;
  RunContext context;
  context.seed = seed;
  context.num_threads = num_threads;
  return simulate_scene_set(options, context);
}

/// What a scanner sees around it at the height of its eyes: the distance in 72 directions.
std::vector<double> panorama(const RayCaster& caster, const PathPoint& at) {
  std::vector<double> ranges_m;
  for (int i = 0; i < 72; ++i) {
    const double angle = at.heading_rad + 2 * M_PI * i / 72;
    const auto hit =
        caster.first_hit(at.position + Vector3d(0, 0, 3.5), Vector3d(std::cos(angle), std::sin(angle), 0), 40);
    ranges_m.push_back(hit ? hit->range_m : 40);
  }
  return ranges_m;
}

TEST(StreetScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  for (const auto& make : {std::function([](std::uint64_t seed) { return street(seed); }),
                           std::function([](std::uint64_t seed) { return block(seed); }),
                           std::function([](std::uint64_t seed) { return town_grid(seed); })}) {
    const Scene a = make(1), b = make(1), c = make(2);
    ASSERT_EQ(a.mesh.triangles.size(), b.mesh.triangles.size());
    for (std::size_t i = 0; i < a.mesh.triangles.size(); ++i) ASSERT_EQ(a.mesh.triangles[i].a, b.mesh.triangles[i].a);
    EXPECT_EQ(a.path, b.path);
    EXPECT_NE(a.mesh.triangles.size(), c.mesh.triangles.size());
  }
}

TEST(StreetScene, LeavesRoomToStandAnywhereAlongThePath) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const Scene& scene : {street(seed), block(seed), town_grid(seed)}) {
      const RayCaster caster(scene.mesh);
      for (double s = 1; s < path_length_m(scene.path) - 1; s += 3) {
        const PathPoint at = along_path(scene.path, s);
        const Vector3d left(-std::sin(at.heading_rad), std::cos(at.heading_rad), 0);
        for (const double offset_m : {-1.2, 0.0, 1.2}) {  // as far off the middle as a station may be
          const Vector3d eye = at.position + offset_m * left + Vector3d(0, 0, 1.8);
          EXPECT_GT(caster.distance_m(eye), 0.5) << "seed " << seed << ", " << s << " m along the path";
        }
        const auto ground = caster.first_hit(at.position + Vector3d(0, 0, 1.8), -Vector3d::UnitZ(), 10);
        ASSERT_TRUE(ground);
        EXPECT_NEAR(ground->range_m, 1.8, 0.03);  // the ground waves, triangles and path are straight for a metre
      }
    }
  }
}

TEST(StreetScene, HasPlacesThatCanBeToldApart) {
  const Scene scene = street(3, 400);
  const RayCaster caster(scene.mesh);
  std::vector<std::vector<double>> views;
  for (double s = 15; s < 390; s += 25) views.push_back(panorama(caster, along_path(scene.path, s)));
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) {
      int differing = 0;
      for (std::size_t i = 0; i < 72; ++i) differing += std::abs(views[a][i] - views[b][i]) > 0.5 ? 1 : 0;
      EXPECT_GT(differing, 18) << "places " << a << " and " << b;
    }
  }
}

TEST(StreetScene, HasTheLengthThatWasAskedFor) {
  EXPECT_NEAR(path_length_m(street(1, 300).path), 300, 15);  // cut corners are shorter
  const Scene scene = block(1, 240);
  EXPECT_NEAR(path_length_m(scene.path), 240, 15);
  EXPECT_EQ(scene.path.front(), scene.path.back());
  for (const double length_m : {420.0, 900.0, 1700.0}) {  // corners lie where chance has it
    EXPECT_NEAR(path_length_m(town_grid(1, length_m).path), length_m, 0.1 * length_m);
  }
}

TEST(StreetScene, RefusesLengthsOutOfBounds) {
  EXPECT_THROW(street(1, 10), InvalidOptions);
  EXPECT_THROW(street(1, 1e6), InvalidOptions);
  EXPECT_THROW(block(1, 100), InvalidOptions);
  EXPECT_THROW(block(1, NAN), InvalidOptions);
  EXPECT_THROW(town_grid(1, 300), InvalidOptions);
  EXPECT_THROW(town_grid(1, 1e6), InvalidOptions);
}

TEST(StreetSet, NeighboursOverlapAndFarScansShareNothing) {
  const SceneSet set = simulate(SceneKind::kStreet, 10, 1);
  const Eigen::MatrixXd& overlap = set.truth.overlap;
  for (Eigen::Index i = 0; i + 1 < 10; ++i) EXPECT_GT(overlap(i, i + 1), 0.3) << i;
  for (Eigen::Index i = 0; i + 7 < 10; ++i) EXPECT_EQ(overlap(i, i + 7), 0) << i;  // 98 m, more than twice the range
}

TEST(StreetSet, AsksLessOfPosesTheLongerItIs) {
  const double shorter = simulate(SceneKind::kStreet, 4, 1).truth.tolerance.rmse_m;
  const double longer = simulate(SceneKind::kStreet, 8, 1).truth.tolerance.rmse_m;
  EXPECT_NEAR(longer - shorter, 4 * 14 * 1e-3, 0.01);  // cut corners are shorter
  EXPECT_EQ(default_scene_set(SceneKind::kTown).drift_share, 0);
}

TEST(BlockSet, ClosesTheLoop) {
  const SceneSet set = simulate(SceneKind::kBlock, 12, 1);
  const Eigen::MatrixXd& overlap = set.truth.overlap;
  for (Eigen::Index i = 0; i < 12; ++i) EXPECT_GT(overlap(i, (i + 1) % 12), 0.3) << i;
  EXPECT_LT(overlap(0, 6), 0.1);  // houses stand between
}

// Each station of three streets along and three across: those of crossing streets meet.
TEST(TownGridSet, HasLoopsEverywhereAndFewNeighborsForEach) {
  const SceneSet set = simulate(SceneKind::kTownGrid, 84, 1);
  const Eigen::Index n = 84;
  int most = 0, apart = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    int neighbors = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == j || std::max(set.truth.overlap(i, j), set.truth.overlap(j, i)) < 0.2) continue;
      ++neighbors;
      apart += std::abs(i - j) > 6 ? 1 : 0;  // another street, or the same one again
    }
    EXPECT_GE(neighbors, 1) << i;
    most = std::max(most, neighbors);
  }
  EXPECT_LT(most, 20);
  EXPECT_GT(apart, n / 2);
  EXPECT_LT(set.truth.tolerance.rmse_m, 0.2) << "errors add up across the town, not along all of its streets";
}

TEST(StreetSet, IsMadeForAnyNumberOfScansAndThreads) {
  for (const SceneKind kind : {SceneKind::kBlock, SceneKind::kStreet, SceneKind::kTownGrid}) {
    EXPECT_EQ(simulate(kind, 1, 1).scans.size(), 1u);
    const SceneSet one = simulate(kind, 3, 2, 1), three = simulate(kind, 3, 2, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(one.scans[i].cloud.size(), 1000u);
      EXPECT_EQ(one.scans[i].cloud.points, three.scans[i].cloud.points);
    }
    EXPECT_EQ(scene_kind_from_name(scene_name(kind)), kind);
  }
}

TEST(StreetSet, RefusesSpacingsOutOfBounds) {
  SceneSetOptions options = default_scene_set(SceneKind::kStreet);
  options.station_spacing_m = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options.station_spacing_m = NAN;
  EXPECT_THROW(options.validate(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
