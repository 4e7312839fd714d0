#include "tcm_icp/tcm/robust_tcm.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tcm/require_two.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/normals.hpp"

namespace tcm_icp {
namespace {

double validated_quantile(const RobustTcmOptions& options) {
  options.validate();
  return options.quantile;
}

// Squared distance from `own` to `other` that the nearest `share` of own's sample stays within.
double squared_distance_quantile(const RobustTcmCloud& own, const RobustTcmCloud& other,
                                 const Eigen::Isometry3d& T_other_own, double share) {
  std::vector<double> squared;
  squared.reserve(own.sample().size());
  for (const auto& p : own.sample()) squared.push_back(other.index().nearest(T_other_own * p).squared_distance_m2);
  const double rank = std::ceil(share * static_cast<double>(squared.size())) - 1;
  const auto nth = squared.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 0.0));
  std::nth_element(squared.begin(), nth, squared.end());
  return *nth;
}

double robust_f(const RobustTcmCloud& a, const RobustTcmCloud& b, const Eigen::Isometry3d& T_a_b) {
  const double ratio = static_cast<double>(a.size()) / static_cast<double>(b.size());
  const double q = a.quantile();
  return squared_distance_quantile(a, b, T_a_b.inverse(), q * std::min(1.0, 1.0 / ratio)) +
         squared_distance_quantile(b, a, T_a_b, q * std::min(1.0, ratio));
}

double robust_g(const RobustTcmCloud& a, const RobustTcmCloud& b) {
  const double larger = std::max(a.median_spacing_m(), b.median_spacing_m());
  if (larger == 0) return 1;  // both consist of duplicates: equally dense
  return 1 + std::abs(a.median_spacing_m() - b.median_spacing_m()) / larger;
}

}  // namespace

void RobustTcmOptions::validate() const {
  if (!(quantile > 0 && quantile <= 1)) {
    throw InvalidOptions("quantile is " + std::to_string(quantile) + "; it must be above 0 and at most 1");
  }
  if (max_samples < 1) throw InvalidOptions("max_samples is 0; it must be at least 1");
}

RobustTcmCloud::RobustTcmCloud(const Points& points, const RobustTcmOptions& options)
    : index_(require_two(points, "the robust compatibility measure")),
      sample_(even_sample(points, options.max_samples)),
      median_spacing_m_(median_spacing(points, index_)),
      quantile_(validated_quantile(options)) {}

TcmTerms robust_tcm_terms(const RobustTcmCloud& a, const RobustTcmCloud& b, const Eigen::Isometry3d& T_a_b) {
  return {robust_f(a, b, T_a_b), robust_g(a, b), 1.0};
}

}  // namespace tcm_icp
