#include "inference/configuration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "inference/hypothesis_world.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::HypothesisWorld;
using testing::kSame_m;

using testing::kRounding;

class ConfigurationTest : public ::testing::Test {
 protected:
  // Each scan with the next and the one after it, as stations along a block have it.
  static HypothesisWorld loop(std::size_t num_scans, double noise_m, Rng& rng) {
    HypothesisWorld world(num_scans, rng);
    for (std::size_t i = 0; i < num_scans; ++i) {
      for (const std::size_t step : {1u, 2u}) {
        const std::size_t j = (i + step) % num_scans, a = std::min(i, j), b = std::max(i, j);
        world.add(a, b, {world.noisy(a, b, 4 + uniform01(rng), noise_m / 200, noise_m, rng)});
      }
    }
    return world;
  }

  Rng rng_ = make_stream(1, "configuration_test");
};

TEST_F(ConfigurationTest, WithoutHypothesesThereIsNoComponent) {
  EXPECT_TRUE(likeliest_components(HypothesisWorld(4, rng_).graph()).empty());
  HypothesisWorld compared_in_vain(3, rng_);
  compared_in_vain.add(0, 1, {});
  EXPECT_TRUE(likeliest_components(compared_in_vain.graph()).empty());
}

// Six of 20 pairs have a wrong hypothesis that is likelier than any right one, two of them beside no right one.
TEST_F(ConfigurationTest, ExactPosesOfALoopAreFoundAmongStrongerWrongOnes) {
  HypothesisWorld world = loop(10, 0, rng_);
  std::vector<ComparedPair> pairs = world.pairs();
  for (const std::size_t k : {1u, 5u, 9u, 14u}) pairs[k].hypotheses.push_back(world.wrong(7, rng_));
  for (const std::size_t k : {3u, 12u}) pairs[k].hypotheses = {world.wrong(7, rng_)};
  const auto components = likeliest_components(world.graph(pairs));
  ASSERT_EQ(components.size(), 1u);
  EXPECT_EQ(components[0].size(), 10u);
  EXPECT_LE(world.worst_error_m(components[0]), kRounding);
}

// A pose is a product of hypotheses, so that what fits are off by adds up, at most over seven of them; a turn of a
// two-hundredth of noise_m [rad] moves scans 100 m away by half of it.
TEST_F(ConfigurationTest, NoisyHypothesesOfALoopWithWrongOnesLeadNearTheTruth) {
  const double noise_m = 0.1 * kSame_m;
  for (int trial = 0; trial < 20; ++trial) {
    HypothesisWorld world = loop(8, noise_m, rng_);
    std::vector<ComparedPair> pairs = world.pairs();
    for (auto& pair : pairs) {
      if (uniform01(rng_) < 0.3) pair.hypotheses.push_back(world.wrong(6 * uniform01(rng_), rng_));
    }
    const auto components = likeliest_components(world.graph(pairs));
    ASSERT_EQ(components.size(), 1u) << trial;
    EXPECT_EQ(components[0].size(), 8u) << trial;
    EXPECT_LE(world.worst_error_m(components[0]), 8 * noise_m) << trial;
  }
}

TEST_F(ConfigurationTest, ComponentsThatNothingJoinsComeTheLargestFirst) {
  HypothesisWorld world(7, rng_);
  for (const auto& [a, b] : {std::pair(0u, 5u), std::pair(0u, 6u), std::pair(5u, 6u)}) {
    world.add(a, b, {world.hypothesis(a, b, 6)});
  }
  for (const auto& [a, b] : {std::pair(1u, 2u), std::pair(2u, 3u), std::pair(3u, 4u)}) {
    world.add(a, b, {world.hypothesis(a, b, 2)});
  }
  const auto components = likeliest_components(world.graph());
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0].members(), (std::vector<std::size_t>{1, 2, 3, 4})) << "the less likely, but the larger";
  EXPECT_EQ(components[1].members(), (std::vector<std::size_t>{0, 5, 6}));
  for (const auto& component : components) EXPECT_LE(world.worst_error_m(component), kRounding);
}

TEST_F(ConfigurationTest, AScanWithBadHypothesesAloneIsInNoComponent) {
  HypothesisWorld world(4, rng_);
  for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)}) {
    world.add(a, b, {world.hypothesis(a, b, 4)});
  }
  const auto members = [&] {
    const auto components = likeliest_components(world.graph());
    EXPECT_EQ(components.size(), 1u);
    return components.at(0).members();
  };
  world.add(0, 3, {world.aside(0, 3, -0.5, 9), world.aside(0, 3, -1, 18)});
  world.add(1, 3, {world.aside(1, 3, -0.5, -9)});
  EXPECT_EQ(members(), (std::vector<std::size_t>{0, 1, 2}));
  world.add(2, 3, {world.aside(2, 3, -0.5, -9)});
  EXPECT_EQ(members().size(), 4u) << "two of them agree";
}

// Two strong wrong pairs against three weaker right ones that agree.
TEST_F(ConfigurationTest, HypothesesThatAgreeOutvoteStrongerOnesThatDoNot) {
  HypothesisWorld world(4, rng_);
  for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)}) {
    world.add(a, b, {world.hypothesis(a, b, 4)});
  }
  world.add(0, 3, {world.aside(0, 3, 7, 15), world.hypothesis(0, 3, 1)});
  world.add(1, 3, {world.aside(1, 3, 6, -15), world.hypothesis(1, 3, 1)});
  world.add(2, 3, {world.hypothesis(2, 3, 1)});
  const auto components = likeliest_components(world.graph());
  ASSERT_EQ(components.size(), 1u);
  ASSERT_EQ(components[0].size(), 4u);
  EXPECT_LE(world.worst_error_m(components[0]), kRounding);
}

// Two groups, each sure of itself. What joins them puts them wrong, and fits of other pairs from there say so: growing
// hangs a group by its first scan, and would keep it for what its own pairs are worth.
TEST_F(ConfigurationTest, AGroupThatPairsSpeakAgainstIsAComponentOfItsOwn) {
  HypothesisWorld world(6, rng_);
  for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u), std::pair(3u, 4u),
                             std::pair(3u, 5u), std::pair(4u, 5u)}) {
    world.add(a, b, {world.hypothesis(a, b, 6)});
  }
  const Isometry3d off(Eigen::Translation3d(0, 20, 0));
  world.add(2, 3, {world.hypothesis(2, 3, 2, off)});
  EXPECT_EQ(likeliest_components(world.graph())[0].size(), 6u) << "nothing speaks against it";
  for (const auto& [a, b] : {std::pair(0u, 3u), std::pair(0u, 4u), std::pair(1u, 4u), std::pair(2u, 5u)}) {
    const Isometry3d T_3_b = b == 3 ? Isometry3d::Identity() : world.T_target_source(3, b);
    world.add(a, b, {{world.T_target_source(a, 3) * off * T_3_b, -9, true}});
  }
  const auto components = likeliest_components(world.graph());
  ASSERT_EQ(components.size(), 2u);
  for (const Component& component : components) {
    EXPECT_EQ(component.size(), 3u);
    EXPECT_LE(world.worst_error_m(component), kRounding);
  }
}

TEST_F(ConfigurationTest, TheReferenceIsTheMemberWithTheMostSupport) {
  HypothesisWorld world(5, rng_);
  for (const std::size_t i : {0u, 1u, 2u, 4u}) {
    world.add(std::min<std::size_t>(i, 3), std::max<std::size_t>(i, 3),
              {world.hypothesis(std::min<std::size_t>(i, 3), std::max<std::size_t>(i, 3), 4)});
  }
  const auto components = likeliest_components(world.graph());
  ASSERT_EQ(components.size(), 1u);
  EXPECT_EQ(components[0].reference, 3u);
  EXPECT_TRUE(components[0].T_reference_scan[3]->isApprox(Isometry3d::Identity(), 0));
}

// Of hypotheses that agree either may be the one a scan is put by, so that with noise poses are one but for the noise.
TEST_F(ConfigurationTest, TheOrderOfPairsAndHypothesesDoesNotMatter) {
  for (int trial = 0; trial < 6; ++trial) {
    const double noise_m = trial % 2 == 0 ? 0 : 0.05 * kSame_m;
    HypothesisWorld world = loop(7, noise_m, rng_);
    std::vector<ComparedPair> pairs = world.pairs();
    for (auto& pair : pairs) {
      pair.hypotheses.push_back(world.wrong(5 * uniform01(rng_) - 1, rng_));
    }
    const PairGraph graph = world.graph(pairs);
    const auto expected = likeliest_components(graph);
    for (std::size_t i = pairs.size(); i > 1; --i) std::swap(pairs[i - 1], pairs[uniform_index(rng_, i)]);
    for (auto& pair : pairs) std::reverse(pair.hypotheses.begin(), pair.hypotheses.end());
    const auto actual = likeliest_components(world.graph(pairs));
    ASSERT_EQ(actual.size(), expected.size()) << trial;
    for (std::size_t c = 0; c < actual.size(); ++c) {
      EXPECT_EQ(actual[c].reference, expected[c].reference) << trial;
      ASSERT_EQ(actual[c].members(), expected[c].members()) << trial;
      EXPECT_NEAR(log_likelihood(graph, actual[c]), log_likelihood(graph, expected[c]), noise_m > 0 ? 1 : kRounding)
          << trial;
      for (const std::size_t i : actual[c].members()) {
        EXPECT_LE(
            testing::pose_rmse_m(*expected[c].T_reference_scan[i], *actual[c].T_reference_scan[i], world.points()),
            14 * noise_m + kRounding)
            << trial << ": " << i;
      }
    }
  }
}

TEST_F(ConfigurationTest, LogLikelihoodSumsThePairsLessWhatEachPoseHasToBeWorth) {
  HypothesisWorld world(4, rng_);
  world.add(0, 1, {world.hypothesis(0, 1, 4)});
  world.add(1, 2, {world.hypothesis(1, 2, 5)});
  world.add(0, 2, {world.aside(0, 2, 8, 10)});
  const PairGraph graph = world.graph();
  EXPECT_EQ(log_likelihood(graph, component_of_one(2, 4)), 0);
  EXPECT_NEAR(log_likelihood(graph, world.truth({0, 1, 2})), 4 + 5, 0.002) << "0 and 2 do not agree";
  EXPECT_NEAR(log_likelihood(graph, world.truth({2, 0, 1})), 4 + 5, 0.002) << "in whatever frame";
  EXPECT_NEAR(log_likelihood(graph, world.truth({0, 1, 2, 3})), 4 + 5 - graph.options().log_poses, 0.002);
}

TEST_F(ConfigurationTest, ImproveMovesAScanToWhereTheOthersSupportItMost) {
  HypothesisWorld world(4, rng_);
  for (const auto& [a, b] :
       {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u), std::pair(1u, 3u), std::pair(2u, 3u)}) {
    world.add(a, b, {world.hypothesis(a, b, 4)});
  }
  world.add(0, 3, {world.aside(0, 3, 6, 12)});
  const PairGraph graph = world.graph();
  Component component = world.truth({0, 1, 2, 3});
  component.T_reference_scan[3] = *component.T_reference_scan[3] * Eigen::Translation3d(0, 12, 0);
  ASSERT_NEAR(world.worst_error_m(component), 12, kRounding);
  const double before = log_likelihood(graph, component);
  improve(graph, component);
  EXPECT_LE(world.worst_error_m(component), kRounding);
  EXPECT_GT(log_likelihood(graph, component), before);
}

// No single one of them can move: each would leave the two others.
// Each hypothesis of a chain is off to the same side; links across it are not.
TEST_F(ConfigurationTest, ImproveBringsPosesToTheMeanOfWhatAgrees) {
  HypothesisWorld world(4, rng_);
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {2, 3}}) {
    world.add(a, b, {world.noisy(a, b, 7, 0, 0.2 * kSame_m, rng_)});
  }
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 2}, {0, 3}, {1, 3}}) {
    world.add(a, b, {world.hypothesis(a, b, 7)});
  }
  const PairGraph graph = world.graph();
  Component component = component_of_one(0, 4);
  for (std::size_t i = 1; i < 4; ++i) {
    const ComparedPair& step = graph.pairs()[i - 1];
    component.T_reference_scan[i] = *component.T_reference_scan[i - 1] * step.hypotheses.front().T_a_b;
  }
  const double before = log_likelihood(graph, component);
  improve(graph, component);
  EXPECT_GT(log_likelihood(graph, component), before + 0.1);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_LT(rms_displacement(world.T_target_source(0, i).inverse() * *component.T_reference_scan[i],
                               PointMoments(world.points())),
              0.2 * kSame_m);
  }
}

TEST_F(ConfigurationTest, ImproveMovesAGroupAsAWhole) {
  HypothesisWorld world(6, rng_);
  for (const std::size_t first : {0u, 3u}) {
    for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(0u, 2u), std::pair(1u, 2u)}) {
      world.add(first + a, first + b, {world.hypothesis(first + a, first + b, 6)});
    }
  }
  const Isometry3d turned(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  world.add(2, 3, {world.hypothesis(2, 3, 3), world.hypothesis(2, 3, 4, turned)});
  world.add(1, 4, {world.hypothesis(1, 4, 3)});
  const PairGraph graph = world.graph();
  Component component = world.truth({0, 1, 2, 3, 4, 5});
  const Isometry3d T_3 = *component.T_reference_scan[3], motion = T_3 * turned * T_3.inverse();
  for (const std::size_t i : {3u, 4u, 5u}) {
    component.T_reference_scan[i] = motion * *component.T_reference_scan[i];
  }
  ASSERT_GT(world.error_m(component, 5), 5);
  improve(graph, component);
  EXPECT_EQ(component.size(), 6u);
  EXPECT_LE(world.worst_error_m(component), kRounding);
}

TEST_F(ConfigurationTest, ImproveTakesOutWhatMoreSpeaksAgainst) {
  HypothesisWorld world(4, rng_);
  world.add(0, 1, {world.hypothesis(0, 1, 4)});
  world.add(1, 2, {world.hypothesis(1, 2, -1)});
  Component component = world.truth({0, 1, 2, 3});
  improve(world.graph(), component);
  EXPECT_EQ(component.members(), (std::vector<std::size_t>{0, 1}));
}

TEST_F(ConfigurationTest, AnotherReferenceKeepsPosesAgainstEachOther) {
  const HypothesisWorld world(4, rng_);
  const Component before = world.truth({0, 1, 3});
  Component after = before;
  change_reference(after, 3);
  EXPECT_EQ(after.reference, 3u);
  EXPECT_EQ(after.members(), before.members());
  EXPECT_TRUE(after.T_reference_scan[3]->isApprox(Isometry3d::Identity(), 0));
  for (const std::size_t a : after.members()) {
    for (const std::size_t b : after.members()) {
      EXPECT_TRUE(testing::is_pose_near(before.T_reference_scan[a]->inverse() * *before.T_reference_scan[b],
                                        after.T_reference_scan[a]->inverse() * *after.T_reference_scan[b], kRounding,
                                        1e-8));
    }
  }
  ASSERT_FALSE(testing::is_pose_near(*before.T_reference_scan[1], *after.T_reference_scan[1], 0.1, 1));
}

}  // namespace
}  // namespace tcm_icp
