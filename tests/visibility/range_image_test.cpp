#include "tcm_icp/visibility/range_image.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

Vector3d direction(Rng& rng) {
  return Vector3d(standard_normal(rng), standard_normal(rng), standard_normal(rng)).normalized();
}

// Every bin and its neighbours, those beyond the borders of the map, too, see the ball.
TEST(RangeImage, ABallIsAsFarEverywhere) {
  Rng rng = make_stream(1, "range_image_test");
  const Vector3d middle(3, -2, 7);
  Points ball;
  for (int i = 0; i < 1'500'000; ++i) ball.push_back(middle + 5 * direction(rng));
  const RangeImage image(middle, ball);
  for (int i = 0; i < 2000; ++i) {
    const auto seen = image.about(direction(rng));
    EXPECT_EQ(seen.num_filled, 9);
    EXPECT_NEAR(seen.least_m, 5, 1e-5);  // floats
    EXPECT_NEAR(seen.greatest_m, 5, 1e-5);
  }
}

TEST(RangeImage, WhatLiesAboutADirectionIsSeenThere) {
  Rng rng = make_stream(2, "range_image_test");
  for (int i = 0; i < 500; ++i) {
    const Vector3d ray = direction(rng), aside = ray.cross(direction(rng)).normalized();
    // A bin is 0.6 to 1.4 degrees wide: half a degree away is at most the next one, four degrees are out of sight.
    const RangeImage image(Vector3d::Zero(), {4 * ray, 9 * (ray + 0.009 * aside), 2 * (ray + 0.07 * aside)});
    const auto seen = image.about(ray);
    EXPECT_GE(seen.num_filled, 1);
    EXPECT_LE(seen.num_filled, 2);
    EXPECT_NEAR(seen.least_m, 4, 1e-5);
    EXPECT_NEAR(seen.greatest_m, 9, 1e-3);
    EXPECT_EQ(image.about(-ray).num_filled, 0);
  }
}

TEST(RangeImage, OfNothingSeesNothing) {
  const RangeImage image(Vector3d(1, 2, 3), {});
  EXPECT_EQ(image.about(Vector3d::UnitX()).num_filled, 0);
}

}  // namespace
}  // namespace tcm_icp
