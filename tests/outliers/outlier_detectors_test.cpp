// The detectors behind the rule are not part of the interface, but their numbers can be worked out.
#include "outliers/outlier_detectors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_points.hpp"

namespace tcm_icp {
namespace {

TEST(LocalOutlierFactor, HasTheValueWorkedOutByHand) {
  // On a line at 0, 1, 2, 5 with k = 2. k-distances: 2, 1, 2, 4.
  // Reach of 0: neighbours 1, 2: max(1, 1) + max(2, 2) = 3, mean 1.5. Of 1: neighbours 0, 2: 2 + 2, mean 2.
  // Of 2: neighbours 1, 0: max(1, 1) + max(2, 2), mean 1.5. Of 5: neighbours 2, 1: max(3, 2) + max(4, 1) = 7, mean 3.5.
  // Factors: 0: (1.5/2 + 1.5/1.5) / 2 = 0.875; 1: (2/1.5 + 2/1.5) / 2 = 4/3; 2: as 0; 5: (3.5/1.5 + 3.5/2) / 2 = 49/24.
  const auto factors = detail::local_outlier_factors({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}}, 2, 1);
  ASSERT_EQ(factors.size(), 4u);
  EXPECT_DOUBLE_EQ(factors[0], 0.875);
  EXPECT_DOUBLE_EQ(factors[1], 4.0 / 3);
  EXPECT_DOUBLE_EQ(factors[2], 0.875);
  EXPECT_DOUBLE_EQ(factors[3], 49.0 / 24);
}

TEST(LocalOutlierFactor, DuplicatesAreAsDenseAsTheirNeighbours) {
  const auto factors = detail::local_outlier_factors(Points(10, Eigen::Vector3d(1, 1, 1)), 3, 1);
  for (const double f : factors) EXPECT_EQ(f, 1);
}

TEST(DistanceOutliers, HaveTheThresholdWorkedOutByHand) {
  // Ten points 1 m apart, one 100 m off. Mean distance to the six nearest, from the left: 3.5 (1..6), 16/6 (1, 1..5),
  // 13/6 (2, 1, 1..4), 2 (1, 2, 3 both ways), 2, 2, 2, 13/6, 16/6, 3.5, and about 100. Ranked: 2 2 2 2 13/6 13/6 16/6
  // ...; the middle of eleven is the sixth: 13/6.
  Points points;
  for (int i = 0; i < 10; ++i) points.emplace_back(i, 0, 0);
  points.emplace_back(109, 0, 0);
  double threshold = 0;
  EXPECT_EQ(detail::distance_outliers(points, 4, 10, threshold), (std::vector<std::size_t>{10}));
  EXPECT_DOUBLE_EQ(threshold, 10 * 13.0 / 6);
}

TEST(DistanceOutliers, MostlyDuplicatesHaveNoLengthToCompareWith) {
  Points points(20, Eigen::Vector3d(1, 1, 1));
  points.emplace_back(2, 2, 2);
  double threshold = -1;
  EXPECT_TRUE(detail::distance_outliers(points, 4, 10, threshold).empty());
  EXPECT_EQ(threshold, 0);
}

}  // namespace
}  // namespace tcm_icp
