#include "registration/link_scores.hpp"

#include <algorithm>
#include <cmath>

#include "registration/match_blocks.hpp"

namespace tcm_icp {

Twist LinkScores::total() const {
  Twist sum = Twist::Zero();
  for (const auto& block : blocks) sum += block;
  return sum;
}

Matrix6 LinkScores::covariance_of_total() const {
  if (blocks.size() < 2) return Matrix6::Zero();
  const auto count = static_cast<double>(blocks.size());
  const Twist mean = total() / count;
  Matrix6 sum = Matrix6::Zero();
  for (const auto& block : blocks) sum += (block - mean) * (block - mean).transpose();
  return count / (count - 1) * sum;
}

LinkScores link_scores(const std::vector<JointLink>& links, double threshold_m, double block_m) {
  LinkScores scores;
  Points points;
  for (const auto& link : links) {
    for (const auto& match : link.matches) points.push_back(match.source);
  }
  if (points.empty()) return scores;
  scores.frame = twist_frame(points, Eigen::Isometry3d::Identity());
  for (const auto& block : blocks_of(links, block_m)) {
    Twist score = Twist::Zero();
    for (const auto& [l, m] : block) {
      const Correspondence& match = links[l].matches[m];
      const double sign = links[l].source == links.front().source ? 1 : -1;
      const Twist gradient = sign * residual_gradient(match, scores.frame);
      const double r = residual_m(match);
      score += std::clamp(r, -threshold_m, threshold_m) * gradient;
      if (std::abs(r) > threshold_m) continue;
      scores.information += gradient * gradient.transpose();
      ++scores.num_matches;
    }
    scores.blocks.push_back(score);
  }
  return scores;
}

}  // namespace tcm_icp
