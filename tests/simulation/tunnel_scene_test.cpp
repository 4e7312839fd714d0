// A tunnel: what repeats in it, and what does not.

#include <gtest/gtest.h>

#include "simulation/scene_walk.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

Scene make_tunnel(std::uint64_t seed, double length_m = 80) {
  Rng rng = make_stream(seed, "test");
  return make_tunnel_scene({length_m}, rng);
}

TEST(TunnelScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  testing::expect_same_and_another(make_tunnel(1), make_tunnel(1), make_tunnel(2));
}

TEST(TunnelScene, LooksNearlyTheSameAnywhere) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Scene scene = make_tunnel(seed);
    for (const double shift_m : {7.0, 15.0, 31.0}) {
      const double alike = testing::share_seen_alike(scene, shift_m, seed);
      EXPECT_GT(alike, 0.8) << shift_m << " m, seed " << seed;
      EXPECT_LT(alike, 0.99) << shift_m << " m, seed " << seed;
    }
  }
}

TEST(TunnelScene, IsClosedAboutTheWay) {
  // But for the ends, which are farther than any scanner of it sees.
  const Scene scene = make_tunnel(4);
  const RayCaster caster(scene.mesh);
  Rng rng = make_stream(4, "rays");
  for (double s = 0; s < 80; s += 3) {
    const Eigen::Vector3d eye = along_path(scene.path, s).position + Eigen::Vector3d(0, 0, testing::kEye_m);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d direction = uniform_direction(rng);
      if (std::abs(direction.x()) > 0.9) continue;
      EXPECT_TRUE(caster.first_hit(eye, direction, 60)) << s << " m";
    }
  }
}

TEST(TunnelScene, ThereIsRoomToStandAlongTheWay) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Scene scene = make_tunnel(seed);
    EXPECT_NEAR(path_length_m(scene.path), 80, 2);
    testing::expect_room_to_stand(scene, 0.3, seed);
  }
}

TEST(TunnelScene, RefusesLengthsOutOfBounds) {
  for (const double length_m : {39.0, 2001.0, std::nan("")}) EXPECT_THROW(make_tunnel(1, length_m), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
