#include "inference/places.hpp"

#include <gtest/gtest.h>

#include "inference/hypothesis_world.hpp"
#include "support/matchers.hpp"

namespace tcm_icp {
namespace {

using testing::HypothesisWorld;
using testing::kSame_m;

class PlacesTest : public ::testing::Test {
 protected:
  PlacesTest() {
    for (const std::size_t i : {0u, 1u, 2u}) {
      world_.add(i, 3, {world_.noisy(i, 3, 2 + static_cast<double>(i), 0, 0.2 * kSame_m, rng_), world_.wrong(4, rng_)});
    }
  }
  const ComparedPair& pair_with(const PairGraph& graph, std::size_t other) const {
    for (const std::size_t k : graph.pairs_of(other)) {
      if (graph.pairs()[k].b == 3) return graph.pairs()[k];
    }
    throw std::logic_error("no such pair");
  }

  Rng rng_ = make_stream(1, "places_test");
  HypothesisWorld world_{4, rng_};
};

TEST_F(PlacesTest, WithoutMembersThereIsNone) {
  const PairGraph graph = world_.graph();
  EXPECT_FALSE(Places::beside(graph, 3, component_of_one(3, 4)).best(component_of_one(3, 4)));
}

TEST_F(PlacesTest, TheBestIsWhereHypothesesAgreeAndNoWorseThanAnyOfThem) {
  const PairGraph graph = world_.graph();
  const Component others = world_.truth({0, 1, 2});
  const auto best = Places::beside(graph, 3, others).best(others);
  ASSERT_TRUE(best);
  EXPECT_NEAR(best->support, graph.support_of(3, best->T, others), 1e-9);
  EXPECT_LT(testing::pose_rmse_m(world_.T_target_source(0, 3), best->T, world_.points()), 0.3 * kSame_m);
  for (const ComparedPair& pair : graph.pairs()) {
    for (const PoseHypothesis& h : pair.hypotheses) {
      const Eigen::Isometry3d T = *others.T_reference_scan[pair.a] * h.T_a_b;
      EXPECT_GE(best->support, graph.support_of(3, T, others) - 1e-9);
    }
  }
}

TEST_F(PlacesTest, MemberByMemberIsAllAtOnce) {
  const PairGraph graph = world_.graph();
  Component others = world_.truth({0, 1});
  Places grown = Places::beside(graph, 3, others);
  others.T_reference_scan[2] = world_.T_target_source(0, 2);
  grown.add(pair_with(graph, 2), others);
  const auto one = grown.best(others), all = Places::beside(graph, 3, others).best(others);
  ASSERT_TRUE(one && all);
  EXPECT_NEAR(one->support, all->support, 1e-9);
  EXPECT_TRUE(testing::is_pose_near(all->T, one->T, 1e-9, 1e-9));
}

}  // namespace
}  // namespace tcm_icp
