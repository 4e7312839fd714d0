#include "tcm_icp/registration/link_strength.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/joint_scene.hpp"

namespace tcm_icp {
namespace {

std::vector<JointLink> pair_of(const testing::JointSceneOptions& options, std::uint64_t seed) {
  Rng rng = make_stream(seed, "link_strength_test");
  return testing::joint_scene(options, rng).links;
}

TEST(LinkStrength, OfNormalsOfAllDirectionsIsTheSameAlongEach) {
  const auto links = pair_of({.num_scans = 2, .matches_per_link = 2000, .noise_m = 0.02, .step_m = 0}, 1);
  const LinkStrength strength = link_strength(links, 0.02, 0.25);
  EXPECT_NEAR(strength.radius_m, std::sqrt((400 + 400 + 36) / 12.0), 0.2);
  for (const auto& axis : strength.axes) {
    // A third of the normals hold along each axis; arms of one direction hold more than of the other.
    EXPECT_GT(axis.slide_m, 0.02);
    EXPECT_LT(axis.slide_m, 0.02 * std::sqrt(3.0) * 1.7);
    EXPECT_LT(axis.sigma_m, 0.1 * axis.slide_m) << "4000 points average their noise out";
    const double arc = axis.rotation_per_m.norm() * strength.radius_m;
    EXPECT_NEAR(arc * arc + axis.translation.squaredNorm(), 1, 1e-9);
  }
  for (std::size_t k = 1; k < 6; ++k) EXPECT_GE(strength.axes[k - 1].slide_m, strength.axes[k].slide_m);
}

TEST(LinkStrength, GroundDoesNotHoldAlongItself) {
  const auto links = pair_of({.num_scans = 2, .noise_m = 0.02, .step_m = 0, .only_ground = true}, 2);
  const LinkStrength strength = link_strength(links, 0.02, 0.25);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(std::isinf(strength.axes[k].slide_m));
    EXPECT_NEAR(strength.axes[k].translation.z(), 0, 1e-6);
  }
  for (std::size_t k = 3; k < 6; ++k) EXPECT_LT(strength.axes[k].slide_m, 0.1);
}

// One of the two directions read backwards would double what it holds in noise: sigma is that of the truth.
TEST(LinkStrength, SigmaIsThatOfTheMotionBetweenTheScans) {
  const auto links = pair_of({.num_scans = 2, .matches_per_link = 1000, .noise_m = 0.02, .step_m = 0}, 3);
  const LinkStrength strength = link_strength(links, 0.02, 0.25);
  for (const auto& axis : strength.axes) {
    const double independent = axis.slide_m / std::sqrt(2000.0);
    EXPECT_GT(axis.sigma_m, 0.7 * independent);
    EXPECT_LT(axis.sigma_m, 1.6 * independent);
  }
}

TEST(LinkStrength, OfNothingIsNone) {
  const LinkStrength none = link_strength({}, 0.01, 1);
  EXPECT_EQ(none.num_matches, 0U);
  for (const auto& axis : none.axes) EXPECT_TRUE(std::isinf(axis.slide_m) && std::isinf(axis.sigma_m));
}

}  // namespace
}  // namespace tcm_icp
