#include "tcm_icp/outliers/outlier_removal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

struct Working {
  Points points;
  double voxel_size_m;
};

Working sample(const Points& raw) {
  VoxelSampler sampler(131072);
  sampler.add(raw);
  Points points = sampler.finish().points;
  return {std::move(points), sampler.voxel_size_m()};
}

// As a spinning scanner sees flat ground and a wall: equal steps of angle, 0.2 degrees along a ring and 1 degree
// between them, so on the ground the rings lie 17 m apart at the far end, and the density falls with the fourth power
// of the range.
Points spinning_scan() {
  Points points;
  constexpr int kAzimuths = 1800, kRings = 60;
  for (int i = 0; i < kAzimuths; ++i) {
    for (int j = 1; j <= kRings; ++j) {
      const double azimuth = 2 * std::numbers::pi * i / kAzimuths;
      const double range = 2 / std::tan(0.02 + j * std::numbers::pi / 180);  // scanner 2 m up; 1 to 53 m
      const Eigen::Vector3d p(range * std::cos(azimuth), range * std::sin(azimuth), 0);
      points.push_back(p.x() < 15 ? p : Eigen::Vector3d(15, p.y() * 15 / p.x(), 2 - 2 * 15 / p.x()));
    }
  }
  return points;
}

// A strip 20 times longer than wide, with hills.
Points airborne_strip(Rng& rng) {
  Points points;
  for (int i = 0; i < 40000; ++i) {
    const double x = 1000 * uniform01(rng), y = 50 * uniform01(rng);
    points.emplace_back(x, y, 10 * std::sin(x / 60) + 3 * std::cos(y / 9));
  }
  return points;
}

Points sphere(Rng& rng) {
  Points points;
  for (int i = 0; i < 20000; ++i) {
    const double a = standard_normal(rng), b = standard_normal(rng), c = standard_normal(rng);
    points.push_back(0.05 * Eigen::Vector3d(a, b, c).normalized());
  }
  return points;
}

// Isolated points in a cube as large as the scan is long, at least a twentieth of that from any of its points.
Points isolated(const Points& scan, std::size_t count, Rng& rng) {
  double size = 0;
  for (const auto& p : scan) size = std::max(size, (p - scan.front()).norm());
  const NeighborIndex index(scan);
  Points strays;
  while (strays.size() < count) {
    const Eigen::Vector3d p = scan.front() + 2 * testing::random_points(1, size, rng)[0];
    if (!index.nearest_within(p, size / 20).found()) strays.push_back(p);
  }
  return strays;
}

double removed_share(const OutlierRule& rule, const Points& points) {
  std::size_t removed = 0;
  for (const auto& p : points) removed += rule.is_outlier(p) ? 1 : 0;
  return static_cast<double>(removed) / static_cast<double>(points.size());
}

OutlierRule learn(const Points& raw, OutlierMethod method) {
  OutlierOptions options;
  options.method = method;
  Rng rng = make_stream(42, "outliers");
  const Working working = sample(raw);
  return learn_outlier_rule(working.points, working.voxel_size_m, options, rng, 1);
}

class Outliers : public ::testing::TestWithParam<OutlierMethod> {
 protected:
  Rng rng = make_stream(1, "outlier_test");
};

TEST_P(Outliers, ACleanScanKeepsItsSparseFarEnd) {
  const Points scan = spinning_scan();
  EXPECT_LT(removed_share(learn(scan, GetParam()), scan), 1e-3);
}

TEST_P(Outliers, ACleanStripAndACleanObjectAreKept) {
  for (const Points& scan : {airborne_strip(rng), sphere(rng)}) {
    EXPECT_LT(removed_share(learn(scan, GetParam()), scan), 1e-3);
  }
}

TEST_P(Outliers, AFewIsolatedPointsAreFound) {
  for (const Points& scan : {spinning_scan(), airborne_strip(rng), sphere(rng)}) {
    const Points strays = isolated(scan, 10, rng);
    Points all = scan;
    all.insert(all.end(), strays.begin(), strays.end());
    const OutlierRule rule = learn(all, GetParam());
    EXPECT_GE(removed_share(rule, strays), 0.9);
    EXPECT_LT(removed_share(rule, scan), 1e-3);
    EXPECT_GE(rule.summary().num_outliers, 9u);
  }
}

TEST_P(Outliers, TheScaleOfTheScanDoesNotMatter) {
  Points scan = airborne_strip(rng);
  const Points strays = isolated(scan, 10, rng);
  scan.insert(scan.end(), strays.begin(), strays.end());
  const Points large = testing::scaled(scan, 1024);  // a power of two: not even a rounding differs
  const OutlierRule rule = learn(scan, GetParam()), large_rule = learn(large, GetParam());
  ASSERT_GT(rule.summary().num_outliers, 0u);
  for (std::size_t i = 0; i < scan.size(); ++i) ASSERT_EQ(rule.is_outlier(scan[i]), large_rule.is_outlier(large[i]));
}

TEST_P(Outliers, TheNumberOfThreadsDoesNotMatter) {
  Points scan = airborne_strip(rng);
  const Points strays = isolated(scan, 100, rng);
  scan.insert(scan.end(), strays.begin(), strays.end());
  const Working working = sample(scan);
  OutlierOptions options;
  options.method = GetParam();
  Rng one = make_stream(42, "outliers"), eight = make_stream(42, "outliers");
  const OutlierRule rule = learn_outlier_rule(working.points, working.voxel_size_m, options, one, 1);
  const OutlierRule same = learn_outlier_rule(working.points, working.voxel_size_m, options, eight, 8);
  EXPECT_EQ(rule.summary().threshold, same.summary().threshold);
  for (const auto& p : scan) ASSERT_EQ(rule.is_outlier(p), same.is_outlier(p));
}

// In any order: what the point before was near may be far from this one.
TEST_P(Outliers, AskedOneAfterAnotherPointsAreTheSame) {
  Points raw = spinning_scan();
  for (const auto& p : testing::random_points(100, 60, rng)) raw.push_back(p);
  const Working w = sample(raw);
  OutlierOptions options;
  options.method = GetParam();
  const OutlierRule rule = learn_outlier_rule(w.points, w.voxel_size_m, options, rng, 1);
  std::uint32_t near = 0;
  std::size_t num_outliers = 0;
  for (const auto& p : w.points) {
    ASSERT_EQ(rule.is_outlier(p, near), rule.is_outlier(p)) << p.transpose();
    num_outliers += rule.is_outlier(p) ? 1 : 0;
  }
  EXPECT_EQ(rule.summary().num_outliers, num_outliers);
  for (const auto& p : testing::random_points(2000, 80, rng)) ASSERT_EQ(rule.is_outlier(p, near), rule.is_outlier(p));
}

TEST_P(Outliers, TooFewOrEqualPointsHaveNone) {
  for (const Points& scan :
       {Points(1, Eigen::Vector3d(1, 2, 3)), Points{{0, 0, 0}, {100, 0, 0}}, Points(50, Eigen::Vector3d(1, 2, 3))}) {
    EXPECT_EQ(removed_share(learn(scan, GetParam()), scan), 0);
  }
}

TEST_P(Outliers, ALineIsNoOutlierOfItself) {
  Points line;
  for (int i = 0; i < 5000; ++i) line.emplace_back(0.01 * i, 0.02 * i, 0);
  EXPECT_LT(removed_share(learn(line, GetParam()), line), 1e-3);
}

TEST_P(Outliers, APointThatIsNotFiniteIsOne) {
  const OutlierRule rule = learn(spinning_scan(), GetParam());
  EXPECT_TRUE(rule.is_outlier({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_TRUE(rule.is_outlier({0, std::numeric_limits<double>::infinity(), 0}));
}

TEST_P(Outliers, RefusesAnEmptyCloudNaNAndNoVoxel) {
  OutlierOptions options;
  options.method = GetParam();
  EXPECT_THROW(learn_outlier_rule({}, 1, options, rng, 1), InvalidInput);
  Points points = testing::random_points(100, 1, rng);
  EXPECT_THROW(learn_outlier_rule(points, 0, options, rng, 1), InvalidInput);
  points[50].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(learn_outlier_rule(points, 1, options, rng, 1), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Methods, Outliers,
                         ::testing::Values(OutlierMethod::kKMeans, OutlierMethod::kDistance, OutlierMethod::kLof));

TEST(KMeansOutliers, FindsMostOfOnePercentOfIsolatedPoints) {
  Rng rng = make_stream(2, "outlier_test");
  for (const Points& scan : {spinning_scan(), airborne_strip(rng), sphere(rng)}) {
    const Points strays = isolated(scan, scan.size() / 100, rng);
    Points all = scan;
    all.insert(all.end(), strays.begin(), strays.end());
    const OutlierRule rule = learn(all, OutlierMethod::kKMeans);
    EXPECT_GE(removed_share(rule, strays), 0.8);
    EXPECT_LT(removed_share(rule, scan), 1e-3);
  }
}

TEST(KMeansOutliers, GivenValuesAreUsedAsTheyAre) {
  // Two heaps of 100 points within 0.5 m and one point 3 m from the first; a threshold of 2 m cuts it off, of 4 m does
  // not.
  Rng rng = make_stream(3, "outlier_test");
  Points points = testing::random_points(100, 0.5, rng);
  for (auto p : testing::random_points(100, 0.5, rng)) points.emplace_back(p + Eigen::Vector3d(50, 0, 0));
  points.emplace_back(3, 0, 0);
  OutlierOptions options;
  options.kmeans_clusters = 2;
  options.kmeans_radius_m = 5;
  options.kmeans_threshold_m = 2;
  const OutlierRule tight = learn_outlier_rule(points, 0.01, options, rng, 1);
  EXPECT_EQ(tight.summary().num_clusters, 2u);
  EXPECT_EQ(tight.summary().radius_m, 5);
  EXPECT_EQ(tight.summary().threshold, 2);
  EXPECT_EQ(tight.summary().num_outliers, 1u);
  EXPECT_TRUE(tight.is_outlier({3, 0, 0}));
  EXPECT_FALSE(tight.is_outlier({50, 0, 0}));
  options.kmeans_threshold_m = 4;
  EXPECT_EQ(learn_outlier_rule(points, 0.01, options, rng, 1).summary().num_outliers, 0u);
}

TEST(KMeansOutliers, AStrayPointDoesNotVouchForItself) {
  Rng rng = make_stream(4, "outlier_test");
  Points points = testing::random_points(200, 1, rng);
  points.emplace_back(30, 0, 0);
  OutlierOptions options;
  options.kmeans_clusters = 50;  // enough for the stray point to become a centroid
  options.kmeans_radius_m = 0.6;
  options.kmeans_threshold_m = 2;
  const OutlierRule rule = learn_outlier_rule(points, 0.01, options, rng, 1);
  EXPECT_GE(rule.summary().num_struck_clusters, 1u);
  EXPECT_TRUE(rule.is_outlier({30, 0, 0}));
}

TEST(OutlierRule, KeepsEveryPointWhereNothingWasLearned) {
  EXPECT_FALSE(OutlierRule().is_outlier({1e9, 0, 0}));
  EXPECT_EQ(removed_share(learn({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e9, 0, 0}}, OutlierMethod::kNone),
                          {{0, 0, 0}, {1e9, 0, 0}}),
            0);
}

TEST(OutlierOptions, NamesTheFieldThatIsOutOfBounds) {
  const auto message = [](const OutlierOptions& options) {
    try {
      options.validate();
    } catch (const InvalidOptions& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  OutlierOptions options;
  EXPECT_EQ(message(options), "");
  options.num_neighbors = 1;
  EXPECT_NE(message(options).find("num_neighbors is 1"), std::string::npos);
  options = {};
  options.kmeans_threshold_m = -1;
  EXPECT_NE(message(options).find("kmeans_threshold_m"), std::string::npos);
  options = {};
  options.lof_threshold = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(options).find("lof_threshold"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
