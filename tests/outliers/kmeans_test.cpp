#include "tcm_icp/outliers/kmeans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Clusters = std::vector<std::uint32_t>;

// On a line: 0, 1, 2 and 10, 12.
const Points kLine{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {10, 0, 0}, {12, 0, 0}};

TEST(KMeans, FollowsLloydStepByStep) {
  // From 0 and 3: 0 and 1 go to 0; 2, 10 and 12 to 3.
  // Means 0.5 and 8: 0, 1, 2 and 10, 12. Means 1 and 11: nothing changes, after two moves.
  const Points start{{0, 0, 0}, {3, 0, 0}};
  const KMeansResult one = kmeans(kLine, start, 1, 1);
  EXPECT_TRUE(testing::are_points_near({{0.5, 0, 0}, {8, 0, 0}}, one.centroids, 1e-15));
  EXPECT_EQ(one.cluster, (Clusters{0, 0, 0, 1, 1}));
  EXPECT_FALSE(one.converged);
  const KMeansResult all = kmeans(kLine, start, 10, 1);
  EXPECT_TRUE(testing::are_points_near({{1, 0, 0}, {11, 0, 0}}, all.centroids, 1e-15));
  EXPECT_TRUE(all.converged);
  EXPECT_EQ(all.num_iterations, 2);
  EXPECT_EQ(all.size, (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(all.squared_distance_m2, (std::vector<double>{1, 0, 1, 1, 1}));
}

TEST(KMeans, WithoutIterationsOnlyAssigns) {
  const Points start{{0, 0, 0}, {3, 0, 0}};
  const KMeansResult result = kmeans(kLine, start, 0, 1);
  EXPECT_EQ(result.centroids, start);
  EXPECT_EQ(result.cluster, (Clusters{0, 0, 1, 1, 1}));
  EXPECT_EQ(result.num_iterations, 0);
}

TEST(KMeans, ACentroidWithoutPointsStays) {
  const Points start{{1, 0, 0}, {11, 0, 0}, {500, 0, 0}};
  const KMeansResult result = kmeans(kLine, start, 10, 1);
  EXPECT_EQ(result.size, (std::vector<std::size_t>{3, 2, 0}));
  EXPECT_EQ(result.centroids[2], start[2]);
}

TEST(KMeans, AssignsEachPointToItsNearestCentroid) {
  Rng rng = make_stream(2, "kmeans_test");
  const Points points = testing::random_points(2000, 10, rng), start = testing::random_points(50, 10, rng);
  for (const int iterations : {0, 1, 5}) {
    const KMeansResult result = kmeans(points, start, iterations, 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& c : result.centroids) nearest = std::min(nearest, (points[i] - c).squaredNorm());
      EXPECT_NEAR(result.squared_distance_m2[i], nearest, 1e-12);
      EXPECT_NEAR((points[i] - result.centroids[result.cluster[i]]).squaredNorm(), nearest, 1e-12);
    }
  }
}

TEST(KMeans, NeverRaisesTheSumOfSquaredDistances) {
  Rng rng = make_stream(1, "kmeans_test");
  const Points points = testing::random_points(2000, 10, rng), start = testing::random_points(20, 10, rng);
  double before = std::numeric_limits<double>::infinity();
  for (int iterations = 0; iterations < 8; ++iterations) {
    const auto squared = kmeans(points, start, iterations, 1).squared_distance_m2;
    const double sum = std::accumulate(squared.begin(), squared.end(), 0.0);
    EXPECT_LT(sum, before);
    before = sum;
  }
}

TEST(KMeans, HasTheSameBitsForAnyNumberOfThreads) {
  Rng rng = make_stream(2, "kmeans_test");
  const Points points = testing::random_points(5000, 10, rng), start = testing::random_points(50, 10, rng);
  const KMeansResult one = kmeans(points, start, 5, 1);
  for (const int threads : {2, 8}) {
    const KMeansResult many = kmeans(points, start, 5, threads);
    EXPECT_EQ(many.centroids, one.centroids);
    EXPECT_EQ(many.cluster, one.cluster);
    EXPECT_EQ(many.squared_distance_m2, one.squared_distance_m2);
  }
}

TEST(KMeans, RefusesNoCentroidsNaNAndNegativeIterations) {
  EXPECT_THROW(kmeans(kLine, {}, 1, 1), InvalidInput);
  EXPECT_THROW(kmeans({{std::numeric_limits<double>::quiet_NaN(), 0, 0}}, kLine, 1, 1), InvalidInput);
  EXPECT_THROW(kmeans(kLine, kLine, -1, 1), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
