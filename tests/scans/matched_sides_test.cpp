#include "scans/matched_sides.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Matches on the plane x = 0: the target was taken at x = 5, in front of it.
class MatchedSides : public ::testing::Test {
 protected:
  static Sight at(const Vector3d& place) {
    Sight sight;
    sight.places = {place};
    return sight;
  }
  /// `num_opposed` of them on a wall's other face, whose source lies at x = -5.
  static Correspondences matches(int num_alike, int num_opposed) {
    Correspondences out;
    for (int i = 0; i < num_alike + num_opposed; ++i) {
      const double y = 0.1 * i;
      // A floor below is seen from above by both.
      const bool is_floor = i < num_alike;
      const Vector3d p = is_floor ? Vector3d(y, 0, -1) : Vector3d(0, y, 0);
      out.push_back({p, p, is_floor ? Vector3d::UnitZ() : Vector3d::UnitX()});
    }
    return out;
  }

  const Sight target_ = at({5, 0, 1});
  const Isometry3d T_target_source_{Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(1, Vector3d::UnitZ())};
  const Sight behind_ = at(T_target_source_.inverse() * Vector3d(-5, 0, 1));
  const Sight in_front_ = at(T_target_source_.inverse() * Vector3d(4, 1, 1));
};

TEST_F(MatchedSides, ThoseOfAWallsOtherFaceAreDropped) {
  Correspondences m = matches(30, 20);
  drop_opposed(target_, behind_, T_target_source_, m);
  ASSERT_EQ(m.size(), 30u);
  for (const Correspondence& c : m) EXPECT_EQ(c.normal, Vector3d::UnitZ());
}

TEST_F(MatchedSides, ThoseSeenFromOneSideStay) {
  Correspondences m = matches(30, 20);
  drop_opposed(target_, in_front_, T_target_source_, m);
  EXPECT_EQ(m.size(), 50u);
}

// Along a corridor few matches hold a scan: of one in fifty depends where it ends.
TEST_F(MatchedSides, AFewAreDroppedLikeMany) {
  Correspondences m = matches(98, 2);
  drop_opposed(target_, behind_, T_target_source_, m);
  EXPECT_EQ(m.size(), 98u);
}

TEST_F(MatchedSides, WhereOneScanKnowsNoSidesAllStay) {
  Correspondences m = matches(10, 40);
  drop_opposed(target_, Sight{}, T_target_source_, m);
  drop_opposed(Sight{}, behind_, T_target_source_, m);
  EXPECT_EQ(m.size(), 50u);
  drop_opposed(target_, behind_, T_target_source_, m);
  EXPECT_EQ(m.size(), 10u) << "whichever way a normal points";
}

// 10 of a floor, 5 of a wall between both scanners.
TEST_F(MatchedSides, GuessedPlacesMakeOppositeOnesDoubtedAndDropNone) {
  Sight guess;
  guess.guessed_places = behind_.places;
  Correspondences m = matches(10, 5);
  drop_opposed(target_, guess, T_target_source_, m);
  ASSERT_EQ(m.size(), 15u);
  const std::vector<bool> doubted = may_be_opposed(target_, guess, T_target_source_, m);
  for (std::size_t k = 0; k < m.size(); ++k) EXPECT_EQ(doubted[k], k >= 10) << k;
  for (const bool any : may_be_opposed(target_, Sight{}, T_target_source_, m)) EXPECT_FALSE(any) << "not even a guess";
}

}  // namespace
}  // namespace tcm_icp
