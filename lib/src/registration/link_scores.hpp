#pragma once
// What Huber's estimate of one pair of scans is made of, by blocks.

#include <Eigen/Core>
#include <vector>

#include "registration/joint_normal_equations.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

constexpr double kHuberFactor = 1.345;  // 95 % efficient for normal errors (Huber, 1981)

/// Of the motion of the first link's source against its target, about `frame`.
struct LinkScores {
  TwistFrame frame;
  std::size_t num_matches = 0;            ///< within the threshold
  Matrix6 information = Matrix6::Zero();  ///< sum of the gradients' outer products, within the threshold
  std::vector<Twist> blocks;              ///< score of each block: sum of clamped residual times gradient

  Twist total() const;
  /// Covariance of total(), from how much the blocks differ; zero below two blocks.
  Matrix6 covariance_of_total() const;
};

LinkScores link_scores(const std::vector<JointLink>& links, double threshold_m, double block_m);

}  // namespace tcm_icp
