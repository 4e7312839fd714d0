// Trees in equal rows: what repeats in them, and what does not.

#include <gtest/gtest.h>

#include "simulation/scene_walk.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/ray_caster.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

Scene make_orchard(std::uint64_t seed, double length_m = 80) {
  Rng rng = make_stream(seed, "test");
  return make_orchard_scene({length_m}, rng);
}

/// Of points above the ground, the share with something within half a metre both there and `shift` farther, by that
/// there.
double share_that_repeats(const Scene& scene, const Vector3d& shift) {
  constexpr double kNear_m = 0.5;
  const RayCaster caster(scene.mesh);
  Rng rng = make_stream(5, "places");
  int num_near = 0, num_both = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = 80 * uniform01(rng), y = 30 * uniform01(rng) - 15, up_m = 2 + uniform01(rng);
    const auto stands_near = [&](const Vector3d& at) {
      const auto ground = caster.first_hit(Vector3d(at.x(), at.y(), -50), Vector3d::UnitZ(), 100);
      return ground && caster.distance_m(Vector3d(at.x(), at.y(), ground->range_m - 50 + up_m)) < kNear_m;
    };
    if (!stands_near({x, y, 0})) continue;
    ++num_near;
    num_both += stands_near(Vector3d(x, y, 0) + shift);
  }
  return static_cast<double>(num_both) / num_near;
}

TEST(OrchardScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  testing::expect_same_and_another(make_orchard(1), make_orchard(1), make_orchard(2));
}

TEST(OrchardScene, RepeatsATreeAndARowFartherButNotBetween) {
  const Scene scene = make_orchard(3);
  for (const Vector3d& again : {Vector3d(4, 0, 0), Vector3d(0, 4.5, 0), Vector3d(-8, 9, 0)}) {
    EXPECT_GT(share_that_repeats(scene, again), 0.7) << again.transpose();
  }
  EXPECT_LT(share_that_repeats(scene, {2, 2.25, 0}), 0.4);
}

TEST(OrchardScene, ThereIsRoomToStandAlongTheWay) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Scene scene = make_orchard(seed);
    EXPECT_NEAR(path_length_m(scene.path), 80, 2);
    testing::expect_room_to_stand(scene, 0.3, seed);
  }
}

TEST(OrchardScene, RefusesLengthsOutOfBounds) {
  for (const double length_m : {39.0, 2001.0, std::nan("")}) EXPECT_THROW(make_orchard(1, length_m), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
