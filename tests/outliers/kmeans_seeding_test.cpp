#include "tcm_icp/outliers/kmeans_seeding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/place_sampling.hpp"

namespace tcm_icp {
namespace {

class KMeansSeeding : public ::testing::Test {
 protected:
  Rng rng = make_stream(1, "seeding_test");
  Points points = testing::random_points(3000, 10, rng);
  NeighborIndex index{points};
  std::vector<std::size_t> order = draw_order(place_priorities(points, 0.01, rng));
};

TEST_F(KMeansSeeding, CentroidsArePointsFartherApartThanTheRadius) {
  const KMeansSeeds seeds = seed_kmeans(points, index, 2, 1000, order);
  ASSERT_GT(seeds.centroids.size(), 10u);
  for (std::size_t i = 0; i < seeds.centroids.size(); ++i) {
    EXPECT_EQ(index.nearest(seeds.centroids[i]).squared_distance_m2, 0);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((seeds.centroids[i] - seeds.centroids[j]).norm(), 2);
  }
}

TEST_F(KMeansSeeding, GoesOnUntilNoPointIsLeft) {
  const KMeansSeeds seeds = seed_kmeans(points, index, 2, 1000, order);
  ASSERT_LT(seeds.centroids.size(), 1000u);
  EXPECT_EQ(seeds.num_covered, points.size());
  const NeighborIndex centroids(seeds.centroids);
  for (const auto& p : points) EXPECT_LE(centroids.nearest(p).squared_distance_m2, 4);
}

TEST_F(KMeansSeeding, StopsAtTheNumberAskedFor) {
  const KMeansSeeds seeds = seed_kmeans(points, index, 1, 5, order);
  EXPECT_EQ(seeds.centroids.size(), 5u);
  const auto covered = std::count_if(points.begin(), points.end(), [&](const auto& p) {
    return NeighborIndex(seeds.centroids).nearest(p).squared_distance_m2 <= 1;
  });
  EXPECT_EQ(seeds.num_covered, static_cast<std::size_t>(covered));
}

TEST_F(KMeansSeeding, TheSeedOfTheRandomNumbersDecides) {
  const auto drawn = [&](std::uint64_t seed) {
    Rng own = make_stream(seed, "a");
    return seed_kmeans(points, index, 2, 10, draw_order(place_priorities(points, 0.01, own))).centroids;
  };
  EXPECT_EQ(drawn(5), drawn(5));
  EXPECT_NE(drawn(5), drawn(6));
}

TEST_F(KMeansSeeding, DuplicatesAreTakenAwayTogether) {
  const Points same(20, Eigen::Vector3d(1, 2, 3));
  std::vector<std::size_t> all(same.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const KMeansSeeds seeds = seed_kmeans(same, NeighborIndex(same), 0.1, 10, all);
  EXPECT_EQ(seeds.centroids.size(), 1u);
  EXPECT_EQ(seeds.num_covered, 20u);
}

TEST_F(KMeansSeeding, NoPointsNoSeeds) {
  EXPECT_TRUE(seed_kmeans({}, NeighborIndex(Points{}), 1, 10, {}).centroids.empty());
}

TEST_F(KMeansSeeding, RefusesBadOptions) {
  EXPECT_THROW(seed_kmeans(points, index, 0, 10, order), InvalidOptions);
  EXPECT_THROW(seed_kmeans(points, index, std::numeric_limits<double>::quiet_NaN(), 10, order), InvalidOptions);
  EXPECT_THROW(seed_kmeans(points, index, 1, 0, order), InvalidOptions);
}

TEST_F(KMeansSeeding, RadiusTilesAFlatSheetWithAboutSoManySpheres) {
  Points sheet = points;
  for (auto& p : sheet) p.z() = 0;
  for (const std::size_t k : {20u, 80u}) {
    const double radius = seeding_radius(sheet, k, order);
    const std::size_t needed = seed_kmeans(sheet, NeighborIndex(sheet), radius, 100000, order).centroids.size();
    // Random packing wastes spheres on the last gaps, so somewhat more than k; steps of 2^(1/4) change it by 2^(1/2).
    EXPECT_GT(needed, k / 2);
    EXPECT_LT(needed, 3 * k);
  }
}

TEST_F(KMeansSeeding, RadiusScalesWithTheCloud) {
  const double radius = seeding_radius(points, 30, order);
  EXPECT_NEAR(seeding_radius(testing::scaled(points, 1024), 30, order), 1024 * radius, 1e-9 * radius);
}

TEST_F(KMeansSeeding, RadiusOfOnePlaceIsRefused) {
  const std::vector<std::size_t> five{0, 1, 2, 3, 4};
  EXPECT_THROW(seeding_radius({}, 10, {}), InvalidInput);
  EXPECT_THROW(seeding_radius(Points(5, Eigen::Vector3d(0, 0, 0)), 10, five), InvalidInput);
}

}  // namespace
}  // namespace tcm_icp
