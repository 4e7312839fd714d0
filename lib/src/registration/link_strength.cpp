#include "tcm_icp/registration/link_strength.hpp"

#include <cmath>

#include "core/decompositions.hpp"
#include "registration/link_scores.hpp"

namespace tcm_icp {

LinkStrength link_strength(const std::vector<JointLink>& links, double noise_m, double block_m) {
  constexpr double kNothing = 1e-12;  // of the strongest direction: rounding
  const LinkScores scores = link_scores(links, kHuberFactor * noise_m, block_m);
  LinkStrength strength;
  strength.num_matches = scores.num_matches;
  strength.centre = scores.frame.centre;
  strength.radius_m = scores.frame.radius_m;
  const SymmetricEigen<6> eigen = symmetric_eigen6(scores.information);
  const Matrix6 meat = scores.covariance_of_total();
  for (int k = 0; k < 6; ++k) {
    LinkAxis& axis = strength.axes[static_cast<std::size_t>(k)];
    const Twist direction = eigen.vectors.col(k);
    const double curvature = eigen.values[k];
    axis.rotation_per_m = direction.head<3>() / scores.frame.radius_m;
    axis.translation = direction.tail<3>();
    if (!(curvature > kNothing * eigen.values[5])) continue;
    axis.slide_m = noise_m / std::sqrt(curvature / static_cast<double>(scores.num_matches));
    if (scores.blocks.size() > 6) axis.sigma_m = std::sqrt(direction.dot(meat * direction)) / curvature;
  }
  return strength;
}

}  // namespace tcm_icp
