#include "tcm_icp/visibility/viewpoint_by_lines.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/matchers.hpp"
#include "support/room_scans.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::spinner;
using testing::spinning_scan;
using testing::tilted;

const std::vector<Vector3d> kPlaces = {spinner(), Vector3d(6.8, 1.2, 1.2), Vector3d(1.2, 2.5, 2)};

std::optional<Viewpoint> find_by_lines(const Cloud& cloud) {
  Rng rng = make_stream(7, "viewpoint_by_lines_test");
  return find_viewpoint_by_lines(cloud, NeighborIndex(cloud.points), rng);
}

TEST(ViewpointByLines, IsWhereTheScannerTurned) {
  for (const Vector3d& from : kPlaces) {
    for (const Quaterniond& attitude : {Quaterniond::Identity(), tilted()}) {
      const auto found = find_by_lines(spinning_scan(0, from, attitude));
      ASSERT_TRUE(found) << from.transpose();
      EXPECT_TRUE(found->determined());
      EXPECT_EQ(found->evidence, ViewpointEvidence::kScanLines);
      EXPECT_GT(found->line_share, 0.95);
      EXPECT_LT((found->place - from).norm(), 0.01);
      EXPECT_LT(found->radius_m, 0.05);
    }
  }
}

// Points lie 5 to 30 mm apart along their lines.
TEST(ViewpointByLines, NoiseOfRangesHidesItNot) {
  for (const Vector3d& from : kPlaces) {
    const auto found = find_by_lines(spinning_scan(0.03, from));
    ASSERT_TRUE(found) << from.transpose();
    EXPECT_GT(found->line_share, 0.95);
    EXPECT_LT((found->place - from).norm(), 0.02);
  }
}

TEST(ViewpointByLines, OfEqualStepsBothWays) {
  for (const Vector3d& from : kPlaces) {
    for (const double noise_m : {0.0, 0.003, 0.02}) {
      const Cloud scan =
          testing::scan_room(testing::furnished_room(), from, testing::rays_of_steps(tilted(), 0.6, 0.6));
      const auto found = find_by_lines(testing::with_range_noise(scan, from, noise_m));
      ASSERT_TRUE(found) << from.transpose() << ", noise " << noise_m;
      EXPECT_LT((found->place - from).norm(), 0.02) << from.transpose() << ", noise " << noise_m;
    }
  }
}

// A tripod scanner whose mirror turns about a level axis: its lines run up and down, through one vertical axis.
TEST(ViewpointByLines, VerticalProfilesGiveNoWrongOne) {
  const Points rays = testing::rays_of_steps(tilted(), 1.5, 0.3, -50, 70);
  for (const Vector3d& from : kPlaces) {
    const auto found = find_by_lines(testing::scan_room(testing::furnished_room(), from, rays));
    if (found) {
      EXPECT_LT((found->place - from).norm(), 0.05) << from.transpose();
    }
  }
}

TEST(ViewpointByLines, MovesWithTheScanAndGrowsWithItsUnit) {
  const Cloud cloud = spinning_scan(0.01);
  Rng rng = make_stream(1, "viewpoint_by_lines_test poses");
  for (const double unit : {0.001, 1.0, 1000.0}) {
    const Eigen::Isometry3d T = testing::scaled_pose(testing::random_pose(50, rng), unit);
    const auto found = find_by_lines(transformed(testing::scaled_cloud(cloud, unit), T));
    ASSERT_TRUE(found);
    EXPECT_LT((T.inverse() * found->place / unit - spinner()).norm(), 0.01);
  }
}

TEST(ViewpointByLines, LostPointsMoveItLittle) {
  Rng rng = make_stream(2, "viewpoint_by_lines_test lost");
  const Cloud all = spinning_scan(0.01);
  Cloud kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (uniform01(rng) < 0.5) continue;
    kept.points.push_back(all.points[i]);
    kept.normals.push_back(all.normals[i]);
  }
  const auto found = find_by_lines(kept);
  ASSERT_TRUE(found);
  EXPECT_LT((found->place - spinner()).norm(), 0.02);
}

TEST(ViewpointByLines, WhereThereAreNoneThereIsNone) {
  const Cloud even = testing::scan_room(testing::furnished_room(), spinner(), 40'000);
  EXPECT_FALSE(find_by_lines(even)) << "rays all over the sphere";
  const Cloud thinned = voxel_downsample(spinning_scan(), 0.15);
  EXPECT_FALSE(find_by_lines(thinned)) << "a grid leaves no lines";
  EXPECT_FALSE(find_by_lines(Cloud())) << "no points";
}

TEST(ViewpointByLines, TwoScansMadeOneHaveNone) {
  for (const Vector3d& other : {kPlaces[1], kPlaces[2]}) {
    Cloud both = spinning_scan(0.01);
    const Cloud second = spinning_scan(0.01, other, Quaterniond::Identity());
    both.points.insert(both.points.end(), second.points.begin(), second.points.end());
    both.normals.insert(both.normals.end(), second.normals.begin(), second.normals.end());
    EXPECT_FALSE(find_by_lines(both)) << other.transpose();
  }
}

// Level ground under a scanner that flies: its lines are straight and parallel, and turn about nothing.
TEST(ViewpointByLines, AStripFromTheAirHasNone) {
  Rng rng = make_stream(3, "viewpoint_by_lines_test strip");
  Cloud strip;
  for (int line = 0; line < 200; ++line) {
    for (int k = 0; k < 300; ++k) {
      const double x = 1.5 * line, y = 0.5 * k;
      strip.points.emplace_back(x, y, 5 * std::sin(x / 40) * std::cos(y / 30) + 0.05 * standard_normal(rng));
      strip.normals.emplace_back(0, 0, 1);
    }
  }
  EXPECT_FALSE(find_by_lines(strip));
}

TEST(ViewpointByLines, TheSameNumbersGiveTheSameBits) {
  const Cloud cloud = spinning_scan(0.02);
  const auto a = find_by_lines(cloud), b = find_by_lines(cloud);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->place, b->place);
  EXPECT_EQ(a->radius_m, b->radius_m);
}

}  // namespace
}  // namespace tcm_icp
