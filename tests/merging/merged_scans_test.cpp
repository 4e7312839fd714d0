#include "merging/merged_scans.hpp"

#include <gtest/gtest.h>

#include "merging/merged_cloud.hpp"
#include "pipeline/prepared_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Scans = std::vector<std::size_t>;

// A yard seen from five places at their true poses; tests say which pairs hypotheses join.
class MergedScansTest : public ::testing::Test {
 protected:
  MergedScansTest() {
    component_ = component_of_one(0, s_.scans.size());
    for (std::size_t i = 1; i < s_.scans.size(); ++i) {
      component_.T_reference_scan[i] = s_.scene.T_target_source(0, i);
    }
  }
  void join(std::size_t a, std::size_t b) {
    pairs_.push_back({a, b, {{component_.T_reference_scan[a]->inverse() * *component_.T_reference_scan[b], 6}}});
  }
  PairGraph graph() const {
    std::vector<PointMoments> moments;
    for (const auto& scan : s_.scans) moments.push_back(scan.moments);
    return {pairs_, moments, 4 * s_.resolutions.coarse_m, {}};
  }
  // S put together by hand.
  Cloud all_of(const Scans& scans) const {
    MergedCloud cloud(s_.resolutions.coarse_m);
    for (const std::size_t i : scans) cloud.add(s_.scans[i].pyramid.level(0).cloud, *component_.T_reference_scan[i]);
    return cloud.level().cloud;
  }

  std::vector<std::size_t> add(MergedScans& s, std::size_t scan) const {
    return s.add(scan, *component_.T_reference_scan[scan]);
  }

  Rng rng_ = make_stream(1, "merged_scans_test");
  const testing::PreparedScene s_ =
      testing::prepared_scene({.num_scans = 5, .points_per_scan = 3000, .range_m = 9, .noise_m = 0.02}, rng_);
  Component component_;
  std::vector<ComparedPair> pairs_;
};

TEST_F(MergedScansTest, ScansJoinWhatHypothesesTieThemTo) {
  join(0, 1);
  join(1, 2);
  const PairGraph graph = this->graph();
  MergedScans s(s_.scans, graph, component_);
  EXPECT_FALSE(s.has(0));
  EXPECT_EQ(add(s, 0), Scans{1}) << "whose part of S is another one";
  EXPECT_TRUE(s.has(0));
  EXPECT_TRUE(s.joins(1));
  EXPECT_FALSE(s.joins(2));
  EXPECT_EQ(add(s, 1), Scans{2});
  EXPECT_TRUE(s.joins(2));
  EXPECT_TRUE(add(s, 3).empty());
}

TEST_F(MergedScansTest, WhatIsLeftGoesAlongWithItsMergedNeighbour) {
  join(0, 1);
  const PairGraph graph = this->graph();
  MergedScans s(s_.scans, graph, component_);
  const Eigen::Isometry3d motion = Eigen::Translation3d(1, 2, 3) * Eigen::Isometry3d::Identity();
  s.add(0, motion * *component_.T_reference_scan[0]);
  EXPECT_TRUE(s.pose(0).isApprox(motion * *component_.T_reference_scan[0]));
  EXPECT_TRUE(s.pose(1).isApprox(motion * *component_.T_reference_scan[1]));
  EXPECT_TRUE(s.pose(2).isApprox(*component_.T_reference_scan[2])) << "nothing joins it";
}

TEST_F(MergedScansTest, NearAScanIsWhatItsMergedNeighboursShow) {
  join(0, 2);
  join(1, 2);
  join(2, 3);
  const PairGraph graph = this->graph();
  MergedScans s(s_.scans, graph, component_);
  for (const std::size_t i : {0u, 1u, 4u}) add(s, i);
  const PyramidLevel near = s.near(2, 0);
  EXPECT_EQ(near.voxel_size_m, s_.resolutions.coarse_m);
  EXPECT_EQ(near.cloud.size(), all_of({0, 1}).size()) << "4 does not join it, 3 is not merged";
  EXPECT_EQ(near.index.size(), near.cloud.size());
  EXPECT_LT(all_of({0}).size(), near.cloud.size());
  const ScanPyramid pyramid = s.near(2);
  EXPECT_EQ(pyramid.num_levels(), kNumPyramidLevels);
  EXPECT_EQ(pyramid.level(0).cloud.size(), near.cloud.size());
}

TEST_F(MergedScansTest, WhatNothingJoinsMeetsWhatIsNearest) {
  const PairGraph graph = this->graph();
  MergedScans s(s_.scans, graph, component_);
  add(s, 1);
  EXPECT_EQ(s.near(4, 0).cloud.size(), all_of({1}).size());
}

TEST(MayMeet, OnlyWhatCannotIsRuledOut) {
  Rng rng = make_stream(2, "merged_scans_test");
  const auto s = testing::prepared_scene({.num_scans = 2, .points_per_scan = 2000, .range_m = 9}, rng);
  const Eigen::Isometry3d T = s.scene.T_target_source(0, 1);
  EXPECT_TRUE(may_meet(s.scans[0], s.scans[1], T, 0));
  double reach_m = 0;  // no point of either is farther than this from the origin
  for (const auto& scan : s.scans) {
    for (const auto& p : scan.fine.cloud.points) {
      reach_m = std::max(reach_m, p.norm());
      EXPECT_LE((p - scan.ball.centre).norm(), scan.ball.radius_m * (1 + 1e-12));
    }
  }
  EXPECT_FALSE(may_meet(s.scans[0], s.scans[1], Eigen::Translation3d(10 * reach_m, 0, 0) * T, reach_m));
  EXPECT_TRUE(may_meet(s.scans[0], s.scans[1], Eigen::Translation3d(10 * reach_m, 0, 0) * T, 10 * reach_m));
}

}  // namespace
}  // namespace tcm_icp
