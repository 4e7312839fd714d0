#include "tcm_icp/outliers/kmeans_seeding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

class KMeansSeeding : public ::testing::Test {
 protected:
  Rng rng = make_stream(1, "seeding_test");
  Points points = testing::random_points(3000, 10, rng);
  NeighborIndex index{points};
};

TEST_F(KMeansSeeding, CentroidsArePointsFartherApartThanTheRadius) {
  const KMeansSeeds seeds = seed_kmeans(points, index, 2, 1000, rng);
  ASSERT_GT(seeds.centroids.size(), 10u);
  for (std::size_t i = 0; i < seeds.centroids.size(); ++i) {
    EXPECT_EQ(index.nearest(seeds.centroids[i]).squared_distance_m2, 0);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((seeds.centroids[i] - seeds.centroids[j]).norm(), 2);
  }
}

TEST_F(KMeansSeeding, GoesOnUntilNoPointIsLeft) {
  const KMeansSeeds seeds = seed_kmeans(points, index, 2, 1000, rng);
  ASSERT_LT(seeds.centroids.size(), 1000u);
  EXPECT_EQ(seeds.num_covered, points.size());
  const NeighborIndex centroids(seeds.centroids);
  for (const auto& p : points) EXPECT_LE(centroids.nearest(p).squared_distance_m2, 4);
}

TEST_F(KMeansSeeding, StopsAtTheNumberAskedFor) {
  const KMeansSeeds seeds = seed_kmeans(points, index, 1, 5, rng);
  EXPECT_EQ(seeds.centroids.size(), 5u);
  const auto covered = std::count_if(points.begin(), points.end(), [&](const auto& p) {
    return NeighborIndex(seeds.centroids).nearest(p).squared_distance_m2 <= 1;
  });
  EXPECT_EQ(seeds.num_covered, static_cast<std::size_t>(covered));
}

TEST_F(KMeansSeeding, TheSeedOfTheRandomNumbersDecides) {
  Rng first = make_stream(5, "a"), again = make_stream(5, "a"), other = make_stream(6, "a");
  const Points seeds = seed_kmeans(points, index, 2, 10, first).centroids;
  EXPECT_EQ(seeds, seed_kmeans(points, index, 2, 10, again).centroids);
  EXPECT_NE(seeds, seed_kmeans(points, index, 2, 10, other).centroids);
}

TEST_F(KMeansSeeding, DuplicatesAreTakenAwayTogether) {
  const Points same(20, Eigen::Vector3d(1, 2, 3));
  const KMeansSeeds seeds = seed_kmeans(same, NeighborIndex(same), 0.1, 10, rng);
  EXPECT_EQ(seeds.centroids.size(), 1u);
  EXPECT_EQ(seeds.num_covered, 20u);
}

TEST_F(KMeansSeeding, NoPointsNoSeeds) {
  EXPECT_TRUE(seed_kmeans({}, NeighborIndex(Points{}), 1, 10, rng).centroids.empty());
}

TEST_F(KMeansSeeding, RefusesBadOptions) {
  EXPECT_THROW(seed_kmeans(points, index, 0, 10, rng), InvalidOptions);
  EXPECT_THROW(seed_kmeans(points, index, std::numeric_limits<double>::quiet_NaN(), 10, rng), InvalidOptions);
  EXPECT_THROW(seed_kmeans(points, index, 1, 0, rng), InvalidOptions);
}

TEST_F(KMeansSeeding, RadiusTilesAFlatSheetWithAboutSoManySpheres) {
  Points sheet = points;
  for (auto& p : sheet) p.z() = 0;
  for (const std::size_t k : {20u, 80u}) {
    const double radius = seeding_radius(sheet, k, rng);
    const std::size_t needed = seed_kmeans(sheet, NeighborIndex(sheet), radius, 100000, rng).centroids.size();
    // Random packing wastes spheres on the last gaps, so somewhat more than k; steps of 2^(1/4) change it by 2^(1/2).
    EXPECT_GT(needed, k / 2);
    EXPECT_LT(needed, 3 * k);
  }
}

TEST_F(KMeansSeeding, RadiusScalesWithTheCloud) {
  Rng first = make_stream(5, "a"), again = make_stream(5, "a");
  const double radius = seeding_radius(points, 30, first);
  EXPECT_NEAR(seeding_radius(testing::scaled(points, 1024), 30, again), 1024 * radius, 1e-9 * radius);
}

TEST_F(KMeansSeeding, RadiusOfOnePlaceIsRefused) {
  EXPECT_THROW(seeding_radius({}, 10, rng), InvalidInput);
  EXPECT_THROW(seeding_radius(Points(5, Eigen::Vector3d(0, 0, 0)), 10, rng), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
