#include "pipeline/merging.hpp"
#include "pipeline/link_score.hpp"

#include <gtest/gtest.h>

#include <set>

#include "pipeline/prepared_scene.hpp"
#include "pipeline/synthetic_links.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;

constexpr double kLinkAngle = 0.02, kLinkShift_m = 0.4;  // what fits of pairs are off by
constexpr double kStrong = 8, kWeak = 4;

// A yard seen from a few places, without guesses; tests add the links.
class MergingTest : public ::testing::Test {
 protected:
  void see_yard(std::size_t num_scans) {
    s_ = testing::prepared_scene({.num_scans = num_scans, .points_per_scan = 5000, .range_m = 18, .noise_m = 0.02},
                                 rng_);
    for (std::size_t i = 0; i < num_scans; ++i) files_.push_back(std::to_string(i) + ".ply");
    T_init_.assign(num_scans, std::nullopt);
    graph_ = PoseGraph(num_scans);
  }
  void link(std::size_t a, std::size_t b, double log_odds) {
    graph_.add({a, b, {testing::link_hypothesis(s_.scene, a, b, log_odds, kLinkAngle, kLinkShift_m, rng_)}});
  }
  void wrong_link(std::size_t a, std::size_t b, double log_odds) {
    graph_.add({a, b, {testing::link_hypothesis(s_.scene, a, b, log_odds, 2, 7, rng_)}});
  }
  Merging merging(std::size_t reference = 0) const {
    return {
        {s_.scans, files_, T_init_, graph_, options_, context_}, reference, std::vector<bool>(s_.scans.size(), true)};
  }
  double error_m(const Merging& m, std::size_t i) const {
    return testing::pose_rmse_m(s_.scene.T_target_source(m.reference(), i), m.T_reference_scan()[i],
                                s_.scene.scans[i].points);
  }
  double tolerance_m() const { return 0.1 * s_.resolutions.coarse_m; }  // as of placements from a guess
  static std::vector<std::size_t> order(const std::vector<MergeRecord>& records) {
    std::vector<std::size_t> scans;
    for (const auto& r : records) scans.push_back(r.scan);
    return scans;
  }

  Rng rng_ = make_stream(1, "merging_test");
  PreparedScene s_;
  std::vector<std::string> files_;
  std::vector<std::optional<Isometry3d>> T_init_;
  PoseGraph graph_{0};
  PipelineOptions options_;
  RunContext context_;
  std::vector<MergeRecord> records_;
};

TEST_F(MergingTest, ScansArePlacedByAChainOfLinks) {
  see_yard(3);
  ASSERT_GT(kLinkShift_m, 5 * tolerance_m()) << "the links alone are not enough";
  link(1, 2, kStrong);
  link(0, 1, kStrong);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(order(records_), (std::vector<std::size_t>{1, 2})) << "2 has no link to the reference";
  EXPECT_EQ(m.placed(), std::vector<bool>(3, true));
  EXPECT_EQ(m.unplaced(), std::vector<bool>(3, false));
  for (const std::size_t i : {1u, 2u}) EXPECT_LE(error_m(m, i), tolerance_m()) << i;
  for (const auto& record : records_) {
    EXPECT_TRUE(record.accepted) << record.reason;
    EXPECT_EQ(record.attempt, 1);
    EXPECT_EQ(record.evidence->link_log_odds, kStrong);
    EXPECT_EQ(record.evidence->num_links, 1u);
    EXPECT_GT(record.tcm.tau(), 0);
  }
}

TEST_F(MergingTest, AnyScanMayBeTheReference) {
  see_yard(3);
  link(0, 1, kStrong);
  link(1, 2, kStrong);
  Merging m = merging(2);
  m.run(records_);
  EXPECT_EQ(m.placed(), std::vector<bool>(3, true));
  for (const std::size_t i : {0u, 1u}) EXPECT_LE(error_m(m, i), tolerance_m()) << i;
}

TEST_F(MergingTest, AWrongLinkIsRefusedHoweverLikelyItLooked) {
  see_yard(3);
  link(0, 1, kStrong);
  wrong_link(0, 2, 2 * kStrong);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(m.placed(), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(m.unplaced(), (std::vector<bool>{false, false, true}));
  EXPECT_LE(error_m(m, 1), tolerance_m());
}

// Its verification alone would let it pass: the pose is right. But nothing tells it from chance.
TEST_F(MergingTest, AScanWhoseLinksContradictOneAnotherIsLeftOut) {
  see_yard(3);
  link(0, 1, kStrong);
  link(1, 2, kStrong);
  wrong_link(0, 2, kStrong - 1);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(m.placed(), (std::vector<bool>{true, true, false}));
}

TEST_F(MergingTest, LinksThatAgreeOutvoteAWrongOne) {
  see_yard(4);
  link(0, 1, kStrong);
  link(0, 3, kStrong);
  link(1, 2, kWeak);
  link(2, 3, kWeak);
  wrong_link(0, 2, kWeak);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(m.placed(), std::vector<bool>(4, true));
  EXPECT_LE(error_m(m, 2), tolerance_m());
  EXPECT_DOUBLE_EQ(records_.back().evidence->link_log_odds, 2 * kWeak - (kWeak - kDoubtLogOdds));
  EXPECT_EQ(records_.back().evidence->num_links, 2u);
}

TEST_F(MergingTest, WeakScansComeAfterStrongOnes) {
  see_yard(4);
  link(0, 1, kWeak);
  link(0, 2, kStrong);
  link(2, 3, kStrong);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(order(records_), (std::vector<std::size_t>{2, 3, 1}));
  EXPECT_EQ(m.placed(), std::vector<bool>(4, true));
}

TEST_F(MergingTest, TheOrderAskedForIsKept) {
  see_yard(4);
  for (std::size_t i = 1; i < 4; ++i) link(0, i, kStrong);
  std::set<std::vector<std::size_t>> drawn;
  for (const MergeOrder wanted :
       {MergeOrder::kFile, MergeOrder::kOverlap, MergeOrder::kPaperTcm, MergeOrder::kRobustTcm, MergeOrder::kRandom}) {
    for (context_.seed = 0; context_.seed < (wanted == MergeOrder::kRandom ? 8u : 1u); ++context_.seed) {
      options_.merge_order = wanted;
      records_.clear();
      Merging m = merging();
      m.run(records_);
      EXPECT_EQ(m.placed(), std::vector<bool>(4, true)) << static_cast<int>(wanted);
      if (wanted == MergeOrder::kFile) {
        EXPECT_EQ(order(records_), (std::vector<std::size_t>{1, 2, 3}));
      }
      if (wanted == MergeOrder::kRandom) drawn.insert(order(records_));
    }
  }
  EXPECT_GT(drawn.size(), 1u) << "of 6 orders, 8 draws must not give the same one every time";
}

TEST_F(MergingTest, TcmIsTheRobustOneUnlessThePapersIsAskedFor) {
  see_yard(3);
  link(0, 1, kStrong);
  link(0, 2, kStrong);
  std::vector<double> tau;
  for (const MergeOrder wanted : {MergeOrder::kTcm, MergeOrder::kRobustTcm, MergeOrder::kPaperTcm}) {
    options_.merge_order = wanted;
    records_.clear();
    Merging m = merging();
    m.run(records_);
    ASSERT_FALSE(records_.empty());
    tau.push_back(records_.front().tcm.tau());
  }
  EXPECT_EQ(tau[0], tau[1]);
  EXPECT_NE(tau[0], tau[2]);
}

TEST_F(MergingTest, LinksThatAreTooWeakAreNotTried) {
  see_yard(3);
  link(0, 1, kStrong);
  link(0, 2, kMinLinkLogOdds - 0.1);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(order(records_), (std::vector<std::size_t>{1}));
}

TEST_F(MergingTest, AScanSetAsideIsTriedAgainWithANewNeighbour) {
  see_yard(3);
  wrong_link(0, 2, kStrong);
  link(0, 1, kWeak);
  link(1, 2, 2 * kStrong);
  Merging m = merging();
  m.run(records_);
  ASSERT_EQ(order(records_), (std::vector<std::size_t>{2, 1, 2})) << records_[0].reason << error_m(m, 2);
  EXPECT_FALSE(records_[0].accepted);
  EXPECT_EQ(records_[2].attempt, 2);
  EXPECT_EQ(m.placed(), std::vector<bool>(3, true));
  EXPECT_LE(error_m(m, 2), tolerance_m());
}

// As after a further search: the graph belongs to the caller.
TEST_F(MergingTest, GoesOnWhenTheGraphHasGotMoreLinks) {
  see_yard(3);
  link(0, 1, kStrong);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(order(records_), (std::vector<std::size_t>{1}));
  link(1, 2, kStrong);
  m.run(records_);
  EXPECT_EQ(order(records_), (std::vector<std::size_t>{1, 2}));
  EXPECT_LE(error_m(m, 2), tolerance_m());
}

TEST_F(MergingTest, ScansNotWantedAreLeftAlone) {
  see_yard(3);
  link(0, 1, kStrong);
  link(0, 2, kStrong);
  Merging m({s_.scans, files_, T_init_, graph_, options_, context_}, 0, {true, false, true});
  m.run(records_);
  EXPECT_EQ(m.placed(), (std::vector<bool>{true, false, true}));
  EXPECT_EQ(m.unplaced(), std::vector<bool>(3, false));
}

TEST_F(MergingTest, GuessesAndLinksGoTogether) {
  see_yard(3);
  const Points& points = s_.scene.scans[1].points;
  T_init_[0] = s_.scene.T_world_scan[0];
  T_init_[1] = testing::perturbed(s_.scene.T_world_scan[1], points, 0.1, 1, rng_);
  link(1, 2, kStrong);
  Merging m = merging();
  m.run(records_);
  EXPECT_EQ(order(records_), (std::vector<std::size_t>{1, 2}));
  for (const std::size_t i : {1u, 2u}) EXPECT_LE(error_m(m, i), tolerance_m()) << i;
  EXPECT_TRUE(std::isnan(records_[0].evidence->link_log_odds)) << "no link was asked about it";
}

}  // namespace
}  // namespace tcm_icp
