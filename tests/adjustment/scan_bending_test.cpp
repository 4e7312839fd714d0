#include "adjustment/scan_bending.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "registration/link_scores.hpp"
#include "support/joint_scene.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

constexpr double kDeviation_m = 0.05;  // of D's entries

struct BentScene : testing::JointScene {
  Points places;
};

/// Of scans that are bent by so much, beside what joint_scene does to them.
BentScene bent_scene(const testing::JointSceneOptions& options, double deviation_m, Rng& rng) {
  BentScene scene{testing::joint_scene(options, rng), {}};
  std::vector<Eigen::Matrix3d> bends_m;
  for (std::size_t i = 0; i < options.num_scans; ++i) {
    scene.places.push_back({4.0 + 3.0 * static_cast<double>(i), 10, 2});
    bends_m.push_back(Eigen::Matrix3d::NullaryExpr([&] { return deviation_m * standard_normal(rng); }));
  }
  for (auto& link : scene.links) {
    for (auto& match : link.matches) {
      const Eigen::Vector3d offset_m = bends_m[link.source] * (match.source - scene.places[link.source]).normalized() -
                                       bends_m[link.target] * (match.target - scene.places[link.target]).normalized();
      match.target += match.normal.dot(offset_m) * match.normal;
    }
  }
  return scene;
}

constexpr double kMotion_m = 0.5;  // during a turn

/// Of scans from a row of places, by a scanner that turns to the left about the vertical, from the back on, and moves
/// along the row meanwhile.
BentScene moving_scene(const testing::JointSceneOptions& options, double motion_m, Rng& rng) {
  BentScene scene{testing::joint_scene(options, rng), {}};
  for (std::size_t i = 0; i < options.num_scans; ++i) scene.places.push_back({2.0 + static_cast<double>(i), 10, 2});
  const auto moved_m = [&](std::size_t scan, const Eigen::Vector3d& point) -> Eigen::Vector3d {
    const Eigen::Vector3d ray = point - scene.places[scan];
    return motion_m * std::atan2(ray.y(), ray.x()) / (2 * EIGEN_PI) * Eigen::Vector3d::UnitX();
  };
  for (auto& link : scene.links) {
    for (auto& match : link.matches) {
      // A scan that comes later sees what does not move farther back.
      const Eigen::Vector3d offset_m = moved_m(link.target, match.target) - moved_m(link.source, match.source);
      match.target -= match.normal.dot(offset_m) * match.normal;
    }
  }
  return scene;
}

enum class Known { kNothing, kPlace, kSweptPlace };

ScanBending bending_of(const BentScene& scene, Known known = Known::kSweptPlace) {
  std::vector<ScanOrigin> origins;
  for (const auto& place : scene.places) {
    const double sign = origins.size() % 2 == 0 ? 1 : -1;  // an axis has none
    origins.push_back({place, sign * Eigen::Vector3d::UnitZ(), known != Known::kNothing, known == Known::kSweptPlace});
  }
  ScanBending bending(origins);
  bending.set_poses(std::vector<Eigen::Isometry3d>(origins.size(), Eigen::Isometry3d::Identity()));
  bending.estimate(scene.links, scene.frames, {robust_noise_m(scene.links), 0.2}, 1);
  return bending;
}

double largest_error_m(const BentScene& scene, const std::vector<Twist>& steps_m) {
  double largest_m = 0;
  for (std::size_t i = 1; i < steps_m.size(); ++i) {
    largest_m = std::max(largest_m, (steps_m[i] - scene.truth_m[i]).norm());
  }
  return largest_m;
}

/// The joint problem is linear in the poses, so that each solution is of all of their steps.
std::vector<Twist> steps_m(const BentScene& scene, ScanBending* bending, int rounds) {
  std::vector<Twist> steps(scene.frames.size(), Twist::Zero());
  for (int round = 0; round < rounds; ++round) {
    std::vector<JointLink> links = scene.links;
    if (bending != nullptr) std::for_each(links.begin(), links.end(), [&](JointLink& l) { bending->straighten(l); });
    for (auto& link : links) {
      for (auto& match : link.matches) {
        const double moved = residual_gradient(match, scene.frames[link.source]).dot(steps[link.source]) -
                             residual_gradient(match, scene.frames[link.target]).dot(steps[link.target]);
        match.target -= moved * match.normal;
      }
    }
    const double threshold_m = kHuberFactor * robust_noise_m(links);
    const int unknowns = bending != nullptr ? kBentUnknowns : kPoseUnknowns;
    JointNormalEquations equations(scene.frames, 0, unknowns);
    for (const auto& link : links) {
      const TwistFrame &target = scene.frames[link.target], &source = scene.frames[link.source];
      if (bending != nullptr) {
        equations.add(link, bending->sums(link, target, source, threshold_m));
      } else {
        equations.add(link, huber_sums(link, target, source, threshold_m));
      }
    }
    if (bending != nullptr) bending->add_prior(equations);
    const Eigen::VectorXd x = equations.solve();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto first = static_cast<Eigen::Index>(i) * unknowns;
      steps[i] += x.segment<kPoseUnknowns>(first);
      if (bending != nullptr) bending->add_step(i, x.segment<kBendUnknowns>(first + kPoseUnknowns));
    }
  }
  return steps;
}

/// Sums over sets of the largest errors of poses.
struct Errors {
  double poses_alone_m = 0, with_bending_m = 0;

  /// The poses are right to begin with: what is solved for are the steps that bends make of nothing.
  void add(const BentScene& scene, ScanBending& bending) {
    poses_alone_m += largest_error_m(scene, steps_m(scene, nullptr, 15));
    with_bending_m += largest_error_m(scene, steps_m(scene, &bending, 15));
  }
};

TEST(ScanBending, IsFoundAndMovesPosesLess) {
  Errors errors;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Rng rng = make_stream(seed, "scan_bending_test");
    const BentScene scene =
        bent_scene({.num_scans = 6, .matches_per_link = 400, .noise_m = 0.01, .step_m = 0}, kDeviation_m, rng);
    ScanBending bending = bending_of(scene);
    ASSERT_TRUE(bending.any());
    EXPECT_LT(bending.offset_m(), 1.5 * std::sqrt(3) * kDeviation_m);
    EXPECT_GT(bending.offset_m(), 0.3 * std::sqrt(3) * kDeviation_m) << "rather less than too much";
    errors.add(scene, bending);
  }
  ASSERT_GT(errors.poses_alone_m, 4 * kDeviation_m) << "the start must fail";
  EXPECT_LT(errors.with_bending_m, 0.9 * errors.poses_alone_m) << "part of what bends is taken for noise";
}

TEST(ScanBending, IsNotFoundWhereThereIsNone) {
  int found = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    Rng rng = make_stream(seed, "scan_bending_test");
    const ScanBending bending = bending_of(bent_scene({.num_scans = 6, .noise_m = 0.02, .step_m = 0}, 0, rng));
    found += bending.any() ? 1 : 0;
    EXPECT_LT(bending.offset_m(), 0.2 * 0.02);
    EXPECT_LT(bending.motion_m(), 0.02);
  }
  EXPECT_LE(found, 2);
}

TEST(ScanBending, IsAskedOfSweptScansAlone) {
  Rng rng = make_stream(1, "scan_bending_test");
  const BentScene scene = bent_scene({.num_scans = 6, .noise_m = 0.01}, kDeviation_m, rng);
  EXPECT_TRUE(bending_of(scene).any());
  EXPECT_EQ(bending_of(scene, Known::kPlace).offset_m(), 0);
  EXPECT_FALSE(bending_of(scene, Known::kNothing).any());
}

TEST(ScanBending, MotionDuringATurnIsFoundAndMovesPosesLess) {
  Errors errors;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Rng rng = make_stream(seed, "scan_bending_test");
    const BentScene scene =
        moving_scene({.num_scans = 12, .matches_per_link = 400, .noise_m = 0.01, .step_m = 0}, kMotion_m, rng);
    ScanBending bending = bending_of(scene, Known::kPlace);
    EXPECT_LT(bending.motion_m(), 1.2 * kMotion_m);
    EXPECT_GT(bending.motion_m(), 0.4 * kMotion_m) << "rather less than too much";
    errors.add(scene, bending);
  }
  EXPECT_LT(errors.with_bending_m, 0.5 * errors.poses_alone_m);
}

TEST(ScanBending, MotionIsToldWherePlacesAreKnown) {
  Rng rng = make_stream(1, "scan_bending_test");
  const BentScene scene = moving_scene({.num_scans = 12, .noise_m = 0.01, .step_m = 0}, kMotion_m, rng);
  EXPECT_GT(bending_of(scene, Known::kPlace).motion_m(), 0);
  EXPECT_EQ(bending_of(scene, Known::kNothing).motion_m(), 0);
}

// What one pair says may be an error that all of its matches share.
TEST(ScanBending, IsNotToldFromOnePair) {
  Rng rng = make_stream(1, "scan_bending_test");
  EXPECT_FALSE(bending_of(bent_scene({.num_scans = 2, .noise_m = 0.01, .step_m = 0}, kDeviation_m, rng)).any());
}

// Which scan of a link comes first, and in which order links come, makes no difference.
TEST(ScanBending, DoesNotDependOnTheOrderOfLinks) {
  Rng rng = make_stream(2, "scan_bending_test");
  BentScene scene = bent_scene({.num_scans = 5, .noise_m = 0.01}, kDeviation_m, rng);
  const double offset_m = bending_of(scene).offset_m();
  std::reverse(scene.links.begin(), scene.links.end());
  EXPECT_NEAR(bending_of(scene).offset_m(), offset_m, 1e-9 * offset_m);
}

TEST(ScanBending, NothingToMatchIsNothing) {
  ScanOrigin origin;
  origin.located = origin.swept = true;
  ScanBending bending({origin, origin});
  bending.estimate({}, {{}, {}}, {0.01, 0.2}, 1);
  EXPECT_FALSE(bending.any());
  JointLink empty{0, 1, {}};
  bending.estimate({empty}, {{}, {}}, {0.01, 0.2}, 1);
  EXPECT_FALSE(bending.any());
  EXPECT_EQ(bending.sums(empty, {}, {}, 0.01).tt.norm(), 0);
}

}  // namespace
}  // namespace tcm_icp
