#include "merging/merging.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Scans = std::vector<std::size_t>;

// A yard seen from five places; tests say which pairs of them hypotheses join, and where inference has put them.
class MergingTest : public ::testing::Test {
 protected:
  MergingTest() { truth({0, 1, 2, 3, 4}); }

  double voxel_m() const { return s_.resolutions.coarse_m; }
  double tolerance_m() const { return 0.1 * voxel_m(); }  // as of fits to a cloud
  void truth(const Scans& members) {
    component_ = component_of_one(members.front(), s_.scans.size());
    for (const std::size_t i : members) component_.T_reference_scan[i] = s_.scene.T_target_source(members.front(), i);
  }
  /// As fits of pairs leave it.
  void put_off(double angle_rad, double shift_m) {
    for (const std::size_t i : component_.members()) {
      if (i == component_.reference) continue;
      auto& T = *component_.T_reference_scan[i];
      T = testing::perturbed(T, s_.scene.scans[i].points, angle_rad, shift_m, rng_);
    }
  }
  void join(std::size_t a, std::size_t b) {
    pairs_.push_back({a, b, {{component_.T_reference_scan[a]->inverse() * *component_.T_reference_scan[b], 6}}});
  }
  std::vector<MergeRecord> merge() {
    std::vector<PointMoments> moments;
    for (const auto& scan : s_.scans) moments.push_back(scan.moments);
    return merge_in_tcm_order(s_.scans, PairGraph(pairs_, moments, same_m_, {}), options_, context_, component_);
  }
  static Scans order(const std::vector<MergeRecord>& records) {
    Scans scans;
    for (const auto& r : records) scans.push_back(r.scan);
    return scans;
  }
  double error_m(std::size_t i) const {
    return testing::pose_rmse_m(s_.scene.T_target_source(component_.reference, i), *component_.T_reference_scan[i],
                                s_.scene.scans[i].points);
  }

  Rng rng_ = make_stream(1, "merging_test");
  const testing::PreparedScene s_ =
      testing::prepared_scene({.num_scans = 5, .points_per_scan = 4000, .range_m = 16, .noise_m = 0.02}, rng_);
  MergeOptions options_;
  RunContext context_;
  Component component_;
  std::vector<ComparedPair> pairs_;
  double same_m_ = 4 * s_.resolutions.coarse_m;
};

TEST_F(MergingTest, PosesOffByAVoxelEndNearTheTruth) {
  put_off(0.02, voxel_m());
  for (std::size_t i = 1; i < 5; ++i) {
    join(0, i);
    ASSERT_GT(error_m(i), 5 * tolerance_m()) << i;
  }
  const Isometry3d T_reference = *component_.T_reference_scan[0];
  const auto records = merge();
  ASSERT_EQ(records.size(), 4u);
  for (const auto& record : records) {
    EXPECT_TRUE(record.accepted) << record.reason;
    EXPECT_TRUE(record.simplex.usable());
    EXPECT_GT(record.tcm.tau(), 0);
    EXPECT_LE(error_m(record.scan), tolerance_m()) << record.scan;
  }
  Scans merged = order(records);
  std::sort(merged.begin(), merged.end());
  EXPECT_EQ(merged, (Scans{1, 2, 3, 4})) << "each once";
  EXPECT_TRUE(component_.T_reference_scan[0]->isApprox(T_reference, 0)) << "the reference stays";
}

TEST_F(MergingTest, AnyMemberMayBeTheReferenceAndOthersAreLeftAlone) {
  truth({3, 1, 2});
  put_off(0.02, voxel_m());
  join(1, 3);
  join(2, 3);
  ASSERT_GT(error_m(1), 5 * tolerance_m());
  EXPECT_EQ(merge().size(), 2u);
  EXPECT_EQ(component_.members(), (Scans{1, 2, 3}));
  EXPECT_EQ(component_.reference, 3u);
  for (const std::size_t i : {1u, 2u}) EXPECT_LE(error_m(i), tolerance_m()) << i;
}

// With the smallest same_m every fit that moves leads elsewhere.
TEST_F(MergingTest, AFitThatLeadsElsewhereIsNotTaken) {
  truth({0, 1, 2});
  put_off(0.02, voxel_m());
  join(0, 1);
  join(0, 2);
  const Component inferred = component_;
  same_m_ = 0.3 * voxel_m();
  const auto records = merge();
  ASSERT_EQ(records.size(), 2u);
  for (const auto& record : records) {
    EXPECT_FALSE(record.accepted);
    EXPECT_TRUE(record.simplex.usable());
    EXPECT_NE(record.reason.find("elsewhere"), std::string::npos) << record.reason;
    EXPECT_TRUE(testing::is_pose_near(*inferred.T_reference_scan[record.scan],
                                      *component_.T_reference_scan[record.scan], 1e-12, 1e-12));
  }
}

TEST_F(MergingTest, WhatCannotBeFittedIsMergedWhereItsLinksLead) {
  truth({0, 1});
  join(0, 1);
  component_.T_reference_scan[1] = Eigen::Translation3d(500, 0, 0) * *component_.T_reference_scan[1];
  const Isometry3d inferred = *component_.T_reference_scan[1];
  const auto records = merge();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_FALSE(records[0].accepted);
  EXPECT_FALSE(records[0].simplex.usable());
  EXPECT_NE(records[0].reason.find("links"), std::string::npos) << records[0].reason;
  EXPECT_TRUE(testing::is_pose_near(inferred, *component_.T_reference_scan[1], 0, 0));
}

TEST_F(MergingTest, WithoutFitsPosesStayWhereInferenceHasPutThem) {
  put_off(0.02, voxel_m());
  for (std::size_t i = 1; i < 5; ++i) join(0, i);
  const Component inferred = component_;
  options_.fits = false;
  const auto records = merge();
  ASSERT_EQ(records.size(), 4u);
  for (const auto& record : records) {
    EXPECT_TRUE(record.accepted);
    EXPECT_EQ(record.simplex.termination, Termination::kNotRun);
    EXPECT_GT(record.tcm.tau(), 0);
    EXPECT_TRUE(testing::is_pose_near(*inferred.T_reference_scan[record.scan],
                                      *component_.T_reference_scan[record.scan], 0, 0));
  }
}

// Inference has put 1 and all that hangs by it aside by more than one pose: once 1 is fitted, its follower goes along.
TEST_F(MergingTest, WhatAFitMovesTakesAlongWhatHangsByIt) {
  truth({0, 1, 2});
  const Eigen::Isometry3d aside = Eigen::Isometry3d(Eigen::Translation3d(1.2 * voxel_m(), 0, 0));
  join(0, 1);
  join(1, 2);
  for (const std::size_t i : {1u, 2u}) component_.T_reference_scan[i] = aside * *component_.T_reference_scan[i];
  component_.T_reference_scan[2] = aside * *component_.T_reference_scan[2];
  pairs_.back() = {1, 2, {{component_.T_reference_scan[1]->inverse() * *component_.T_reference_scan[2], 6}}};
  same_m_ = 1.8 * voxel_m();
  ASSERT_GT(error_m(2), same_m_);
  for (const auto& record : merge()) EXPECT_TRUE(record.accepted) << record.scan << ' ' << record.reason;
  for (const std::size_t i : {1u, 2u}) EXPECT_LE(error_m(i), tolerance_m()) << i;
}

// A chain: whatever tau says, each comes after the one it hangs by.
TEST_F(MergingTest, ScansThatHypothesesJoinToWhatIsMergedComeFirst) {
  join(3, 4);
  join(0, 3);
  join(2, 4);
  join(1, 2);
  EXPECT_EQ(order(merge()), (Scans{3, 4, 2, 1}));
}

TEST_F(MergingTest, ScansThatNothingJoinsComeLast) {
  join(0, 4);
  join(2, 4);
  const Scans merged = order(merge());
  ASSERT_EQ(merged.size(), 4u);
  EXPECT_EQ(Scans(merged.begin(), merged.begin() + 2), (Scans{4, 2}));
}

TEST_F(MergingTest, TheOrderAskedForIsKept) {
  for (std::size_t i = 1; i < 5; ++i) join(0, i);
  options_.order = MergeOrder::kFile;
  EXPECT_EQ(order(merge()), (Scans{1, 2, 3, 4}));
}

TEST_F(MergingTest, OneScanAloneIsMergedAlready) {
  component_ = component_of_one(2, 5);
  EXPECT_TRUE(merge().empty());
  EXPECT_EQ(component_.members(), Scans{2});
}

TEST_F(MergingTest, ThreadsDoNotChangeABit) {
  put_off(0.02, voxel_m());
  for (std::size_t i = 1; i < 5; ++i) join(0, i);
  const Component start = component_;
  const auto one = merge();
  const Component by_one = component_;
  component_ = start;
  context_.num_threads = 2;
  EXPECT_EQ(order(merge()), order(one));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(by_one.T_reference_scan[i]->matrix() == component_.T_reference_scan[i]->matrix()) << i;
  }
}

TEST_F(MergingTest, StopsWhenAsked) {
  join(0, 1);
  context_.on_progress = [](const Progress& p) { return p.stage == "merging" ? Continue::kStop : Continue::kYes; };
  EXPECT_THROW(merge(), Cancelled);
}

}  // namespace
}  // namespace tcm_icp
