#include "tcm_icp/visibility/sight.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0, 0, 1);

Sight from(Points places) {
  Sight sight;
  sight.places = std::move(places);
  return sight;
}

TEST(Sight, TellsTheSideThatAllPlacesLieOn) {
  const Sight one = from({{0, 0, 2}});
  EXPECT_EQ(one.side(Vector3d(1, 0, 0), kUp), 1);
  EXPECT_EQ(one.side(Vector3d(1, 0, 0), -kUp), -1);
  EXPECT_EQ(one.side(Vector3d(1, 0, 3), kUp), -1) << "a ceiling";
  const Sight two = from({{0, 0, 2}, {0, 0, 4}});
  EXPECT_EQ(two.side(Vector3d(1, 0, 0), kUp), 1);
  EXPECT_EQ(two.side(Vector3d(1, 0, 3), kUp), 0) << "above the one place, below the other";
}

TEST(Sight, AtAGrazingAngleNoSideIsKnown) {
  const Sight sight = from({{0, 0, 1}});
  EXPECT_EQ(sight.side(Vector3d(5, 0, 0), kUp), 1);
  EXPECT_EQ(sight.side(Vector3d(50, 0, 0), kUp), 0) << "1 in 50";
  EXPECT_EQ(from({}).side(Vector3d(1, 0, 0), kUp), 0) << "no place";
}

TEST(Sight, NeedsAViewpointThatIsDetermined) {
  const Points points{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const Cloud surfaces{points, {kUp, kUp, -kUp}};
  EXPECT_FALSE(make_sight(std::nullopt, points, surfaces).knows_sides());
  Viewpoint viewpoint{Vector3d(0, 0, 2), 0.5, 0, 10, {}};
  EXPECT_FALSE(make_sight(viewpoint, points, surfaces).knows_sides()) << "half of the points hidden";
  EXPECT_EQ(make_sight(viewpoint, points, surfaces).side(Vector3d(1, 0, 0), kUp), 0);
  EXPECT_EQ(make_sight(viewpoint, points, surfaces).guessed_side(Vector3d(1, 0, 0), kUp), 1) << "a guess all the same";
  viewpoint.hidden_share = 0;
  viewpoint.radius_m = 1;  // a tenth of the extent: sides, but no space
  EXPECT_TRUE(make_sight(viewpoint, points, surfaces).knows_sides());
  EXPECT_FALSE(make_sight(viewpoint, points, surfaces).sees_space());
  viewpoint.radius_m = 0.1;
  const Sight sight = make_sight(viewpoint, points, surfaces);
  EXPECT_TRUE(sight.sees_space());
  EXPECT_TRUE(sight.guessed_places.empty());
  EXPECT_EQ(sight.guessed_side(Vector3d(1, 0, 0), -kUp), -1);
  EXPECT_EQ(sight.facing, (Points{kUp, kUp, kUp}));
}

}  // namespace
}  // namespace tcm_icp
