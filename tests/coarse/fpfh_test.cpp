#include "tcm_icp/coarse/fpfh.hpp"

#include <gtest/gtest.h>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr double kRadius_m = 1.5;
// Floats, and neighbours at a bin's or the radius' edge that rounding moves.
constexpr float kTolerance = 2e-3F;

Cloud yard(std::uint64_t seed) {
  Rng rng = make_stream(seed, "fpfh");
  testing::SyntheticSceneOptions options;
  options.num_scans = 1;
  return testing::synthetic_scene(options, rng).scans.front();
}

float least_likeness(const Descriptors& a, const Descriptors& b) {
  float least = 1;
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    if (!a.col(i).isZero(0) || !b.col(i).isZero(0)) least = std::min(least, a.col(i).dot(b.col(i)));
  }
  return least;
}

TEST(Fpfh, IsOfUnitLengthOrZero) {
  const Descriptors d = fpfh(yard(1), kRadius_m);
  for (Eigen::Index i = 0; i < d.cols(); ++i) {
    EXPECT_TRUE(d.col(i).isZero(0) || std::abs(d.col(i).norm() - 1) < 1e-5F) << i;
  }
}

TEST(Fpfh, IsUnchangedByARigidMotion) {
  const Cloud cloud = yard(2);
  Rng rng = make_stream(2, "motion");
  const Descriptors a = fpfh(cloud, kRadius_m);
  const Descriptors b = fpfh(transformed(cloud, testing::random_pose(100, rng)), kRadius_m);
  EXPECT_GT(least_likeness(a, b), 1 - kTolerance);
}

TEST(Fpfh, IsUnchangedByTheSignsOfTheNormals) {
  const Cloud cloud = yard(3);
  Cloud flipped = cloud;
  Rng rng = make_stream(3, "signs");
  for (auto& n : flipped.normals) {
    if (uniform01(rng) < 0.5) n = -n;
  }
  const Descriptors a = fpfh(cloud, kRadius_m), b = fpfh(flipped, kRadius_m);
  // Neighbours at right angles have no side that rounding could not change: most points, not all.
  int alike = 0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) alike += a.col(i).dot(b.col(i)) > 1 - kTolerance ? 1 : 0;
  EXPECT_GT(alike, 0.9 * static_cast<double>(a.cols()));
}

TEST(Fpfh, IsUnchangedByScale) {
  const Cloud cloud = yard(4);
  const Descriptors expected = fpfh(cloud, kRadius_m);
  ASSERT_FALSE(expected.isZero(0));
  EXPECT_EQ(fpfh(testing::scaled_cloud(cloud, 1000), 1000 * kRadius_m), expected) << "not the same bits";
}

TEST(Fpfh, IsZeroWithoutNormalOrNeighbor) {
  Cloud cloud{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {50, 0, 0}}, {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
  const Descriptors d = fpfh(cloud, 1);
  EXPECT_TRUE(d.col(0).isZero(0));
  EXPECT_FALSE(d.col(1).isZero(0));
  EXPECT_TRUE(d.col(3).isZero(0));
  EXPECT_EQ(0, fpfh({}, 1).cols());
}

TEST(Fpfh, NeedsNormals) { EXPECT_THROW(fpfh({{{0, 0, 0}}, {}}, 1), InvalidInput); }

}  // namespace
}  // namespace tcm_icp
