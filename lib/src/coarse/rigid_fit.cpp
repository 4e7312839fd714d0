#include "rigid_fit.hpp"

#include <Eigen/SVD>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {

Eigen::Isometry3f fit_rigid(const MatchedPoints& matches, std::span<const std::uint32_t> listed,
                            std::span<const float> weights) {
  Eigen::Vector3f target = Eigen::Vector3f::Zero(), source = Eigen::Vector3f::Zero();
  float total = 0;
  const auto weight = [&](std::size_t k) { return weights.empty() ? 1.0F : weights[k]; };
  for (std::size_t k = 0; k < listed.size(); ++k) {
    target += weight(k) * matches.target.col(listed[k]);
    source += weight(k) * matches.source.col(listed[k]);
    total += weight(k);
  }
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  if (!(total > 0)) return T;
  target /= total;
  source /= total;
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (std::size_t k = 0; k < listed.size(); ++k) {
    covariance +=
        weight(k) * (matches.target.col(listed[k]) - target) * (matches.source.col(listed[k]) - source).transpose();
  }
  T.linear() = project_onto_so3(covariance.cast<double>()).cast<float>();
  T.translation() = target - T.linear() * source;
  return T;
}

}  // namespace tcm_icp
