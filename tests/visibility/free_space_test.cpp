#include "tcm_icp/visibility/free_space.hpp"

#include <gtest/gtest.h>

#include "support/box_room.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kVoxel_m = 0.1;

// A scan that knows where it was taken from; its frame is that of the room, moved by `T`.
struct Seen {
  Seen(const testing::BoxRoom& room, const Vector3d& from, const Isometry3d& T = Isometry3d::Identity(),
       double unit = 1)
      : cloud(transformed(testing::scaled_cloud(testing::scan_room(room, from, 40'000), unit), T)),
        level{kVoxel_m * unit, cloud},
        sight(make_sight(Viewpoint{T * (unit * from), 0, 0, 5 * unit, {}}, cloud.points, cloud)) {}
  operator SightedScan() const { return {level, sight}; }  // NOLINT: a view

  Cloud cloud;
  PyramidLevel level;
  Sight sight;
};

testing::BoxRoom room(double x0, double x1) { return {AlignedBox3d(Vector3d(x0, 0, 0), Vector3d(x1, 4, 3)), {}}; }

// Two rooms with a wall of 0.12 m between them.
const testing::BoxRoom kLeft = room(0, 6), kRight = room(6.12, 9.12);

TEST(FreeSpace, TheRightPoseViolatesNothing) {
  const Seen a(kLeft, {1.5, 1, 1.5}), b(kLeft, {4.2, 3, 1.1}), c(kRight, {7, 2, 1.5});
  const FreeSpaceEvidence same = measure_free_space(a, b, Isometry3d::Identity());
  EXPECT_GT(same.num_points, 5000u);
  EXPECT_EQ(same.num_violating, 0u);
  EXPECT_GT(same.num_matches, 3000u);
  EXPECT_EQ(same.num_opposed, 0u);
  EXPECT_EQ(same.excess(), 0);
  EXPECT_FALSE(measure_free_space(a, c, Isometry3d::Identity()).vetoes()) << "rooms next to each other";
}

TEST(FreeSpace, AWallsOtherFaceIsNotThatFace) {
  const Seen a(kLeft, {3, 2, 1.5}), b(kRight, {7.5, 2, 1.5});
  const FreeSpaceEvidence e = measure_free_space(a, b, Isometry3d(Translation3d(-0.12, 0, 0)));
  EXPECT_EQ(e.num_violating, 0u) << "nobody sees through that wall";
  EXPECT_GT(e.num_matches, 500u);
  EXPECT_GT(e.opposed_share(), 0.5);
  EXPECT_TRUE(e.vetoes());
}

TEST(FreeSpace, ARoomWithinAnotherIsSeenThrough) {
  const Seen a(kLeft, {3, 2, 1.5}), b(kRight, {7.5, 2, 1.5});
  const FreeSpaceEvidence e = measure_free_space(a, b, Isometry3d(Translation3d(-4.5, 0, 0)));
  EXPECT_GT(e.violation_share(), 0.1);
  EXPECT_TRUE(e.vetoes());
  EXPECT_GT(e.excess(), 1);
}

TEST(FreeSpace, WhatStandsInOneScanIsSeenThroughByTheOther) {
  testing::BoxRoom furnished = kLeft;
  furnished.boxes.emplace_back(Vector3d(2.5, 1.5, 0), Vector3d(3.5, 2.5, 1));
  const Seen a(kLeft, {1, 2, 1.5}), b(furnished, {5, 2, 1.5});
  const FreeSpaceEvidence e = measure_violations(a, b, Isometry3d::Identity());
  const FreeSpaceEvidence back = measure_violations(b, a, Isometry3d::Identity());
  EXPECT_GT(e.num_violating_of_b, 50u);
  EXPECT_EQ(e.num_violating, e.num_violating_of_b);
  EXPECT_EQ(back.num_violating, e.num_violating);
  EXPECT_EQ(back.num_violating_of_b, 0u);
  EXPECT_EQ(back.num_points_of_b, e.num_points - e.num_points_of_b);
  FreeSpaceEvidence sum = e;
  sum += back;
  EXPECT_EQ(sum.num_points_of_b, e.num_points);
  EXPECT_EQ(sum.num_violating_of_b, e.num_violating);
}

// Rays of `a` are a degree apart: a metre, where the things stand that `b` is five metres from.
TEST(FreeSpace, WhatMayStandBetweenTwoRaysIsSmall) {
  const testing::BoxRoom hall{AlignedBox3d(Vector3d(0, -20, -20), Vector3d(90, 20, 20)), {}};
  const auto with_box = [&](double width_m) {
    testing::BoxRoom out = hall;
    out.boxes.emplace_back(Vector3d(65, -width_m / 2, -3), Vector3d(65.2, width_m / 2, 3));
    return out;
  };
  const Seen a(hall, {5, 0, 0}), post(with_box(0.2), {60, 0, 0}), wall(with_box(4), {60, 0, 0});
  const FreeSpaceEvidence at_wall = measure_violations(a, wall, Isometry3d::Identity());
  EXPECT_GT(at_wall.num_large_of_b, 30u);
  EXPECT_EQ(at_wall.num_large, at_wall.num_large_of_b);
  EXPECT_GE(at_wall.num_violating, at_wall.num_large);
  const FreeSpaceEvidence at_post = measure_violations(a, post, Isometry3d::Identity());
  EXPECT_GT(at_post.num_violating_of_b, 0u);
  EXPECT_EQ(at_post.num_large, 0u);
  const Seen beside(hall, {60, -4, 0});
  EXPECT_GT(measure_violations(beside, post, Isometry3d::Identity()).num_large_of_b, 2u) << "seen from nearby";
}

TEST(FreeSpace, ViolationsAreTheSameWithoutTheMatches) {
  const Seen a(kLeft, {3, 2, 1.5}), b(kRight, {7.5, 2, 1.5});
  const Isometry3d T_a_b(Translation3d(-4.5, 0, 0));
  const FreeSpaceEvidence all = measure_free_space(a, b, T_a_b), alone = measure_violations(a, b, T_a_b);
  ASSERT_GT(all.num_violating, 0u);
  ASSERT_GT(all.num_matches, 0u);
  EXPECT_EQ(alone.num_points, all.num_points);
  EXPECT_EQ(alone.num_violating, all.num_violating);
  EXPECT_EQ(alone.num_matches, 0u);
}

TEST(FreeSpace, IsTheSameTheOtherWayRoundInAnyFrameAndUnit) {
  Rng rng = make_stream(1, "free_space_test");
  const Seen a(kLeft, {3, 2, 1.5}), b(kRight, {7.5, 2, 1.5});
  const Isometry3d T_a_b(Translation3d(-4.5, 0.3, 0));
  const FreeSpaceEvidence e = measure_free_space(a, b, T_a_b), back = measure_free_space(b, a, T_a_b.inverse());
  EXPECT_EQ(e.num_violating, back.num_violating);
  EXPECT_EQ(e.num_points, back.num_points);
  EXPECT_EQ(e.num_opposed, back.num_opposed);
  for (const double unit : {1.0, 1000.0}) {
    const Isometry3d A = testing::random_pose(20 * unit, rng), B = testing::random_pose(20 * unit, rng);
    const Seen moved_a(kLeft, {3, 2, 1.5}, A, unit), moved_b(kRight, {7.5, 2, 1.5}, B, unit);
    const FreeSpaceEvidence moved =
        measure_free_space(moved_a, moved_b, A * testing::scaled_pose(T_a_b, unit) * B.inverse());
    EXPECT_NEAR(moved.violation_share(), e.violation_share(), 0.02) << "bins lie elsewhere";
    EXPECT_NEAR(moved.opposed_share(), e.opposed_share(), 0.02);
  }
}

TEST(FreeSpace, AScanWithoutAViewpointAbstains) {
  const Seen a(kLeft, {3, 2, 1.5}), b(kRight, {7.5, 2, 1.5});
  const Isometry3d wrong(Translation3d(-4.5, 0, 0));
  Sight none;
  const SightedScan blind_a{a.level, none}, blind_b{b.level, none};
  const FreeSpaceEvidence nobody = measure_free_space(blind_a, blind_b, wrong);
  EXPECT_EQ(nobody.num_points + nobody.num_matches, 0u);
  EXPECT_FALSE(nobody.vetoes());
  const FreeSpaceEvidence one = measure_free_space(a, blind_b, wrong);
  EXPECT_EQ(one.num_matches, 0u) << "a side takes two";
  EXPECT_TRUE(one.vetoes()) << "what a sees through it sees alone";
}

TEST(FreeSpace, AFewPointsVetoNothing) {
  FreeSpaceEvidence few{99, 99, 99, 99};
  EXPECT_FALSE(few.vetoes());
  few += FreeSpaceEvidence{1, 1, 0, 0};
  EXPECT_TRUE(few.vetoes());
  EXPECT_EQ(few.num_points, 100u);
}

// The places as good as the best are all asked; a surface edge-on to one of them has no side.
TEST(Sight, SidesAreThoseThatAllPlacesSee) {
  const testing::BoxRoom left = kLeft;
  const Cloud cloud = testing::scan_room(left, {3, 2, 1.5}, 2000);
  const Viewpoint rough{{3, 2, 1.5}, 0, 0.4, 4, {{3, 2, 3.2}}};  // the other place lies above the ceiling
  ASSERT_FALSE(rough.determined());
  const Sight sight = make_sight(rough, cloud.points, cloud);
  EXPECT_FALSE(sight.sees_space());
  ASSERT_TRUE(sight.knows_sides());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool ceiling = cloud.points[i].z() > 3 - 1e-9;
    EXPECT_EQ(sight.facing[i].isZero(), ceiling);
    EXPECT_EQ(sight.side(cloud.points[i], sight.facing[i]), ceiling ? 0 : 1);
    EXPECT_EQ(sight.side(cloud.points[i], -sight.facing[i]), ceiling ? 0 : -1);
  }
}

}  // namespace
}  // namespace tcm_icp
