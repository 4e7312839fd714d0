#include "tcm_icp/visibility/scan_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/box_room.hpp"
#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"
#include "visibility/sweep_fit.hpp"

namespace tcm_icp {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d kSpinner(2.9, 2.4, 1.5);
const Quaterniond kTilted(AngleAxisd(0.1, Vector3d(1, 2, 0).normalized()));

Cloud spinning_scan(const Vector3d& from = kSpinner, const Quaterniond& attitude = kTilted) {
  return testing::scan_room(testing::furnished_room(), from, testing::rays_of_spinning_scanner(attitude));
}

LinePieces pieces_of(const Cloud& cloud) { return find_line_pieces(cloud.points, NeighborIndex(cloud.points)); }

std::optional<Viewpoint> find_by_lines(const Cloud& cloud, const LinePieces& pieces) {
  Rng rng = make_stream(7, "scan_lines_test");
  return find_viewpoint_by_lines(cloud, pieces, rng);
}

std::optional<Viewpoint> find_by_lines(const Cloud& cloud) { return find_by_lines(cloud, pieces_of(cloud)); }

TEST(ScanLines, PiecesLieAlongTheLines) {
  const Cloud cloud = spinning_scan();
  const LinePieces pieces = pieces_of(cloud);
  ASSERT_GT(pieces.middles.size(), cloud.size() / 4);
  ASSERT_EQ(pieces.middles.size(), pieces.directions.size());
  const Sweep truth{kSpinner, kTilted * Vector3d::UnitZ(), 0}, elsewhere{kSpinner + Vector3d(1, 0, 0), truth.axis, 0};
  EXPECT_GT(share_of_sweep(truth, pieces, 0.02, 1), 0.97);
  EXPECT_LT(share_of_sweep(elsewhere, pieces, 0.02, 1), 0.5);
}

TEST(ScanLines, CentreIsWhereTheScannerTurned) {
  for (const Vector3d& from : {kSpinner, Vector3d(6.8, 1.2, 1.2), Vector3d(1.2, 2.5, 2)}) {
    for (const Quaterniond& attitude : {Quaterniond::Identity(), kTilted}) {
      const auto found = find_by_lines(spinning_scan(from, attitude));
      ASSERT_TRUE(found) << from.transpose();
      EXPECT_TRUE(found->determined());
      EXPECT_EQ(found->evidence, ViewpointEvidence::kScanLines);
      EXPECT_GT(found->line_share, 0.95);
      EXPECT_LT((found->place - from).norm(), 0.01);
      EXPECT_LT(found->radius_m, 0.05);
    }
  }
}

TEST(ScanLines, CentreMovesWithTheScanAndGrowsWithItsUnit) {
  const Cloud cloud = spinning_scan();
  Rng rng = make_stream(1, "scan_lines_test poses");
  for (const double unit : {0.001, 1.0, 1000.0}) {
    const Eigen::Isometry3d T = testing::scaled_pose(testing::random_pose(50, rng), unit);
    const auto found = find_by_lines(transformed(testing::scaled_cloud(cloud, unit), T));
    ASSERT_TRUE(found);
    EXPECT_LT((T.inverse() * found->place / unit - kSpinner).norm(), 0.01);
  }
}

TEST(ScanLines, NoiseAndLostPointsMoveItLittle) {
  Rng rng = make_stream(2, "scan_lines_test noise");
  Cloud all = spinning_scan(), kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (uniform01(rng) < 0.5) continue;
    const Vector3d ray = (all.points[i] - kSpinner).normalized();
    kept.points.push_back(all.points[i] + 0.002 * standard_normal(rng) * ray);
    kept.normals.push_back(all.normals[i]);
  }
  const auto found = find_by_lines(kept);
  ASSERT_TRUE(found);
  EXPECT_LT((found->place - kSpinner).norm(), 0.05);
}

TEST(ScanLines, WhereThereAreNoneThereIsNoCentre) {
  const Cloud even = testing::scan_room(testing::furnished_room(), kSpinner, 40'000);
  EXPECT_FALSE(find_by_lines(even)) << "rays all over the sphere";
  const Cloud thinned = voxel_downsample(spinning_scan(), 0.15);
  EXPECT_FALSE(find_by_lines(thinned)) << "a grid leaves no lines";
  EXPECT_FALSE(find_by_lines(Cloud(), {})) << "no points";
}

TEST(ScanLines, PiecesThatAgreeOnNoCentreGiveNone) {
  Rng rng = make_stream(3, "scan_lines_test random");
  const Cloud cloud = spinning_scan();
  LinePieces random = pieces_of(cloud), parallel = random;
  for (auto& t : random.directions) t = testing::random_pose(1, rng).linear().col(0);
  for (auto& t : parallel.directions) t = Vector3d(1, 2, 0.1).normalized();
  EXPECT_FALSE(find_by_lines(cloud, random));
  EXPECT_FALSE(find_by_lines(cloud, parallel)) << "as a strip from the air has them";
}

// A tripod scanner whose mirror turns about a level axis: its lines run up and down, through one vertical axis.
TEST(ScanLines, VerticalProfilesGiveNoWrongCentre) {
  Points rays;
  for (int line = 0; line < 240; ++line) {
    const double azimuth = 2 * EIGEN_PI * line / 240;
    for (int k = 0; k < 400; ++k) {
      const double elevation = (-50 + 0.3 * k) * EIGEN_PI / 180;
      rays.push_back(kTilted * Vector3d(std::cos(elevation) * std::cos(azimuth),
                                        std::cos(elevation) * std::sin(azimuth), std::sin(elevation)));
    }
  }
  for (const Vector3d& from : {kSpinner, Vector3d(6.8, 1.2, 1.2), Vector3d(1.2, 2.5, 2)}) {
    const Cloud cloud = testing::scan_room(testing::furnished_room(), from, rays);
    EXPECT_GT(pieces_of(cloud).middles.size(), 1000u);
    const auto found = find_by_lines(cloud);
    if (found) {
      EXPECT_LT((found->place - from).norm(), 0.05) << from.transpose();
    }
  }
}

TEST(ScanLines, TheSameNumbersGiveTheSameBits) {
  const Cloud cloud = spinning_scan();
  const auto a = find_by_lines(cloud), b = find_by_lines(cloud);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->place, b->place);
  EXPECT_EQ(a->radius_m, b->radius_m);
}

}  // namespace
}  // namespace tcm_icp
