#include "inference/implied_poses.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "inference/hypothesis_world.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;
using testing::kSame_m;

using testing::kRounding;

constexpr double kClearLead = 6;

bool everywhere(std::size_t, std::size_t, const Eigen::Isometry3d&) { return true; }

class ImpliedPosesTest : public ::testing::Test {
 protected:
  // Those that no hypothesis leads to.
  std::vector<ImpliedPose> implied(const Component& component) const {
    std::vector<ImpliedPose> found =
        implied_poses(world_.graph(), component, weakest_cuts(world_.graph(), component), kClearLead, everywhere);
    std::erase_if(found, [](const ImpliedPose& pose) { return pose.agrees; });
    return found;
  }
  bool is_near(const ImpliedPose& pose, double off_m) const {
    const Eigen::Isometry3d T = world_.T_target_source(pose.a, pose.b) * Eigen::Translation3d(0, off_m, 0);
    return testing::is_pose_near(T, pose.T_a_b, kRounding, kRounding);
  }

  Rng rng_ = make_stream(1, "implied_poses_test");
  HypothesisWorld world_{5, rng_};
};

TEST_F(ImpliedPosesTest, PairsWithoutAHypothesisThatAgreesHaveThePoseOfTheirScans) {
  world_.add(0, 1, {world_.hypothesis(0, 1, 8)});
  world_.add(1, 2, {world_.aside(1, 2, 8, 0.2 * kSame_m)});  // agrees
  world_.add(2, 3, {world_.aside(2, 3, -9, 20 * kSame_m)});  // does not
  const auto found = implied(world_.truth({2, 0, 1, 3}));
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const ImpliedPose& pose : found) {
    pairs.emplace_back(pose.a, pose.b);
    EXPECT_TRUE(is_near(pose, 0)) << pose.a << " " << pose.b;
  }
  std::sort(pairs.begin(), pairs.end());
  EXPECT_EQ(pairs, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}, {0, 3}, {1, 3}, {2, 3}}));
  const Component component = world_.truth({2, 0, 1, 3});
  const auto all =
      implied_poses(world_.graph(), component, weakest_cuts(world_.graph(), component), kClearLead, everywhere);
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const ImpliedPose& p) { return p.configuration == 0; }), 6)
      << "those that agree are named, too";
}

TEST_F(ImpliedPosesTest, PosesAtWhichScansCannotOverlapAreLeftOut) {
  world_.add(0, 1, {world_.hypothesis(0, 1, 8)});
  const auto without_two = [](std::size_t a, std::size_t b, const Eigen::Isometry3d&) { return a != 2 && b != 2; };
  const Component component = world_.truth({0, 1, 2, 3});
  const auto found =
      implied_poses(world_.graph(), component, weakest_cuts(world_.graph(), component), kClearLead, without_two);
  ASSERT_EQ(found.size(), 3u);
  for (const ImpliedPose& pose : found) EXPECT_TRUE(pose.a != 2 && pose.b != 2);
}

// 3 lies half a metre aside by one of its pairs, which is one pose to inference and may be a wall's other face: the
// other pair is asked there, too, and the first where the other put it.
TEST_F(ImpliedPosesTest, PosesThatAFitTellsApartAreAskedByTheOtherPairs) {
  world_.add(0, 1, {world_.hypothesis(0, 1, 8)});
  world_.add(1, 3, {world_.hypothesis(1, 3, 8)});
  world_.add(0, 3, {world_.aside(0, 3, 3, 0.5 * kSame_m)});
  const auto found = implied(world_.truth({0, 1, 3}));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(std::pair(found[0].a, found[0].b), std::pair(std::size_t{0}, std::size_t{3}));
  EXPECT_TRUE(is_near(found[0], 0)) << "no hypothesis leads there";
  EXPECT_EQ(found[0].configuration, 0u);
  EXPECT_EQ(std::pair(found[1].a, found[1].b), std::pair(std::size_t{0}, std::size_t{1})) << "where 0 is the other";
  EXPECT_EQ(std::pair(found[2].a, found[2].b), std::pair(std::size_t{1}, std::size_t{3}));
  EXPECT_TRUE(is_near(found[2], 0.5 * kSame_m));
  EXPECT_NE(found[1].configuration, 0u);
  EXPECT_NE(found[2].configuration, found[1].configuration);
}

TEST_F(ImpliedPosesTest, UnlikelyHypothesesImplyNothingBeside) {
  world_.add(0, 1, {world_.hypothesis(0, 1, 8)});
  world_.add(1, 3, {world_.hypothesis(1, 3, 8)});
  world_.add(0, 3, {world_.hypothesis(0, 3, 8), world_.aside(0, 3, -1, 0.5 * kSame_m)});
  EXPECT_TRUE(implied(world_.truth({0, 1, 3})).empty());
}

// 3 fits as well 7 m aside by one of its pairs: the other is asked there, too.
TEST_F(ImpliedPosesTest, TheOtherPlaceOfAWeakCutIsAskedNoLess) {
  for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 3u), std::pair(1u, 3u)}) {
    world_.add(a, b, {world_.hypothesis(a, b, 4)});
  }
  world_.add(0, 3, {world_.aside(0, 3, 7, 7)});
  const auto found = implied(world_.truth({0, 1, 3}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].a, 1u);
  EXPECT_EQ(found[0].b, 3u);
  EXPECT_TRUE(is_near(found[0], 7));
  EXPECT_NE(found[0].configuration, 0u);
}

TEST_F(ImpliedPosesTest, WhereALeadIsClearNoOtherPlaceIsAsked) {
  for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 3u), std::pair(1u, 3u)}) {
    world_.add(a, b, {world_.hypothesis(a, b, 8)});
  }
  world_.add(0, 3, {world_.aside(0, 3, 2, 7)});
  EXPECT_TRUE(implied(world_.truth({0, 1, 3})).empty());
}

}  // namespace
}  // namespace tcm_icp
