// A motorway: what repeats along it, and what does not.

#include <gtest/gtest.h>

#include "simulation/scene_walk.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

Scene make_motorway(std::uint64_t seed, double length_m = 80) {
  Rng rng = make_stream(seed, "test");
  return make_motorway_scene({length_m}, rng);
}

TEST(MotorwayScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  testing::expect_same_and_another(make_motorway(1), make_motorway(1), make_motorway(2));
}

TEST(MotorwayScene, LooksMuchTheSameAnywhere) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Scene scene = make_motorway(seed);
    for (const double shift_m : {8.0, 24.0}) {
      const double alike = testing::share_seen_alike(scene, shift_m, seed);
      EXPECT_GT(alike, 0.6) << shift_m << " m, seed " << seed;
      EXPECT_LT(alike, 0.95) << shift_m << " m, seed " << seed;
    }
  }
}

TEST(MotorwayScene, ThereIsRoomToStandAlongTheWay) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Scene scene = make_motorway(seed);
    EXPECT_NEAR(path_length_m(scene.path), 80, 2);
    testing::expect_room_to_stand(scene, 0.3, seed);
  }
}

TEST(MotorwayScene, RefusesLengthsOutOfBounds) {
  for (const double length_m : {39.0, 2001.0, std::nan("")}) EXPECT_THROW(make_motorway(1, length_m), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
