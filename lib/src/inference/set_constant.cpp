#include "inference/set_constant.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

constexpr int kMaxSteps = 100;
constexpr double kMaxStep = 1, kLeastStep = 1e-9;
constexpr double kLeastSlope = 0.1;  // what looks better is not worse

}  // namespace

double set_constant(const std::vector<JudgedHypothesis>& judged, double spread) {
  return set_shift(judged, spread, 0).constant;
}

SetShift set_shift(const std::vector<JudgedHypothesis>& judged, double spread, double slope_spread) {
  SetShift out;
  if (spread <= 0) return out;
  const bool has_slope = slope_spread > 0;
  const double weight = 1 / (spread * spread), slope_weight = has_slope ? 1 / (slope_spread * slope_spread) : 1;
  for (int k = 0; k < kMaxSteps; ++k) {  // Newton; the posterior is concave
    Eigen::Vector2d gradient{-weight * out.constant, -slope_weight * (out.slope - 1)};
    Eigen::Matrix2d curvature = Eigen::Vector2d(weight, slope_weight).asDiagonal();
    for (const JudgedHypothesis& h : judged) {
      const Eigen::Vector2d row{1, has_slope ? h.log_odds : 0};
      const double p = 1 / (1 + std::exp(-out.of(h.log_odds)));
      gradient += h.sure * ((h.right ? 1 : 0) - p) * row;
      curvature += h.sure * p * (1 - p) * row * row.transpose();
    }
    const Eigen::Vector2d step = curvature.ldlt().solve(gradient).cwiseMax(-kMaxStep).cwiseMin(kMaxStep);
    out.constant += step[0];
    out.slope = std::max(kLeastSlope, out.slope + step[1]);
    if (step.cwiseAbs().maxCoeff() < kLeastStep) break;
  }
  return out;
}

}  // namespace tcm_icp
