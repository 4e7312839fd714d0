#include "report/plan_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tcm_icp::html {
namespace {

using Eigen::Vector2d;

double smallest_distance(const PlanLayout& plan) {
  double smallest = plan.width;
  for (std::size_t i = 0; i < plan.at.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, (plan.at[i] - plan.at[j]).norm());
  }
  return smallest;
}

void expect_all_inside(const PlanLayout& plan) {
  for (const auto& p : plan.at) {
    EXPECT_GE(p.minCoeff(), plan.disc);
    EXPECT_LE(p.x(), plan.width - plan.disc);
    EXPECT_LE(p.y(), plan.height - plan.disc);
  }
}

TEST(PlanLayout, KeepsProportionsWithNorthUp) {
  const PlanLayout plan = lay_out_plan({{5e5, 5e6}, {5e5 + 30, 5e6}, {5e5, 5e6 + 40}}, {10, 10, 10});
  EXPECT_FALSE(plan.moved);
  expect_all_inside(plan);
  EXPECT_NEAR(plan.at[1].x() - plan.at[0].x(), 30 * plan.scale, 1e-6);
  EXPECT_NEAR(plan.at[2].y() - plan.at[0].y(), -40 * plan.scale, 1e-6);
  EXPECT_NEAR(plan.at[1].y(), plan.at[0].y(), 1e-6);
}

TEST(PlanLayout, IsTheSameForEveryUnit) {
  const PlanLayout metres = lay_out_plan({{0, 0}, {30, 5}, {7, 40}}, {10, 20, 30});
  const PlanLayout millimetres = lay_out_plan({{0, 0}, {30e3, 5e3}, {7e3, 40e3}}, {10e3, 20e3, 30e3});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((metres.at[i] - millimetres.at[i]).norm(), 1e-6);
}

TEST(PlanLayout, MovesDiscsApartThatStandInOnePlace) {
  for (const double extent_m : {0.0, 1.0}) {
    const PlanLayout plan = lay_out_plan(std::vector<Vector2d>(10, Vector2d(3, 4)), std::vector<double>(10, extent_m));
    EXPECT_TRUE(plan.moved);
    expect_all_inside(plan);
    EXPECT_GT(smallest_distance(plan), 2 * plan.disc);
  }
}

// Sixty along a street do not fit side by side.
TEST(PlanLayout, HasRoomForManyScans) {
  std::vector<Vector2d> street;
  for (int i = 0; i < 60; ++i) street.emplace_back(2.0 * i, 0.01 * i);
  const PlanLayout plan = lay_out_plan(street, std::vector<double>(60, 20));
  expect_all_inside(plan);
  EXPECT_GT(smallest_distance(plan), plan.disc) << "every number can be read";
}

TEST(PlanLayout, ScaleIsARoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(round_length(0.0199), 0.01);
  EXPECT_DOUBLE_EQ(round_length(2), 2);
  EXPECT_DOUBLE_EQ(round_length(49.9), 20);
  EXPECT_DOUBLE_EQ(round_length(99), 50);
}

}  // namespace
}  // namespace tcm_icp::html
