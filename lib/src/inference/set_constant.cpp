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
  if (spread <= 0) return 0;
  double constant = 0;
  for (int k = 0; k < kMaxSteps; ++k) {  // Newton; the posterior is concave
    double gradient = -constant / (spread * spread), curvature = 1 / (spread * spread);
    for (const JudgedHypothesis& h : judged) {
      const double p = 1 / (1 + std::exp(-h.log_odds - constant));
      gradient += h.sure * ((h.right ? 1 : 0) - p);
      curvature += h.sure * p * (1 - p);
    }
    const double step = std::clamp(gradient / curvature, -kMaxStep, kMaxStep);
    constant += step;
    if (std::abs(step) < kLeastStep) break;
  }
  return constant;
}

SetShift set_shift(const std::vector<JudgedHypothesis>& judged, double spread) {
  SetShift out;
  if (spread <= 0) return out;
  const double weight = 1 / (spread * spread);
  for (int k = 0; k < kMaxSteps; ++k) {
    Eigen::Vector2d gradient{-weight * out.constant, -weight * (out.slope - 1)};
    Eigen::Matrix2d curvature = weight * Eigen::Matrix2d::Identity();
    for (const JudgedHypothesis& h : judged) {
      const Eigen::Vector2d row{1, h.log_odds};
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
