#include "tcm_icp/graph/correspondence_measure.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "registration/level_of.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

struct Indexed {
  explicit Indexed(Points p) : points(std::move(p)), index(points) {}
  operator IndexedPoints() const { return {points, index}; }
  Points points;
  NeighborIndex index;
};

const Eigen::Isometry3d kSameFrame = Eigen::Isometry3d::Identity();

TEST(CorrespondenceDistance, HasTheValueWorkedOutByHand) {
  const Indexed a({{0, 0, 0}, {4, 0, 0}}), b({{0, 3, 0}, {0, 0, 1}, {4, 0, 5}});
  // a to b: 1 (to (0,0,1)), sqrt(17) against 5: sqrt(16 + 1); mean (1 + sqrt 17) / 2.
  // b to a: 3, 1, 5: mean 3.
  EXPECT_DOUBLE_EQ(correspondence_distance(a, b), ((1 + std::sqrt(17.0)) / 2 + 3) / 2);
  EXPECT_DOUBLE_EQ(correspondence_distance(b, a), correspondence_distance(a, b));
}

TEST(CorrespondenceDistance, IsZeroToItselfAndScalesWithTheCloud) {
  Rng rng = make_stream(1, "correspondence_test");
  const Points a = testing::random_points(300, 5, rng), b = testing::random_points(200, 6, rng);
  EXPECT_EQ(correspondence_distance(Indexed(a), Indexed(a)), 0);
  const double distance = correspondence_distance(Indexed(a), Indexed(b));
  EXPECT_NEAR(correspondence_distance(Indexed(testing::scaled(a, 1000)), Indexed(testing::scaled(b, 1000))),
              1000 * distance, 1e-10 * 1000 * distance);
}

TEST(CorrespondenceDistance, ASampleOfALargeCloudStandsForIt) {
  Rng rng = make_stream(2, "correspondence_test");
  const Points a = testing::random_points(20000, 5, rng);
  Points b = a;
  for (auto& p : b) p.x() += 20;
  double sum = 0;
  const Indexed indexed_a(a), indexed_b(b);
  for (const auto& p : a) sum += std::sqrt(indexed_b.index.nearest(p).squared_distance_m2);
  // Distances spread over 15 to 20 m: 2,000 of them give the mean to 0.05 m.
  EXPECT_NEAR(correspondence_distance(indexed_a, indexed_b), sum / 20000, 0.1);
}

TEST(Overlap, CountsThePointsWithANeighbourInReach) {
  const PyramidLevel a = testing::level_of({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 0, 0}}, {}});
  const PyramidLevel b = testing::level_of({{{0, 0, 0.5}, {1, 0, 0.5}}, {}});
  EXPECT_DOUBLE_EQ(overlap_share(a, b, kSameFrame, 0.6), 0.5);  // the first two of four
  EXPECT_DOUBLE_EQ(overlap_share(b, a, kSameFrame, 0.6), 1.0);
  EXPECT_DOUBLE_EQ(overlap_share(a, b, kSameFrame, 0.4), 0.0);
  EXPECT_DOUBLE_EQ(overlap_share(a, b, kSameFrame, 2.0), 0.75);  // (2,0,0) is sqrt(1.25) from (1,0,0.5)
  EXPECT_DOUBLE_EQ(overlap(a, b, kSameFrame, 0.6), 1.0);
  EXPECT_DOUBLE_EQ(overlap(b, a, kSameFrame, 0.6), 1.0);
}

TEST(Overlap, UndoesTheMotionBetweenTheFrames) {
  Rng rng = make_stream(3, "correspondence_test");
  const Points a = testing::random_points(500, 5, rng);
  Twist twist;
  twist << 1.2, 0.5, -0.9, 30, 20, -10;
  const Eigen::Isometry3d T_a_b = isometry_from_twist(twist);
  const PyramidLevel in_a = testing::level_of({a, {}}), in_b = testing::level_of(transformed({a, {}}, T_a_b.inverse()));
  ASSERT_LT(overlap(in_a, in_b, kSameFrame, 0.01), 0.1);
  EXPECT_EQ(overlap(in_a, in_b, T_a_b, 0.01), 1);
  EXPECT_EQ(overlap(in_b, in_a, T_a_b.inverse(), 0.01), 1);
}

TEST(Overlap, RefusesEmptyCloudsAndRadiiThatAreNone) {
  EXPECT_THROW(correspondence_distance(Indexed(Points{}), Indexed({{0, 0, 0}})), InvalidInput);
  const PyramidLevel none = testing::level_of({}), one = testing::level_of({{{0, 0, 0}}, {}});
  EXPECT_THROW(overlap_share(one, none, kSameFrame, 1), InvalidInput);
  EXPECT_THROW(overlap_share(one, one, kSameFrame, 0), InvalidInput);
  EXPECT_THROW(overlap_share(one, one, kSameFrame, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
