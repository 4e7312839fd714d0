#include "tcm_icp/simulation/triangle_mesh.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

double area_m2(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += (t.b - t.a).cross(t.c - t.a).norm() / 2;
  return sum;
}

TEST(TriangleMesh, BoxHasTheAreaOfItsSixFaces) {
  TriangleMesh mesh;
  add_box(mesh, Eigen::Isometry3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())),
          {Eigen::Vector3d(-1, 0, 2), Eigen::Vector3d(1, 3, 7)}, 0.5);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(area_m2(mesh), 2 * (2 * 3 + 2 * 5 + 3 * 5), 1e-12);
}

TEST(TriangleMesh, FrustumOfManySidesHasTheAreaOfACylinder) {
  TriangleMesh mesh;
  add_frustum(mesh, Eigen::Isometry3d::Identity(), {2, 2, 3, 1000}, 0.5);
  // A polygon of n sides is shorter than the circle by (pi / n)^2 / 6: 2e-6 here.
  EXPECT_NEAR(area_m2(mesh), 2 * M_PI * 2 * 3, 1e-5 * 2 * M_PI * 2 * 3);
}

TEST(TriangleMesh, FoliageStaysInItsEllipsoidButForALeafsLength) {
  TriangleMesh mesh;
  Rng rng = make_stream(1, "test");
  const Foliage foliage{Eigen::Vector3d(1, 2, 3), 400, 0.1};
  add_foliage(mesh, Eigen::Isometry3d::Identity(), foliage, 0.5, rng);
  ASSERT_EQ(mesh.triangles.size(), 400u);
  for (const Triangle& t : mesh.triangles) {
    EXPECT_LE(t.a.cwiseQuotient(foliage.radii_m).norm(), 1 + 1e-12);
    EXPECT_NEAR((t.b - t.a).norm(), 0.1, 1e-12);
  }
}

}  // namespace
}  // namespace tcm_icp
