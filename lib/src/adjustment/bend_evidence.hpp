#pragma once
// How much the scans of a set may be bent: the most likely deviation of what bends them, by the matches of each scan.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "registration/joint_normal_equations.hpp"
#include "registration/link_scores.hpp"
#include "tcm_icp/core/morton_code.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

/// Of numbers drawn from one normal distribution about 0.
struct BendPrior {
  double deviation_m = 0;
  double weight = 1;  ///< of their squares, beside squared residuals
  bool any() const { return deviation_m > 0; }
};

/// What is known of a set's matches beside them.
struct MatchNoise {
  double noise_m = 0;  ///< [m] of residuals; Huber's threshold is its kHuberFactor
  double block_m = 0;  ///< [m] smallest edge of a place: the resolution of the points
};

/// The cube of the edge that a point lies in, along Morton's curve about `centre`: cubes of twice the edge are those
/// without the last three bits.
std::uint64_t cube_of(const Eigen::Vector3d& point, const Eigen::Vector3d& centre, double edge_m);

/// A score of one match, and where it lies.
template <int kUnknowns>
struct PlacedScore {
  std::uint64_t cube = 0;
  Eigen::Matrix<double, kUnknowns, 1> score;
};

std::size_t least_cubes();  // the scatter of fewer says little

/// Squares of the sums over the scores of each cube: of the edge, among the smallest and its doubles, that gives most.
template <int kUnknowns>
double squares_of_places(std::vector<PlacedScore<kUnknowns>>& scores) {
  std::sort(scores.begin(), scores.end(), [](const auto& a, const auto& b) { return a.cube < b.cube; });
  double most = 0;
  for (int doublings = 0; doublings < kMortonBits; ++doublings) {
    double squares = 0;
    std::size_t places = 0;
    for (std::size_t begin = 0; begin < scores.size(); ++places) {
      const std::uint64_t cube = scores[begin].cube >> 3 * doublings;
      Eigen::Matrix<double, kUnknowns, 1> sum = Eigen::Matrix<double, kUnknowns, 1>::Zero();
      for (; begin < scores.size() && scores[begin].cube >> 3 * doublings == cube; ++begin) sum += scores[begin].score;
      squares += sum.squaredNorm();
    }
    if (places < least_cubes()) break;
    most = std::max(most, squares);
  }
  return most;
}

/// What the matches of one scan say of the numbers that bend it, its own pose being free and its neighbours held.
template <int kUnknowns>
struct BendEvidence {
  using Part = Eigen::Matrix<double, kUnknowns, 1>;
  Part curvatures = Part::Zero();  ///< along the eigenvectors
  Part scores = Part::Zero();      ///< [m] along them, where all numbers are 0
  double squares_m2 = 0;           ///< of the scores of all matches
  double alike_squares_m2 = 0;     ///< of those of all pairs, or of all places, what is more
};

/// @param links        those of the scan
/// @param gradient_of  (link, match, whether the scan is the link's target): of the residual, by the scan's numbers
template <int kUnknowns, typename GradientOf>
BendEvidence<kUnknowns> bend_evidence(std::size_t scan, const std::vector<const JointLink*>& links,
                                      const TwistFrame& frame, const MatchNoise& noise, const GradientOf& gradient_of) {
  constexpr int kPose = 6, kAll = kPose + kUnknowns;
  using Part = Eigen::Matrix<double, kUnknowns, 1>;
  using All = Eigen::Matrix<double, kAll, 1>;
  const double threshold_m = kHuberFactor * noise.noise_m;
  const auto each_match = [&](auto&& take) {
    for (const JointLink* link : links) {
      const bool is_target = link->target == scan;
      for (const auto& match : link->matches) {
        All gradient;
        gradient << (is_target ? -1 : 1) * residual_gradient(match, frame), gradient_of(*link, match, is_target);
        take(*link, is_target ? match.target : match.source, gradient, residual_m(match));
      }
    }
  };
  // The scan's equations, and its pose eliminated from them.
  Eigen::Matrix<double, kAll, kAll> curvature = Eigen::Matrix<double, kAll, kAll>::Zero();
  each_match([&](const JointLink&, const Eigen::Vector3d&, const All& g, double r) {
    curvature.noalias() += huber_weight(r, threshold_m) * g * g.transpose();
  });
  Matrix6 of_pose = curvature.template topLeftCorner<kPose, kPose>();
  of_pose.diagonal().array() += 1e-6 * of_pose.trace() / kPose + 1e-300;
  const Eigen::Matrix<double, kPose, kUnknowns> by_pose =
      of_pose.ldlt().solve(curvature.template topRightCorner<kPose, kUnknowns>());
  const Eigen::Matrix<double, kUnknowns, kUnknowns> own =
      curvature.template bottomRightCorner<kUnknowns, kUnknowns>() -
      curvature.template bottomLeftCorner<kUnknowns, kPose>() * by_pose;

  BendEvidence<kUnknowns> evidence;
  std::map<std::size_t, Part> of_pairs;
  std::vector<PlacedScore<kUnknowns>> of_places;
  each_match([&](const JointLink& link, const Eigen::Vector3d& point, const All& g, double r) {
    const Part score = -std::clamp(r, -threshold_m, threshold_m) *
                       (g.template tail<kUnknowns>() - by_pose.transpose() * g.template head<kPose>());
    evidence.squares_m2 += score.squaredNorm();
    of_pairs.try_emplace(link.target + link.source - scan, Part::Zero()).first->second += score;
    of_places.push_back({cube_of(point, frame.centre, noise.block_m), score});
  });
  Part total = Part::Zero();
  double pair_squares_m2 = 0;
  for (const auto& [neighbor, score] : of_pairs) {
    pair_squares_m2 += score.squaredNorm();
    total += score;
  }
  evidence.alike_squares_m2 = std::max(pair_squares_m2, squares_of_places(of_places));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kUnknowns, kUnknowns>> parts(own);
  evidence.curvatures = parts.eigenvalues().cwiseMax(0);
  evidence.scores = parts.eigenvectors().transpose() * total;
  return evidence;
}

/// The most likely prior (MacKay, Bayesian interpolation, 1992); none where there is nothing to be told. Matches of one
/// pair of scans may all err alike, and so may those of one place: only what several pairs and many places say bears a
/// bend out.
/// @param asked  scans that may be bent
template <int kUnknowns, typename GradientOf>
BendPrior likeliest_prior(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames,
                          const std::vector<bool>& asked, const MatchNoise& noise, int num_threads,
                          const GradientOf& gradient_of) {
  constexpr int kMaxRounds = 200;
  constexpr double kSettled = 1e-3;  // relative change of the variance: a tenth of a per cent of what it weighs
  std::vector<std::vector<const JointLink*>> links_of(asked.size());
  for (const auto& link : links) {
    if (asked[link.target]) links_of[link.target].push_back(&link);
    if (asked[link.source]) links_of[link.source].push_back(&link);
  }
  std::vector<BendEvidence<kUnknowns>> evidence(asked.size());
  parallel_for(num_threads, asked.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!links_of[i].empty()) evidence[i] = bend_evidence<kUnknowns>(i, links_of[i], frames[i], noise, gradient_of);
    }
  });
  double squares_m2 = 0, alike_squares_m2 = 0, squared_scores_m2 = 0, squared_curvatures = 0;
  for (const auto& e : evidence) {
    squares_m2 += e.squares_m2;
    alike_squares_m2 += e.alike_squares_m2;
    squared_scores_m2 += e.scores.squaredNorm();
    squared_curvatures += e.curvatures.squaredNorm();
  }
  if (!(squares_m2 > 0 && squared_curvatures > 0)) return {};
  // A sum over all matches varies by this factor more than one of independent matches would.
  const double variance_m2 = noise.noise_m * noise.noise_m * std::max(1.0, alike_squares_m2 / squares_m2);
  double deviation_m2 = squared_scores_m2 / squared_curvatures;  // as if there was no noise: from above
  for (int round = 0; round < kMaxRounds; ++round) {
    const double weight = variance_m2 / deviation_m2, before_m2 = deviation_m2;
    double bends_m2 = 0, determined = 0;
    for (const auto& e : evidence) {
      const Eigen::Matrix<double, kUnknowns, 1> sums = e.curvatures.array() + weight;
      bends_m2 += e.scores.cwiseQuotient(sums).squaredNorm();
      determined += e.curvatures.cwiseQuotient(sums).sum();
    }
    deviation_m2 = bends_m2 / determined;
    // Where the matches determine less than one number of all, there is nothing to be told.
    if (determined < 1) return {};
    if (std::abs(deviation_m2 - before_m2) < kSettled * before_m2) break;
  }
  return {std::sqrt(deviation_m2), variance_m2 / deviation_m2};
}

}  // namespace tcm_icp
