#include "registration/joint_normal_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

constexpr double kSpacing_m = 10, kRadius_m = 15, kReach_m = 20;
constexpr int kMatchesOfLink = 60;

// Motion of a scan about its own frame, at a point.
Eigen::Vector3d motion(const TwistFrame& frame, const Twist& step_m, const Eigen::Vector3d& point) {
  const Eigen::Vector3d rotation = step_m.head<3>() / frame.radius_m;
  return step_m.tail<3>() + rotation.cross(point - frame.centre);
}

std::vector<TwistFrame> frames_along_a_street(std::size_t num_scans) {
  std::vector<TwistFrame> frames;
  for (std::size_t i = 0; i < num_scans; ++i) {
    frames.push_back({Eigen::Vector3d(kSpacing_m * static_cast<double>(i), 0, 0), kRadius_m});
  }
  return frames;
}

// Neighbours matched with each other, exact matches on planes of the given normals: the right step is `truth_m`.
std::vector<JointLink> chain(const std::vector<TwistFrame>& frames, const std::vector<Twist>& truth_m,
                             const std::vector<Eigen::Vector3d>& normals, Rng& rng) {
  std::vector<JointLink> links;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    JointLink link{i, i + 1, {}};
    for (int k = 0; k < kMatchesOfLink; ++k) {
      Correspondence m;
      m.normal = normals[static_cast<std::size_t>(k) % normals.size()];
      m.source = frames[i].centre;
      for (int axis = 0; axis < 3; ++axis) m.source[axis] += kReach_m * (2 * uniform01(rng) - 1);
      m.target = m.source + (motion(frames[i + 1], truth_m[i + 1], m.source) - motion(frames[i], truth_m[i], m.source));
      link.matches.push_back(m);
    }
    links.push_back(std::move(link));
  }
  return links;
}

std::vector<Twist> solve(const std::vector<TwistFrame>& frames, const std::vector<JointLink>& links) {
  JointNormalEquations equations(frames, 0);
  for (const auto& link : links) {
    equations.add(link, huber_sums(link, frames[link.target], frames[link.source], 1));
  }
  const Eigen::VectorXd x = equations.solve();
  std::vector<Twist> steps_m;
  for (std::size_t i = 0; i < frames.size() && x.size() > 0; ++i) {
    steps_m.emplace_back(x.segment<6>(static_cast<Eigen::Index>(6 * i)));
  }
  return steps_m;
}

// Each scan tilted by as much against the one before: metres at the end, half a millimetre within a link.
std::vector<Twist> bend(const std::vector<TwistFrame>& frames, double tilt_rad) {
  std::vector<Twist> steps_m(frames.size(), Twist::Zero());
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double before_rad = steps_m[i - 1][1] / kRadius_m;
    steps_m[i][1] = kRadius_m * (before_rad - tilt_rad);
    steps_m[i][5] = steps_m[i - 1][5] - kSpacing_m * (before_rad - tilt_rad / 2);
  }
  return steps_m;
}

TEST(JointNormalEquations, OneStepTakesTheBendOutOfALongChain) {
  Rng rng = make_stream(1, "joint_normal_equations_test");
  const auto frames = frames_along_a_street(250);
  const std::vector<Twist> truth_m = bend(frames, 2e-5);
  ASSERT_GT(truth_m.back()[5], 5);
  const std::vector<Eigen::Vector3d> axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const std::vector<Twist> steps_m = solve(frames, chain(frames, truth_m, axes, rng));
  ASSERT_EQ(steps_m.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_LT((steps_m[i] - truth_m[i]).norm(), 0.01) << i;
}

TEST(JointNormalEquations, WhatMatchesDoNotDetermineStays) {
  Rng rng = make_stream(2, "joint_normal_equations_test");
  const auto frames = frames_along_a_street(5);
  std::vector<Twist> truth_m(5, Twist::Zero());
  for (std::size_t i = 1; i < 5; ++i) truth_m[i][5] = 0.1;  // up, where all matches are on the ground
  const std::vector<Twist> steps_m = solve(frames, chain(frames, truth_m, {Eigen::Vector3d::UnitZ()}, rng));
  ASSERT_EQ(steps_m.size(), frames.size());
  for (std::size_t i = 0; i < 5; ++i) EXPECT_LT((steps_m[i] - truth_m[i]).norm(), 1e-4) << i;
}

TEST(JointNormalEquations, ScansWithoutLinksStay) {
  Rng rng = make_stream(3, "joint_normal_equations_test");
  auto frames = frames_along_a_street(3);
  std::vector<Twist> truth_m(3, Twist::Zero());
  truth_m[1][3] = truth_m[2][3] = 0.2;
  const std::vector<Eigen::Vector3d> axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const std::vector<JointLink> links = chain(frames, truth_m, axes, rng);
  frames.push_back({Eigen::Vector3d(100, 0, 0), kRadius_m});
  const std::vector<Twist> steps_m = solve(frames, links);
  ASSERT_EQ(steps_m.size(), 4U);
  EXPECT_LT((steps_m[2] - truth_m[2]).norm(), 1e-4);
  EXPECT_TRUE(steps_m[0].isZero(0));
  EXPECT_TRUE(steps_m[3].isZero(0));
}

}  // namespace
}  // namespace tcm_icp
