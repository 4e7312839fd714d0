#include "registration/score_sandwich.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "registration/link_scores.hpp"
#include "registration/match_blocks.hpp"

namespace tcm_icp {

ScoreSandwich::ScoreSandwich(const std::vector<TwistFrame>& frames, std::size_t fixed,
                             const std::vector<JointLink>& links, double noise_m)
    : frames_(frames), fixed_(fixed), links_(links), noise_m_(noise_m) {
  const auto size = static_cast<Eigen::Index>(6 * frames.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const auto& link : links) {
    for (const auto& match : link.matches) add(link, match, information);
  }
  // A billionth of the mean curvature: what the matches do not determine comes out as very uncertain, not as an error.
  const double trace = information.trace();
  damping_ = 1e-9 * (trace > 0 ? trace / static_cast<double>(size) : 1);
  information.diagonal().array() += damping_;
  inverse_ = information.llt().solve(Eigen::MatrixXd::Identity(size, size));
}

std::vector<BlockScore> ScoreSandwich::scores(double block_m) const {
  std::vector<BlockScore> scores;
  for (const auto& block : blocks_of(links_, block_m)) {
    BlockScore score;
    for (const auto& [l, m] : block) {
      const JointLink& link = links_[l];
      const Correspondence& match = link.matches[m];
      const double r = std::clamp(residual_m(match), -kHuberFactor * noise_m_, kHuberFactor * noise_m_);
      add(link.source, r * residual_gradient(match, frames_[link.source]), score);
      add(link.target, -r * residual_gradient(match, frames_[link.target]), score);
    }
    scores.push_back(std::move(score));
  }
  return scores;
}

double ScoreSandwich::variance_ratio(const std::vector<BlockScore>& scores) const {
  double sum = 0;
  for (const auto& score : scores) {
    for (const auto& [a, score_a] : score) {
      for (const auto& [b, score_b] : score) sum += score_a.dot(scan_block(inverse_, a, b) * score_b);
    }
  }
  return sum;
}

Eigen::MatrixXd ScoreSandwich::covariance(const std::vector<BlockScore>& scores) const {
  Eigen::MatrixXd scatter =
      noise_m_ * noise_m_ * damping_ * Eigen::MatrixXd::Identity(inverse_.rows(), inverse_.cols());
  for (const auto& score : scores) {
    for (const auto& [a, score_a] : score) {
      for (const auto& [b, score_b] : score) {
        scatter.block<6, 6>(static_cast<Eigen::Index>(6 * a), static_cast<Eigen::Index>(6 * b)) +=
            score_a * score_b.transpose();
      }
    }
  }
  return inverse_ * scatter * inverse_;
}

void ScoreSandwich::add(std::size_t scan, const Twist& part, BlockScore& score) const {
  if (scan != fixed_) score.try_emplace(scan, Twist::Zero()).first->second += part;
}

void ScoreSandwich::add(const JointLink& link, const Correspondence& match, Eigen::MatrixXd& information) const {
  if (std::abs(residual_m(match)) > kHuberFactor * noise_m_) return;
  const Twist s = residual_gradient(match, frames_[link.source]), t = -residual_gradient(match, frames_[link.target]);
  const auto at_s = static_cast<Eigen::Index>(6 * link.source), at_t = static_cast<Eigen::Index>(6 * link.target);
  if (link.source != fixed_) information.block<6, 6>(at_s, at_s) += s * s.transpose();
  if (link.target != fixed_) information.block<6, 6>(at_t, at_t) += t * t.transpose();
  if (link.source == fixed_ || link.target == fixed_) return;
  information.block<6, 6>(at_s, at_t) += s * t.transpose();
  information.block<6, 6>(at_t, at_s) += t * s.transpose();
}

}  // namespace tcm_icp
