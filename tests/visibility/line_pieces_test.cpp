#include "visibility/line_pieces.hpp"

#include <gtest/gtest.h>

#include "support/room_scans.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;
using testing::spinner;

// Lengths as they are.
UnitFrame metres() { return {}; }

std::vector<FlatPatch> patches_of(const Cloud& cloud) {
  return find_flat_patches(cloud.points, NeighborIndex(cloud.points), metres());
}

TEST(LinePieces, PatchesLieOnTheSurfaces) {
  const Cloud cloud = testing::spinning_scan(0.005);
  const auto patches = patches_of(cloud);
  ASSERT_GT(patches.size(), 1000u);
  std::size_t along_walls = 0;
  for (const FlatPatch& patch : patches) {
    EXPECT_NEAR(patch.axes.determinant() * patch.axes.determinant(), 1, 1e-9);
    along_walls += patch.axes.col(2).cwiseAbs().maxCoeff() > 0.98 ? 1 : 0;
    float sum = 0;
    for (const float z : patch.z) sum += z;
    EXPECT_NEAR(sum / FlatPatch::kPoints, 0, 1e-4);
  }
  EXPECT_GT(along_walls, 9 * patches.size() / 10);
}

TEST(LinePieces, RunAboutTheAxis) {
  const auto pieces = find_line_pieces(patches_of(testing::spinning_scan(0.02)), spinner(), 1);
  ASSERT_GT(pieces.middles.size(), 1000u);
  const Vector3d axis = testing::tilted() * Vector3d::UnitZ();
  std::size_t along = 0;
  for (std::size_t i = 0; i < pieces.middles.size(); ++i) {
    const Vector3d r = pieces.middles[i] - spinner();
    EXPECT_NEAR(pieces.directions[i].norm(), 1, 1e-6);
    EXPECT_NEAR(pieces.directions[i].dot(pieces.normals[i]), 0, 1e-6);
    const Vector3d across = (axis * r.squaredNorm() - r * axis.dot(r)).normalized();
    along += std::abs(pieces.directions[i].dot(across)) < 0.03 ? 1 : 0;
  }
  EXPECT_GT(along, 95 * pieces.middles.size() / 100);
}

TEST(LinePieces, NoiseHidesThemFromElsewhere) {
  const auto patches = patches_of(testing::spinning_scan(0.02));
  const auto count = [&](const Vector3d& from) { return find_line_pieces(patches, from, 1).middles.size(); };
  for (const Vector3d& off : {Vector3d(1.5, 0, 0), Vector3d(0, -1.5, 0), Vector3d(0, 0, 1.2), Vector3d(3, 2, 0)}) {
    EXPECT_LT(4 * count(spinner() + off), 3 * count(spinner())) << off.transpose();
  }
}

TEST(LinePieces, PointsAllOverShowFew) {
  const Cloud cloud = testing::scan_room(testing::furnished_room(), spinner(), 40'000);
  const auto patches = patches_of(cloud);
  ASSERT_GT(patches.size(), 1000u);
  EXPECT_LT(20 * find_line_pieces(patches, spinner(), 1).middles.size(), patches.size());
}

TEST(LinePieces, TooFewPointsHaveNoPatches) {
  Cloud few = testing::spinning_scan();
  few.points.resize(FlatPatch::kPoints - 1);
  EXPECT_TRUE(patches_of(few).empty());
  EXPECT_TRUE(find_line_pieces({}, spinner(), 1).middles.empty());
}

}  // namespace
}  // namespace tcm_icp
