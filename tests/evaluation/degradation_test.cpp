#include "tcm_icp/evaluation/degradation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing_m = 0.1;

/// Three faces of a cube of 5 m that meet in the origin: 7,500 points, edges and a corner between them. Far from the
/// origin of the file, as surveyed scans are.
const Vector3d kOffset(500000, 5200000, 300);
Points corner() {
  Points points;
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) {
      const double a = kSpacing_m * (i + 0.5), b = kSpacing_m * (j + 0.5);
      for (const Vector3d& p : {Vector3d(a, b, 0), Vector3d(a, 0, b), Vector3d(0, a, b)}) points.push_back(kOffset + p);
    }
  }
  return points;
}

DegradedCloud degraded(const DegradationOptions& options, std::uint64_t seed = 1) {
  return degrade(corner(), options, seed, "scan.ply", 1);
}

/// Points whose source is given are where they were.
void expect_unmoved(const DegradedCloud& cloud, const Points& points) {
  ASSERT_EQ(cloud.source.size(), cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.source[i] == DegradedCloud::kAdded) continue;
    ASSERT_EQ(cloud.points[i], points[cloud.source[i]]);
  }
}

TEST(Degradation, NoiseMovesItsShareByItsSigma) {
  DegradationOptions options;
  options.noise_share = 0.4;
  options.sigma_m = 0.25;
  const Points points = corner();
  const DegradedCloud cloud = degraded(options);
  ASSERT_EQ(cloud.points.size(), points.size());
  std::size_t moved = 0;
  double squares = 0;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d move = cloud.points[i] - points[i];
    moved += move.norm() > 0;
    squares += move.squaredNorm();
    sum += move;
  }
  EXPECT_EQ(moved, 3000u);
  // Four standard deviations of the estimates.
  EXPECT_NEAR(std::sqrt(squares / 9000), 0.25, 4 * 0.25 / std::sqrt(18000));
  EXPECT_LT((sum / 3000).cwiseAbs().maxCoeff(), 4 * 0.25 / std::sqrt(3000));
  EXPECT_EQ(cloud.steps.at(0).changed, 3000u);
}

TEST(Degradation, NoiseIsAsLargeAsTheSpacingUnlessToldOtherwise) {
  DegradationOptions options;
  options.noise_share = 0.1;
  EXPECT_NEAR(degraded(options).steps.at(0).length_m, kSpacing_m, 1e-6);
}

TEST(Degradation, RemovalTakesItsShareAnywhere) {
  DegradationOptions options;
  options.removal_share = 0.3;
  const DegradedCloud cloud = degraded(options);
  EXPECT_EQ(cloud.points.size(), 5250u);
  expect_unmoved(cloud, corner());
  const std::set<std::uint32_t> kept(cloud.source.begin(), cloud.source.end());
  EXPECT_EQ(kept.size(), 5250u);
  for (std::uint32_t begin = 0; begin < 7500; begin += 750)  // every part of the scan loses some, and keeps some
    EXPECT_NEAR(static_cast<double>(std::distance(kept.lower_bound(begin), kept.lower_bound(begin + 750))), 525, 60);
}

TEST(Degradation, OcclusionHidesItsShareInFewConnectedPieces) {
  DegradationOptions options;
  options.occlusion_share = 0.3;
  const Points points = corner();
  const DegradedCloud cloud = degraded(options);
  EXPECT_EQ(cloud.points.size(), 5250u);
  expect_unmoved(cloud, points);
  // Most of what is hidden has hidden neighbours only; by removal of as many points 0.3^4 of it would.
  const std::set<std::uint32_t> kept(cloud.source.begin(), cloud.source.end());
  const NeighborIndex index(points);
  std::vector<Neighbor> near;
  int inside = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (kept.contains(i)) continue;
    index.nearest_k(points[i], 5, near);
    inside += std::none_of(near.begin(), near.end(), [&](const Neighbor& n) { return kept.contains(n.index); });
  }
  EXPECT_GT(inside, 2250 * 2 / 3);
}

TEST(Degradation, IsolatedPointsLieInTheBoxAwayFromTheScan) {
  DegradationOptions options;
  options.isolated_share = 0.1;
  const Points points = corner();
  const DegradedCloud cloud = degraded(options);
  ASSERT_EQ(cloud.points.size(), 8250u);
  expect_unmoved(cloud, points);
  const NeighborIndex index(points);
  for (std::size_t i = 7500; i < cloud.points.size(); ++i) {
    EXPECT_EQ(cloud.source[i], DegradedCloud::kAdded);
    EXPECT_GE(std::sqrt(index.nearest(cloud.points[i]).squared_distance_m2), 5 * kSpacing_m - 1e-6);
    const Vector3d p = cloud.points[i] - kOffset;
    EXPECT_TRUE(p.minCoeff() >= -1e-9 && p.maxCoeff() <= 5) << p.transpose();
  }
}

TEST(Degradation, BlurringAddsPointsAboutEdgesAndNotAboutFaces) {
  DegradationOptions options;
  options.blur_share = 0.2;
  const DegradedCloud cloud = degraded(options);
  ASSERT_EQ(cloud.points.size(), 9000u);
  expect_unmoved(cloud, corner());
  int near_edge = 0;
  for (std::size_t i = 7500; i < cloud.points.size(); ++i) {
    // Of the three distances to the faces' planes two are small near an edge.
    Vector3d p = (cloud.points[i] - kOffset).cwiseAbs();
    std::sort(p.data(), p.data() + 3);
    near_edge += p[1] < 0.2 + 3 * 3 * kSpacing_m;
  }
  EXPECT_GT(near_edge, 1500 * 9 / 10);
  // Edges are known by their surface variation; what is added makes them round.
  const auto variation = [](const Points& points) {
    const auto estimate = estimate_normals(points, NeighborIndex(points), {}, 1);
    double sum = 0;
    for (const double v : estimate.variation) sum += v;
    return sum / static_cast<double>(points.size());
  };
  EXPECT_GT(variation(cloud.points), 2 * variation(corner()));
}

TEST(Degradation, IsTheSameForTheSameSeedAndNameAndAnotherForOthers) {
  DegradationOptions options;
  options.noise_share = options.occlusion_share = options.blur_share = options.isolated_share = 0.1;
  const DegradedCloud cloud = degraded(options);
  EXPECT_EQ(degraded(options).points, cloud.points);
  EXPECT_EQ(degrade(corner(), options, 1, "scan.ply", 4).points, cloud.points);
  EXPECT_NE(degraded(options, 2).points, cloud.points);
  EXPECT_NE(degrade(corner(), options, 1, "other.ply", 1).points, cloud.points);
}

TEST(Degradation, StepsCountOnFromOneAnother) {
  DegradationOptions options;
  options.occlusion_share = options.removal_share = options.noise_share = options.blur_share = 0.5;
  options.isolated_share = 0.5;
  const DegradedCloud cloud = degraded(options);
  ASSERT_EQ(cloud.steps.size(), 5u);
  const std::size_t after[] = {3750, 1875, 1875, 2813, cloud.points.size()};
  std::size_t before = 7500;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(cloud.steps[i].points_before, before);
    EXPECT_EQ(cloud.steps[i].points_after, after[i]) << cloud.steps[i].kind;
    before = after[i];
  }
}

TEST(Degradation, RefusesWhatItCannotDo) {
  const auto refuses = [](auto change) {
    DegradationOptions options;
    options.noise_share = 0.1;
    change(options);
    EXPECT_THROW(options.validate(), InvalidOptions);
  };
  refuses([](auto& o) { o.noise_share = 0; });
  refuses([](auto& o) { o.noise_share = 1.5; });
  refuses([](auto& o) { o.sigma_m = -1; });
  refuses([](auto& o) { o.occlusion_share = 1; });
  refuses([](auto& o) { o.removal_share = 1; });
  refuses([](auto& o) { o.blur_share = NAN; });
  refuses([](auto& o) { o.isolated_share = -0.1; });
  DegradationOptions options;
  options.noise_share = 0.5;
  EXPECT_THROW(degrade({}, options, 1, "", 1), InvalidInput);
  const Points doubles(10, Vector3d(1, 2, 3));
  EXPECT_THROW(degrade(doubles, options, 1, "", 1), InvalidInput);
  options.sigma_m = 0.1;
  EXPECT_EQ(degrade(doubles, options, 1, "", 1).points.size(), 10u);
}

}  // namespace
}  // namespace tcm_icp
