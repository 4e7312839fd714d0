#include "pipeline/group_joining.hpp"

#include <gtest/gtest.h>

#include "pipeline/prepared_scene.hpp"
#include "pipeline/synthetic_links.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

// Two groups of a yard's scans, or of a yard's and of another place's, that no link joins.
class GroupJoiningTest : public ::testing::Test {
 protected:
  void see_yard(std::size_t num_scans) {
    s_ = testing::prepared_scene({.num_scans = num_scans, .points_per_scan = 5000, .range_m = 14, .noise_m = 0.02},
                                 rng_);
    name_files();
  }
  void name_files() {
    for (std::size_t i = 0; i < s_.scans.size(); ++i) files_.push_back(std::to_string(i) + ".ply");
    T_init_.assign(s_.scans.size(), std::nullopt);
    graph_ = PoseGraph(s_.scans.size());
  }
  void group(const std::vector<std::size_t>& members) {
    AdjustedSet set = set_of_one(members.front(), s_.scans.size());
    for (const std::size_t i : members) {
      set.placed[i] = true;
      set.T_reference_scan[i] = s_.scene.T_target_source(set.reference, i);
      if (i != set.reference) set.evidence[i] = AlignmentEvidence{};
    }
    sets_.push_back(set);
  }
  std::optional<GroupJoin> join() {
    return join_groups({s_.scans, files_, T_init_, graph_, options_, context_}, s_.resolutions, sets_, records_);
  }
  double error_m(const AdjustedSet& set, std::size_t i) const {
    return testing::pose_rmse_m(s_.scene.T_target_source(set.reference, i), set.T_reference_scan[i],
                                s_.scene.scans[i].points);
  }

  Rng rng_ = make_stream(1, "group_joining_test");
  PreparedScene s_;
  std::vector<std::string> files_;
  std::vector<std::optional<Isometry3d>> T_init_;
  PoseGraph graph_{0};
  PipelineOptions options_;
  RunContext context_;
  std::vector<AdjustedSet> sets_;
  std::vector<MergeRecord> records_;
};

TEST_F(GroupJoiningTest, GroupsThatSeeTheSamePlaceBecomeOne) {
  see_yard(5);
  group({1, 0, 2});
  group({4, 3});
  const auto found = join();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->parts, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(found->set.reference, 1u) << "the first keeps its own";
  EXPECT_EQ(found->set.num_placed(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_LE(error_m(found->set, i), 0.2 * s_.resolutions.coarse_m) << i;
  EXPECT_TRUE(found->set.evidence[4]) << "the reference of the group that joined is a member like others";
  ASSERT_EQ(records_.size(), 1u);
  EXPECT_EQ(records_[0].scan, 4u);
  EXPECT_EQ(records_[0].members, (std::vector<std::size_t>{3, 4}));
  EXPECT_TRUE(records_[0].accepted) << records_[0].reason;
}

TEST_F(GroupJoiningTest, AScanAloneJoinsAGroup) {
  see_yard(4);
  group({0, 1, 2});
  const auto found = join();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->set.num_placed(), 4u);
  EXPECT_LE(error_m(found->set, 3), 0.2 * s_.resolutions.coarse_m);
  EXPECT_GT(found->set.group_log_odds[3], 0) << "its link to the group is all that speaks for it";
  EXPECT_EQ(found->set.group_log_odds[1], 0);
}

TEST_F(GroupJoiningTest, LinksBetweenMembersThatLeadElsewhereSpeakAgainstAJoin) {
  see_yard(4);
  group({0, 1});
  group({2, 3});
  ASSERT_TRUE(join());
  for (const std::size_t a : {0u, 1u}) {
    for (const std::size_t b : {2u, 3u}) {
      graph_.add({a, b, {testing::link_hypothesis(s_.scene, a, b, 9, 2, 7, rng_)}});
    }
  }
  EXPECT_FALSE(join());
}

TEST_F(GroupJoiningTest, GroupsOfDifferentPlacesStayApart) {
  s_ = testing::prepared_scene({.num_scans = 2, .points_per_scan = 5000, .range_m = 14, .noise_m = 0.02}, rng_);
  PreparedScene rubble = testing::prepared_scene({.shape = testing::SyntheticShape::kRubble,
                                                  .num_scans = 2,
                                                  .points_per_scan = 5000,
                                                  .range_m = 14,
                                                  .noise_m = 0.02},
                                                 rng_);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string file = std::to_string(i + 2) + ".ply";
    s_.scans.push_back(prepare_scan(testing::sampled(rubble.scene.scans[i], file), s_.resolutions, {}, 42));
    s_.scene.scans.push_back(rubble.scene.scans[i]);
    s_.scene.T_world_scan.push_back(rubble.scene.T_world_scan[i]);
  }
  name_files();
  group({0, 1});
  group({2, 3});
  EXPECT_FALSE(join());
}

TEST_F(GroupJoiningTest, SingleScansAloneAreNoGroups) {
  see_yard(2);
  EXPECT_FALSE(join()) << "their links are known already";
  group({0, 1});
  EXPECT_FALSE(join()) << "nothing is left to join";
  EXPECT_TRUE(records_.empty());
}

}  // namespace
}  // namespace tcm_icp
