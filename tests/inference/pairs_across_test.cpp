#include "inference/pairs_across.hpp"

#include <gtest/gtest.h>

#include "inference/hypothesis_world.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::HypothesisWorld;

using testing::between;
using testing::kRounding;

constexpr double kNothing = -1e300;

// Scans 0 to 4 against 5 to 9, whose pairs across have right, wrong, shared and lonely other places.
class PairsAcrossTest : public ::testing::Test {
 protected:
  void add_pairs_across(Rng& rng) {
    const Isometry3d turned(Eigen::Translation3d(2, 1, 0) * Eigen::AngleAxisd(3, Eigen::Vector3d::UnitZ()));
    for (std::size_t a = 0; a < 5; ++a) {
      for (std::size_t b = 5; b < 10; ++b) {
        if (uniform01(rng) < 0.3) continue;
        std::vector<PoseHypothesis> found{world_.wrong(between(-2, 4, rng), rng),
                                          world_.wrong(between(-2, 4, rng), rng)};
        if (uniform01(rng) < 0.5) found.push_back(world_.noisy(a, b, between(0, 5, rng), 0.01, 0.1, rng));
        if (uniform01(rng) < 0.5) {
          // The twin of the group, turned about one place.
          const Isometry3d T_0_a = world_.T_target_source(0, a), T_0_b = world_.T_target_source(0, b);
          found.push_back({T_0_a.inverse() * turned * T_0_b, between(0, 5, rng)});
        }
        world_.add(a, b, found);
      }
    }
  }

  Rng rng_ = make_stream(1, "pairs_across_test");
  HypothesisWorld world_{10, rng_};
};

// Asking every hypothesis about every motion.
TEST_F(PairsAcrossTest, TheCellsMissNoHypothesisThatAgrees) {
  for (int trial = 0; trial < 20; ++trial) {
    world_ = HypothesisWorld(10, rng_);
    add_pairs_across(rng_);
    const PairGraph graph = world_.graph();
    for (const std::vector<std::size_t>& members :
         {std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {9, 0, 1, 2, 3, 4, 5, 6, 7, 8}}) {
      const Component component = world_.truth(members);
      std::vector<std::size_t> moved;
      for (const std::size_t i : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u}) {
        if ((i < 5) != (component.reference < 5)) moved.push_back(i);
      }
      const PairsAcross across(graph, component, AlikeParts(graph, component), moved);
      double best = -1e300;
      for (const ComparedPair& pair : graph.pairs()) {
        for (const PoseHypothesis& h : pair.hypotheses) {
          const Isometry3d &T_a = *component.T_reference_scan[pair.a], &T_b = *component.T_reference_scan[pair.b];
          const Isometry3d T = T_a * h.T_a_b * T_b.inverse(), motion = component.reference < 5 ? T : T.inverse();
          const std::size_t scan = component.reference < 5 ? pair.b : pair.a;
          const Isometry3d& T_scan = *component.T_reference_scan[scan];
          if (!graph.same_pose(scan, T_scan, motion * T_scan)) best = std::max(best, across.support(motion));
        }
      }
      const PairsAcross::Elsewhere found = across.best_elsewhere(kNothing);
      ASSERT_TRUE(found.motion);
      EXPECT_NEAR(found.support, best, kRounding);
      EXPECT_NEAR(across.support(*found.motion), best, kRounding);
      EXPECT_GE(across.most_elsewhere(), best);
      EXPECT_EQ(across.best_elsewhere(found.support - kRounding).support, found.support);
      EXPECT_FALSE(across.best_elsewhere(found.support).motion);
      EXPECT_GT(best, 0) << "the twin has something for it";
    }
  }
}

TEST_F(PairsAcrossTest, NothingAcrossSaysNothing) {
  const PairGraph graph = world_.graph();
  const Component component = world_.truth({0, 1});
  const PairsAcross across(graph, component, AlikeParts(graph, component), {1});
  EXPECT_EQ(across.support(Isometry3d::Identity()), -graph.options().log_poses);
  EXPECT_EQ(across.most_elsewhere(), -graph.options().log_poses);
  EXPECT_FALSE(across.best_elsewhere(kNothing).motion);
}

}  // namespace
}  // namespace tcm_icp
