#include "tcm_icp/visibility/viewpoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/box_room.hpp"
#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

const Vector3d kScanner(2.9, 2.4, 1.5);
// A ray in 60,000 stands for 0.8 degrees, 5 cm at the far wall; the shadows' edges are known as well as that.
constexpr std::size_t kRays = 60'000;
constexpr double kTolerance_m = 0.1;

std::optional<Viewpoint> find(const Cloud& cloud, std::vector<Vector3d> guesses = {}) {
  Rng rng = make_stream(7, "viewpoint_test");
  return find_viewpoint(cloud, guesses, rng);
}

TEST(Viewpoint, IsWhereTheScannerStood) {
  const testing::BoxRoom room = testing::furnished_room();
  for (const Vector3d& from : {kScanner, Vector3d(6.8, 1.2, 1.2), Vector3d(1.2, 2.5, 2)}) {
    const auto found = find(testing::scan_room(room, from, kRays));
    ASSERT_TRUE(found);
    // In the third place, beside two walls, places as good lie along a line that leads away from it.
    EXPECT_EQ(found->determined(), from.x() > 2) << from.transpose();
    EXPECT_LT((found->place - from).norm(), kTolerance_m);
    // Those that a descent along a valley found may lie beyond the radius, up to where sides are told from.
    const double farthest_m = std::max(found->radius_m, 0.12 * found->extent_m) * (1 + 1e-6);
    for (const auto& p : found->alternatives) EXPECT_LE((p - found->place).norm(), farthest_m);
  }
}

// What one of the places sees lies behind what the other saw.
TEST(Viewpoint, TwoScansMadeOneHaveNone) {
  const testing::BoxRoom room = testing::furnished_room();
  Cloud both = testing::scan_room(room, kScanner, kRays / 2);
  ASSERT_TRUE(find(both)->determined());
  const Cloud other = testing::scan_room(room, {6.8, 1.2, 1.2}, kRays / 2);
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  both.normals.insert(both.normals.end(), other.normals.begin(), other.normals.end());
  EXPECT_FALSE(find(both)->determined());
}

TEST(Viewpoint, MovesWithTheScanAndGrowsWithItsUnit) {
  const Cloud cloud = testing::scan_room(testing::furnished_room(), kScanner, kRays);
  Rng rng = make_stream(1, "viewpoint_test poses");
  for (const double unit : {0.001, 1.0, 1000.0}) {
    const Eigen::Isometry3d T = testing::scaled_pose(testing::random_pose(50, rng), unit);
    const auto found = find(transformed(testing::scaled_cloud(cloud, unit), T));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->determined());
    EXPECT_LT((T.inverse() * found->place / unit - kScanner).norm(), kTolerance_m);
  }
}

TEST(Viewpoint, TheSameNumbersGiveTheSameBits) {
  const Cloud cloud = testing::scan_room(testing::furnished_room(), kScanner, 5000);
  const auto a = find(cloud), b = find(cloud);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->place, b->place);
  EXPECT_EQ(a->radius_m, b->radius_m);
  EXPECT_EQ(a->alternatives, b->alternatives);
}

TEST(Viewpoint, AGuessFarFromThePlaceDoesNoHarm) {
  const auto found = find(testing::scan_room(testing::furnished_room(), kScanner, kRays), {Vector3d(4e6, 5e6, 100)});
  ASSERT_TRUE(found);
  EXPECT_LT((found->place - kScanner).norm(), kTolerance_m);
}

// Strips are seen from every place above: each point from another.
TEST(Viewpoint, ASurveyFromTheAirHasNone) {
  Rng rng = make_stream(2, "viewpoint_test air");
  Cloud cloud;
  for (int i = 0; i < 20'000; ++i) {
    const double x = 200 * uniform01(rng), y = 200 * uniform01(rng);
    const bool roof = std::fmod(x, 40) < 15 && std::fmod(y, 40) < 15;
    cloud.points.emplace_back(x, y, roof ? 10 : 0);
    cloud.normals.push_back(Vector3d::UnitZ());
  }
  const auto found = find(cloud);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->determined());
  EXPECT_FALSE(found->roughly_determined());
}

TEST(Viewpoint, APlaneAndABallHaveNone) {
  Rng rng = make_stream(3, "viewpoint_test shapes");
  Cloud plane, ball;
  for (int i = 0; i < 5000; ++i) {
    plane.points.emplace_back(uniform01(rng), uniform01(rng), 0);
    plane.normals.push_back(Vector3d::UnitZ());
    const Vector3d n = Vector3d(standard_normal(rng), standard_normal(rng), standard_normal(rng)).normalized();
    ball.points.push_back(3 * n);
    ball.normals.push_back(n);
  }
  for (const Cloud& cloud : {plane, ball}) {
    const auto found = find(cloud);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->place.allFinite());
    EXPECT_FALSE(found->roughly_determined());
  }
}

TEST(Viewpoint, IsNotLookedForWhereThereIsNothingToSee) {
  EXPECT_FALSE(find({}));
  Cloud line;
  for (int i = 0; i < 1000; ++i) {
    line.points.emplace_back(i, 0, 0);
    line.normals.push_back(Vector3d::UnitZ());
  }
  EXPECT_FALSE(find(line)) << "no size but its length";
  Cloud rough = testing::scan_room(testing::furnished_room(), kScanner, 1000);
  for (auto& n : rough.normals) n.setZero();
  EXPECT_FALSE(find(rough)) << "no surfaces";
  rough.normals.clear();
  EXPECT_FALSE(find(rough)) << "no normals";
}

}  // namespace
}  // namespace tcm_icp
