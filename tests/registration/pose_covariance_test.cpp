#include "tcm_icp/registration/pose_covariance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "registration/joint_normal_equations.hpp"
#include "registration/match_blocks.hpp"
#include "support/joint_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using testing::JointScene;
using testing::JointSceneOptions;

constexpr PoseCovarianceOptions kOptions{0.25, 30};

// Huber's estimate by reweighting; matches move with the scans.
std::vector<Twist> huber_steps(const JointScene& s, double threshold_m) {
  std::vector<Twist> total(s.frames.size(), Twist::Zero());
  std::vector<JointLink> links = s.links;
  for (int round = 0; round < 8; ++round) {
    JointNormalEquations equations(s.frames, 0);
    for (const auto& link : links) {
      equations.add(link, huber_sums(link, s.frames[link.target], s.frames[link.source], threshold_m));
    }
    const Eigen::VectorXd x = equations.solve();
    for (auto& link : links) {
      for (auto& m : link.matches) {
        const Twist step_s = x.segment<6>(static_cast<Eigen::Index>(6 * link.source));
        const Twist step_t = x.segment<6>(static_cast<Eigen::Index>(6 * link.target));
        const double change = residual_gradient(m, s.frames[link.source]).dot(step_s) -
                              residual_gradient(m, s.frames[link.target]).dot(step_t);
        m.target -= change * m.normal;
      }
    }
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += x.segment<6>(static_cast<Eigen::Index>(6 * i));
  }
  return total;
}

// Residuals at the estimate, as after an adjustment.
JointScene adjusted(const JointScene& s, const std::vector<Twist>& steps_m) {
  JointScene out = s;
  for (auto& link : out.links) {
    for (auto& m : link.matches) {
      m.target -= (residual_gradient(m, s.frames[link.source]).dot(steps_m[link.source]) -
                   residual_gradient(m, s.frames[link.target]).dot(steps_m[link.target])) *
                  m.normal;
    }
  }
  return out;
}

struct Calibration {
  double independent = 0;  // rms of error by sigma, over scans, axes and draws
  double factor = 0;       // mean correlation factor
};

Calibration calibration(const JointSceneOptions& options, int draws) {
  Calibration out;
  int count = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Rng rng = make_stream(static_cast<std::uint64_t>(draw), "pose_covariance_test");
    const JointScene s = testing::joint_scene(options, rng);
    const auto steps = huber_steps(s, 1.345 * (options.noise_m + options.shared_noise_m));
    const JointUncertainty u = estimate_uncertainty(s.frames, 0, adjusted(s, steps).links, kOptions);
    for (std::size_t i = 1; i < s.frames.size(); ++i) {
      EXPECT_TRUE(u.poses[i].determined);
      const Twist error = steps[i] - s.truth_m[i];
      for (int k = 0; k < 3; ++k) {
        out.independent += std::pow(error[k] / s.frames[i].radius_m / u.poses[i].sigma_rotation_rad()[k], 2);
        out.independent += std::pow(error[k + 3] / u.poses[i].sigma_position_m()[k], 2);
        count += 2;
      }
    }
    out.factor += u.correlation_factor / draws;
  }
  out.independent = std::sqrt(out.independent / count);
  return out;
}

TEST(PoseCovariance, PredictsTheErrorsOfIndependentNoise) {
  const Calibration c = calibration({.noise_m = 0.02}, 30);
  // 540 errors of which those of a draw are correlated; the largest of several edges is on the safe side.
  EXPECT_GT(c.independent, 0.5);
  EXPECT_LT(c.independent, 1.2);
  EXPECT_LT(c.factor, 1.6);
}

TEST(PoseCovariance, PredictsTheErrorsOfNoiseThatNeighboursShare) {
  const Calibration c =
      calibration({.matches_per_link = 400, .noise_m = 0.005, .shared_noise_m = 0.02, .shared_edge_m = 2}, 30);
  EXPECT_GT(c.factor, 1.5) << "points alone would promise too much";
  EXPECT_GT(c.independent, 0.4);
  EXPECT_LT(c.independent, 1.6);
}

// Blocks drawn with replacement, as many as there are; the spread of the estimates is what was promised.
TEST(PoseCovariance, IsTheSpreadOfABlockBootstrap) {
  Rng rng = make_stream(1, "pose_covariance_test bootstrap");
  const JointScene s = testing::joint_scene({.noise_m = 0.01, .shared_noise_m = 0.01, .shared_edge_m = 2}, rng);
  const JointScene at_rest = adjusted(s, huber_steps(s, 0.02));
  const JointUncertainty u = estimate_uncertainty(s.frames, 0, at_rest.links, kOptions);
  const auto blocks = blocks_of(at_rest.links, u.block_m);
  constexpr int kDraws = 60;
  std::vector<Twist> squares(s.frames.size(), Twist::Zero());
  for (int draw = 0; draw < kDraws; ++draw) {
    JointScene again = at_rest;
    for (auto& link : again.links) link.matches.clear();
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      for (const auto& [l, m] : blocks[uniform_index(rng, blocks.size())]) {
        again.links[l].matches.push_back(at_rest.links[l].matches[m]);
      }
    }
    const auto steps = huber_steps(again, 1.345 * u.noise_m);
    for (std::size_t i = 0; i < steps.size(); ++i) squares[i] += steps[i].cwiseAbs2() / kDraws;
  }
  for (std::size_t i = 1; i < s.frames.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double rotation = std::sqrt(squares[i][k]) / s.frames[i].radius_m, shift = std::sqrt(squares[i][k + 3]);
      EXPECT_LT(std::abs(std::log2(rotation / u.poses[i].sigma_rotation_rad()[k])), 1) << "scan " << i << " axis " << k;
      EXPECT_LT(std::abs(std::log2(shift / u.poses[i].sigma_position_m()[k])), 1) << "scan " << i << " axis " << k;
    }
  }
}

TEST(PoseCovariance, LinksThatContradictOneAnotherWidenIt) {
  Rng rng = make_stream(2, "pose_covariance_test");
  JointScene s = testing::joint_scene({.noise_m = 0.01}, rng);
  const auto before = estimate_uncertainty(s.frames, 0, adjusted(s, huber_steps(s, 0.015)).links, kOptions);
  EXPECT_LT(before.disagreement_factor, 1.6);
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Vector3d> shifts;
  for (auto& link : s.links) {
    Eigen::Vector3d& shift = shifts
                                 .try_emplace(std::minmax(link.target, link.source), 0.03 * standard_normal(rng),
                                              0.03 * standard_normal(rng), 0.03)
                                 .first->second;
    for (auto& m : link.matches) m.target += (link.source < link.target ? 1 : -1) * m.normal.dot(shift) * m.normal;
  }
  const auto after = estimate_uncertainty(s.frames, 0, adjusted(s, huber_steps(s, 0.03)).links, kOptions);
  EXPECT_GT(after.disagreement_factor, 2 * before.disagreement_factor);
}

// Each link lets what follows turn and move a little; at the end of a thousand that is what they add up to.
TEST(PoseCovariance, GrowsAlongAChainAsItsLinksAddUp) {
  constexpr double kSpacing_m = 10, kRadius_m = 15, kNoise_m = 0.003;
  constexpr std::size_t kScans = 1000;
  Rng rng = make_stream(4, "pose_covariance_test");
  std::vector<TwistFrame> frames;
  for (std::size_t i = 0; i < kScans; ++i) frames.push_back({{kSpacing_m * static_cast<double>(i), 0, 0}, kRadius_m});
  std::vector<JointLink> links;
  double variance_m2 = 0;  // of the height of the last scan's middle
  for (std::size_t i = 1; i < kScans; ++i) {
    JointLink link{i - 1, i, {}};
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    for (int k = 0; k < 60; ++k) {
      Correspondence m;
      m.normal = Eigen::Vector3d::Unit(k % 3);
      m.source = frames[i].centre;
      for (int axis = 0; axis < 3; ++axis) m.source[axis] += 40 * uniform01(rng) - 20;
      m.target = m.source + kNoise_m * standard_normal(rng) * m.normal;
      const Twist gradient = residual_gradient(m, frames[i]);
      information += gradient * gradient.transpose();
      link.matches.push_back(m);
    }
    links.push_back(std::move(link));
    Twist height = Twist::Zero();
    height[5] = 1;
    height[1] = -kSpacing_m * static_cast<double>(kScans - 1 - i) / kRadius_m;
    variance_m2 += kNoise_m * kNoise_m * height.dot(information.inverse() * height);
  }
  const JointUncertainty u = estimate_uncertainty(frames, 0, links, kOptions);
  ASSERT_GT(std::sqrt(variance_m2), 5);
  // The block's size that gives most is on the safe side.
  EXPECT_GT(u.poses.back().sigma_position_m().z(), 0.9 * std::sqrt(variance_m2));
  EXPECT_LT(u.poses.back().sigma_position_m().z(), 1.6 * std::sqrt(variance_m2));
}

TEST(PoseCovariance, SaysWhatItDoesNotKnow) {
  Rng rng = make_stream(3, "pose_covariance_test");
  const JointScene ground = testing::joint_scene({.noise_m = 0.01, .step_m = 0, .only_ground = true}, rng);
  const auto u = estimate_uncertainty(ground.frames, 0, ground.links, kOptions);
  EXPECT_TRUE(u.poses[0].determined);
  EXPECT_TRUE(u.poses[0].covariance.isZero(0));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_FALSE(u.poses[i].determined) << "ground holds nothing along x";
  const auto none = estimate_uncertainty(ground.frames, 1, {}, kOptions);
  EXPECT_FALSE(none.poses[0].determined);
  EXPECT_TRUE(std::isnan(none.poses[0].sigma_position_m()[0]));
  EXPECT_THROW(estimate_uncertainty(ground.frames, 4, {}, kOptions), InvalidInput);
  EXPECT_THROW(estimate_uncertainty(ground.frames, 0, {{0, 7, {}}}, kOptions), InvalidInput);
  EXPECT_THROW(estimate_uncertainty(ground.frames, 0, {}, {}), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
