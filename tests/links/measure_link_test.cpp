#include "links/measure_link.hpp"

#include <gtest/gtest.h>

#include "pipeline/prepared_scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;

class MeasureLinkTest : public ::testing::Test {
 protected:
  Rng rng_ = make_stream(1, "measure_link_test");
  const testing::PreparedScene s_ =
      testing::prepared_scene({.points_per_scan = 4000, .range_m = 16, .noise_m = 0.01}, rng_);
  const Isometry3d truth_ = s_.scene.T_target_source(0, 1);
};

TEST_F(MeasureLinkTest, RightPosesAgreeAtMoreAndNearerPointsThanWrongOnes) {
  const LinkMeasurements right = measure_link(s_.scans[0], s_.scans[1], truth_);
  EXPECT_GT(right.evidence.overlap, 0.5);
  EXPECT_GT(right.evidence.inlier_share, 0.5);
  EXPECT_LT(right.evidence.left_after_slide[0], 0.9);
  EXPECT_GT(right.evidence.num_points, 0u);
  EXPECT_LE(right.evidence.num_points, 1500u);
  for (int k = 0; k < 5; ++k) {
    const Isometry3d wrong = testing::perturbed(truth_, s_.scene.scans[1].points, 1, 3, rng_);
    const LinkMeasurements m = measure_link(s_.scans[0], s_.scans[1], wrong);
    EXPECT_LT(m.evidence.consensus(), 0.5 * right.evidence.consensus()) << k;
    if (m.evidence.consensus() > 0) {
      EXPECT_GT(m.evidence.median_residual_m, right.evidence.median_residual_m) << k;
    }
  }
}

TEST_F(MeasureLinkTest, WhichScanComesFirstDoesNotMatter) {
  const LinkMeasurements ab = measure_link(s_.scans[0], s_.scans[1], truth_),
                         ba = measure_link(s_.scans[1], s_.scans[0], truth_.inverse());
  EXPECT_GE(ab.evidence.overlap, ab.other_overlap) << "the direction that overlaps more";
  EXPECT_DOUBLE_EQ(ab.evidence.overlap, ba.evidence.overlap);
  EXPECT_DOUBLE_EQ(ab.other_overlap, ba.other_overlap);
  EXPECT_DOUBLE_EQ(ab.evidence.inlier_share, ba.evidence.inlier_share);
  EXPECT_DOUBLE_EQ(ab.other_inlier_share, ba.other_inlier_share);
  EXPECT_NEAR(ab.evidence.median_residual_m, ba.evidence.median_residual_m, 1e-9);
}

TEST_F(MeasureLinkTest, OutOfReachNothingAgreesAndNothingIsSeen) {
  const LinkMeasurements m = measure_link(s_.scans[0], s_.scans[1], Isometry3d(Eigen::Translation3d(1000, 0, 0)));
  EXPECT_EQ(m.evidence.overlap, 0);
  EXPECT_EQ(m.other_overlap, 0);
  EXPECT_EQ(m.evidence.consensus(), 0);
  EXPECT_FALSE(m.free_space.tells()) << "these scans have no viewpoints";
}

}  // namespace
}  // namespace tcm_icp
