#include "tcm_icp/registration/joint_links.hpp"

#include <cmath>

#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {

std::vector<double> absolute_residuals_m(const std::vector<JointLink>& links) {
  std::vector<double> residuals;
  for (const auto& link : links) {
    for (const auto& match : link.matches) residuals.push_back(std::abs(residual_m(match)));
  }
  return residuals;
}

double robust_noise_m(const std::vector<JointLink>& links) {
  std::vector<double> residuals = absolute_residuals_m(links);
  return residuals.empty() ? 0 : kMadToSigma * median(residuals);
}

}  // namespace tcm_icp
