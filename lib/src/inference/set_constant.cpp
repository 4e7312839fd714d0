#include "inference/set_constant.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

constexpr int kMaxSteps = 100;
constexpr double kMaxStep = 1, kLeastStep = 1e-9;

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

}  // namespace tcm_icp
