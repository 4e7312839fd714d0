#include "adjustment/joint_matches.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;

class JointMatchesTest : public ::testing::Test {
 protected:
  JointMatchesTest() {
    for (std::size_t i = 0; i < s_.scans.size(); ++i) T_.push_back(s_.scene.T_target_source(0, i));
  }
  double gate_m() const { return kGateInVoxels * s_.resolutions.fine_m; }
  std::vector<JointLink> match(const ScanPairs& pairs, int num_threads = 1) const {
    return match_pairs(s_.scans, pairs, T_, gate_m(), num_threads);
  }

  Rng rng_ = make_stream(1, "joint_matches_test");
  const testing::PreparedScene s_ =
      testing::prepared_scene({.num_scans = 3, .points_per_scan = 3000, .range_m = 16, .noise_m = 0.01}, rng_);
  std::vector<Isometry3d> T_;
};

TEST_F(JointMatchesTest, EachPairIsMatchedBothWaysInItsOrder) {
  const auto links = match({{1, 2}, {0, 1}});
  ASSERT_EQ(links.size(), 4u);
  const std::vector<std::pair<std::size_t, std::size_t>> expected{{1, 2}, {2, 1}, {0, 1}, {1, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(std::pair(links[k].target, links[k].source), expected[k]);
    EXPECT_GT(links[k].matches.size(), 100u);
  }
}

TEST_F(JointMatchesTest, MatchesLieInTheCommonFrameWithinTheGate) {
  const Isometry3d T_common = testing::random_pose(20, rng_);
  const auto before = match({{0, 1}});
  for (auto& T : T_) T = T_common * T;
  const auto after = match({{0, 1}});
  ASSERT_EQ(after[0].matches.size(), before[0].matches.size());
  for (std::size_t i = 0; i < after[0].matches.size(); ++i) {
    const Correspondence &x = before[0].matches[i], &y = after[0].matches[i];
    ASSERT_TRUE(testing::is_near(T_common * x.source, y.source, 1e-9));
    ASSERT_TRUE(testing::is_near(T_common * x.target, y.target, 1e-9));
    ASSERT_TRUE(testing::is_near(T_common.linear() * x.normal, y.normal, 1e-9));
    ASSERT_LE((y.source - y.target).norm(), gate_m() * (1 + 1e-9));
  }
}

TEST_F(JointMatchesTest, ScansThatDoNotMeetHaveNoMatches) {
  T_[1] = Eigen::Translation3d(500, 0, 0) * T_[1];
  for (const JointLink& link : match({{0, 1}})) EXPECT_TRUE(link.matches.empty());
  EXPECT_TRUE(match({}).empty());
}

TEST_F(JointMatchesTest, ThreadsDoNotChangeABit) {
  const auto one = match({{0, 1}, {0, 2}, {1, 2}}), two = match({{0, 1}, {0, 2}, {1, 2}}, 2);
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_EQ(one[k].matches.size(), two[k].matches.size());
    for (std::size_t i = 0; i < one[k].matches.size(); ++i) {
      ASSERT_EQ(residual_m(one[k].matches[i]), residual_m(two[k].matches[i]));
    }
  }
}

TEST_F(JointMatchesTest, FramesMoveWithTheScans) {
  const auto frames = scan_frames(s_.scans, T_);
  const Isometry3d motion(Eigen::Translation3d(3, 4, 5));
  for (auto& T : T_) T = motion * T;
  const auto moved = scan_frames(s_.scans, T_);
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(testing::is_near(motion * frames[i].centre, moved[i].centre, 1e-9));
    EXPECT_NEAR(moved[i].radius_m, frames[i].radius_m, 1e-9);
    EXPECT_GT(frames[i].radius_m, 1);
  }
}

TEST(Thinned, KeepsEvenlySpacedMatchesOfEachLink) {
  std::vector<JointLink> links(2);
  for (int i = 0; i < 100; ++i) {
    Correspondence m;
    m.source = Eigen::Vector3d(i, 0, 0);
    m.target = m.source;
    m.normal = Eigen::Vector3d::UnitZ();
    links[0].matches.push_back(m);
  }
  links[1].matches.assign(3, links[0].matches.front());
  const auto thin = thinned(links, 10);
  ASSERT_EQ(thin[0].matches.size(), 10u);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(thin[0].matches[static_cast<std::size_t>(i)].source.x(), 10 * i);
  EXPECT_EQ(thin[1].matches.size(), 3u);
}

}  // namespace
}  // namespace tcm_icp
