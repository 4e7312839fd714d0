#include "tcm_icp/simulation/scene.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

Scene town(std::uint64_t seed, const TownOptions& options = {}) {
  Rng rng = make_stream(seed, "test");
  return make_town_scene(options, rng);
}

TEST(TownScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto corners = [](const Scene& scene) {
    Points points;
    for (const auto& t : scene.mesh.triangles) points.insert(points.end(), {t.a, t.b, t.c});
    return points;
  };
  EXPECT_EQ(corners(town(1)), corners(town(1)));
  EXPECT_NE(corners(town(1)), corners(town(2)));
}

TEST(TownScene, FindsRoomForEverythingAndIsFinite) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Scene scene = town(seed);
    for (const auto& t : scene.mesh.triangles) {
      ASSERT_TRUE(t.a.allFinite() && t.b.allFinite() && t.c.allFinite()) << "seed " << seed;
    }
  }
}

TEST(TownScene, LeavesRoomToStandAnywhereAlongThePath) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Scene scene = town(seed);
    const RayCaster caster(scene.mesh);
    for (double s = 0; s < path_length_m(scene.path); s += 2) {
      const Vector3d eye = along_path(scene.path, s).position + Vector3d(0, 0, 1.8);
      EXPECT_GT(caster.distance_m(eye), 1) << "seed " << seed << ", " << s << " m along the path";
      const auto ground = caster.first_hit(eye, -Vector3d::UnitZ(), 10);
      ASSERT_TRUE(ground);
      EXPECT_NEAR(ground->range_m, 1.8, 0.03);  // the ground waves, its triangles and the path are straight for a metre
    }
  }
}

TEST(TownScene, SaysWhatFindsNoRoom) {
  TownOptions options;
  options.half_size_m = 15;
  options.num_buildings = 100;
  try {
    town(1, options);
    FAIL() << "a hundred houses have no room";
  } catch (const InvalidOptions& e) {
    EXPECT_NE(std::string(e.what()).find("num_buildings = 100"), std::string::npos) << e.what();
  }
}

TEST(TownScene, RefusesOptionsOutOfBounds) {
  TownOptions options;
  options.num_trees = -1;
  EXPECT_THROW(town(1, options), InvalidOptions);
  options = {};
  options.half_size_m = 5;
  EXPECT_THROW(town(1, options), InvalidOptions);
}

TEST(AlongPath, WalksTheCornersAndStopsAtTheEnds) {
  const Points path{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
  EXPECT_DOUBLE_EQ(path_length_m(path), 7);
  EXPECT_EQ(along_path(path, 1).position, Vector3d(1, 0, 0));
  EXPECT_EQ(along_path(path, 1).heading_rad, 0);
  EXPECT_EQ(along_path(path, 5).position, Vector3d(3, 2, 0));
  EXPECT_DOUBLE_EQ(along_path(path, 5).heading_rad, M_PI / 2);
  EXPECT_EQ(along_path(path, -1).position, Vector3d(0, 0, 0));
  EXPECT_EQ(along_path(path, 99).position, Vector3d(3, 4, 0));
}

}  // namespace
}  // namespace tcm_icp
