#include "tcm_icp/links/link_residuals.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

Correspondence match(const Eigen::Vector3d& source, const Eigen::Vector3d& normal, double distance_m) {
  return {source, source - distance_m * normal, normal, 1, 0.5};
}

// A wall about (3, 0, 1) with ten matches each way, a floor far away with fifteen, and a place only one scan sees.
std::vector<JointLink> wall_and_floor() {
  std::vector<JointLink> links{{4, 2, {}}, {2, 4, {}}};
  for (auto& link : links) {
    for (int i = 0; i < 10; ++i) link.matches.push_back(match({3, 0.01 * i, 1}, Eigen::Vector3d::UnitX(), 0.002));
    for (int i = 0; i < 15; ++i) link.matches.push_back(match({50, 0.01 * i, 0.5}, Eigen::Vector3d::UnitZ(), -0.003));
  }
  for (int i = 0; i < 90; ++i) links[0].matches.push_back(match({90, 0, 0.5}, Eigen::Vector3d::UnitX(), 0));
  return links;
}

TEST(LinkResiduals, AreSignedAndInTheScansOwnFrames) {
  std::vector<Eigen::Isometry3d> T(5, Eigen::Isometry3d::Identity());
  T[2].pretranslate(Eigen::Vector3d(1, 0, 0));
  const LinkResiduals r = link_residuals(wall_and_floor(), T, 1);
  ASSERT_EQ(r.matches.size(), 140U);
  EXPECT_TRUE(r.matches.front().of_b) << "the first link's source is b";
  EXPECT_FALSE(r.matches.back().of_b);
  EXPECT_FLOAT_EQ(r.matches.front().distance_m, 0.002F) << "not times its precision";
  EXPECT_FLOAT_EQ(r.matches.back().distance_m, -0.003F);
  EXPECT_FLOAT_EQ(r.matches.front().point.x(), 2) << "in the frame of scan 2";
}

TEST(LinkResiduals, MeetAtAWallRatherThanAFloorAndWhereBothAre) {
  std::vector<Eigen::Isometry3d> T(5, Eigen::Isometry3d::Identity());
  T[4].pretranslate(Eigen::Vector3d(0, 0, 7));
  const LinkResiduals r = link_residuals(wall_and_floor(), T, 1);
  ASSERT_TRUE(r.contact);
  EXPECT_NEAR((r.contact->point - Eigen::Vector3d(3, 0.045, -6)).norm(), 0.005, 1e-9) << "in the frame of scan a, 4";
  EXPECT_NEAR(std::abs(r.contact->normal.x()), 1, 1e-12);
  EXPECT_EQ(r.contact->num_matches, 20U);
}

TEST(LinkResiduals, OfNoMatchesHaveNoContact) {
  const std::vector<Eigen::Isometry3d> T(5, Eigen::Isometry3d::Identity());
  const LinkResiduals r = link_residuals({{0, 1, {}}, {1, 0, {}}}, T, 1);
  EXPECT_TRUE(r.matches.empty());
  EXPECT_FALSE(r.contact);
}

}  // namespace
}  // namespace tcm_icp
