#include "tcm_icp/simulation/ray_caster.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

/// A box of 2 x 4 x 6 m about the origin.
TriangleMesh box() {
  TriangleMesh mesh;
  add_box(mesh, Eigen::Isometry3d::Identity(), {Vector3d(-1, -2, -3), Vector3d(1, 2, 3)}, 0.25);
  return mesh;
}

TEST(RayCasterTest, MeetsTheNearFaceOfABoxAndNotTheFarOne) {
  const RayCaster caster(box());
  const auto hit = caster.first_hit({5, 0.3, 0.4}, {-1, 0, 0}, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 4, 1e-12);
  EXPECT_LT((hit->normal - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(hit->reflectivity, 0.25);
}

TEST(RayCasterTest, FromInsideMeetsTheFaceAheadWithItsNormalTowardsTheRay) {
  const RayCaster caster(box());
  const auto hit = caster.first_hit({0.1, 0.2, 0.3}, {0, 0, 1}, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 2.7, 1e-12);
  EXPECT_LT((hit->normal - Vector3d(0, 0, -1)).norm(), 1e-12);
}

TEST(RayCasterTest, MeetsASlantedSurfaceWhereItsPlaneIs) {
  TriangleMesh mesh;
  mesh.triangles.push_back({{10, 0, 0}, {0, 10, 0}, {0, 0, 10}, 0.5});  // x + y + z = 10
  const RayCaster caster(mesh);
  const Vector3d origin(0.5, 0.25, 0.125), direction = Vector3d(1, 2, 3).normalized();
  const auto hit = caster.first_hit(origin, direction, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR((origin + hit->range_m * direction).sum(), 10, 1e-12);
}

TEST(RayCasterTest, HasNoHitBesideBehindOrBeyondTheRange) {
  const RayCaster caster(box());
  EXPECT_FALSE(caster.first_hit({5, 2.1, 0.4}, {-1, 0, 0}, 100));
  EXPECT_FALSE(caster.first_hit({5, 0.3, 0.4}, {1, 0, 0}, 100));
  EXPECT_FALSE(caster.first_hit({5, 0.3, 0.4}, {-1, 0, 0}, 3.9));
}

TEST(RayCasterTest, MeasuresTheDistanceToTheNearestSurface) {
  const RayCaster caster(box());
  EXPECT_NEAR(caster.distance_m({0.5, 0, 0}), 0.5, 1e-12);
  EXPECT_NEAR(caster.distance_m({1 + 3, 2 + 4, 0}), 5, 1e-12);
}

TEST(RayCasterTest, RefusesMeshesThatCannotBeHit) {
  EXPECT_THROW(RayCaster(TriangleMesh{}), InvalidInput);
  TriangleMesh flat;
  flat.triangles.push_back({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 0.5});
  EXPECT_THROW(RayCaster{flat}, InvalidInput);
  TriangleMesh broken = box();
  broken.triangles[3].b.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RayCaster{broken}, InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
