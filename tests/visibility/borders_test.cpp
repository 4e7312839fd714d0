#include "tcm_icp/visibility/borders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/box_room.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kDoor_m = 1.2;

// A wall at y = 1 parts a corridor from a room behind it; a door from x = 6 on, without a lintel.
testing::BoxRoom corridor_room(bool with_door) {
  testing::BoxRoom room{AlignedBox3d(Vector3d(0, -1, 0), Vector3d(12, 6, 3)), {}};
  const double end_m = with_door ? 6 : 6 + kDoor_m;
  room.boxes.push_back(AlignedBox3d(Vector3d(-1, 1, -1), Vector3d(end_m, 1.1, 4)));
  room.boxes.push_back(AlignedBox3d(Vector3d(6 + kDoor_m, 1, -1), Vector3d(13, 1.1, 4)));
  return room;
}

struct SeenFromTheCorridor {
  explicit SeenFromTheCorridor(const testing::BoxRoom& room, const Isometry3d& T = Isometry3d::Identity(),
                               bool knows_where = true)
      : cloud(transformed(testing::scan_room(room, kFrom, 60'000), T)), level{0.1, cloud} {
    if (knows_where) sight = make_sight(Viewpoint{T * kFrom, 0, 0, 5, {}}, cloud.points, cloud);
  }
  Cloud borders() const { return find_borders({level, sight}); }

  inline static const Vector3d kFrom{5.2, 0, 1.5};
  Cloud cloud;
  PyramidLevel level;
  Sight sight;
};

TEST(Borders, AreWhereAWallEndsAtADoor) {
  const Cloud borders = SeenFromTheCorridor(corridor_room(true)).borders();
  int left = 0, right = 0;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const Vector3d& p = borders.points[i];
    EXPECT_NEAR(borders.normals[i].norm(), 1, 1e-12);
    if (std::abs(p.y() - 1) > 0.01 || std::abs(borders.normals[i].x()) < 0.7) continue;  // sees behind the door, too
    const bool is_left = std::abs(p.x() - 6) < 0.15 && borders.normals[i].x() > 0;
    const bool is_right = std::abs(p.x() - 6 - kDoor_m) < 0.25 && borders.normals[i].x() < 0;
    EXPECT_TRUE(is_left || is_right) << p.transpose() << ": " << borders.normals[i].transpose();
    left += is_left ? 1 : 0;
    right += is_right ? 1 : 0;
  }
  EXPECT_GT(left, 30);
  EXPECT_GT(right, 15) << "seen more nearly along the wall";
}

TEST(Borders, AWallWithoutADoorHasNone) {
  const Cloud borders = SeenFromTheCorridor(corridor_room(false)).borders();
  EXPECT_TRUE(borders.empty()) << borders.size();
}

TEST(Borders, MoveWithTheScan) {
  Rng rng = make_stream(1, "borders_test");
  const Isometry3d T = testing::random_pose(30, rng);
  const Cloud plain = SeenFromTheCorridor(corridor_room(true)).borders(),
              moved = SeenFromTheCorridor(corridor_room(true), T).borders();
  const NeighborIndex index(transformed(plain, T).points);
  std::size_t known = 0;
  for (const Vector3d& p : moved.points) known += index.nearest_within(p, 1e-6).found() ? 1 : 0;
  ASSERT_GT(plain.size(), 50u);
  EXPECT_GT(static_cast<double>(known), 0.8 * static_cast<double>(plain.size())) << "bins lie otherwise";
}

TEST(Borders, AScanThatDoesNotKnowWhereItWasTakenFromHasNone) {
  EXPECT_TRUE(SeenFromTheCorridor(corridor_room(true), Isometry3d::Identity(), false).borders().empty());
}

}  // namespace
}  // namespace tcm_icp
