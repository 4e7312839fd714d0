#include "tcm_icp/decision/scan_decision.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/acceptance.hpp"
#include "core/figure_text.hpp"
#include "links/feature_scales.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// A scan is wrong where its place is taken for another, or where it has none: two ways, whose odds add up.
struct ScanModel {
  double place_constant, quality_constant;
  DecisionFeatures place, quality;  // weights
  DecisionFeatures usual;           // of right scans

  double log_odds(const DecisionFeatures& f) const {
    const double place_odds = dot(place, f) + place_constant, quality_odds = dot(quality, f) + quality_constant;
    return -std::log(std::exp(-place_odds) + std::exp(-quality_odds));
  }
  static double dot(const DecisionFeatures& weights, const DecisionFeatures& f) {
    return std::inner_product(f.begin(), f.end(), weights.begin(), 0.0);
  }
};

#include "scan_model.inc"

// From the model's log-odds to what the program finds to hold (Platt, 1999): evidence was added since the model was
// fitted.
struct ScanCalibration {
  double shift, slope;
  double probability(double log_odds) const { return 1 / (1 + std::exp(-(shift + slope * log_odds))); }
};

#include "scan_calibration.inc"

constexpr double kMostLead = 40, kLeastLead = -10, kMostLeadAPair = 1000;
constexpr double kLeastSigma = 0.01, kMostSigma = 2;  // in coarse voxels
constexpr std::size_t kNumReasons = static_cast<std::size_t>(Reason::kTooFewPoints) + 1;

double agreeing(const AlignmentEvidence& e) { return e.consensus() * static_cast<double>(e.num_points); }

// What features belong to what can be said of a scan.
Reason reason_of(std::size_t feature) {
  if (feature <= 1 || feature >= 14) return Reason::kAmbiguous;
  if (feature == 13) return Reason::kInexact;
  if (feature <= 5 || feature == 12) return Reason::kMisfit;
  return feature <= 9 ? Reason::kSlides : Reason::kSeenThrough;
}

std::string describe(Reason reason, const ScanMeasurements& m, const ComponentReference& component) {
  const AlignmentEvidence& e = m.evidence;
  switch (reason) {
    case Reason::kAccepted:
      return percent(e.consensus()) + " of its points agree with the other scans";
    case Reason::kAmbiguous:
      if (!m.other_distance || m.lead >= m.support) return "too little joins it to the other scans";
      return (m.num_moved > 1 ? "together with " + std::to_string(m.num_moved - 1) + " more " : std::string()) +
             "it fits about as well " + figure(*m.other_distance) + " away";
    case Reason::kMisfit:
      return "only " + percent(e.inlier_share) + " of what overlaps agrees within the noise, where " +
             percent(component.inlier_share) + " does in the middle of its set";
    case Reason::kSlides:
      return "moved along its weakest direction, it still agrees at " + percent(e.left_after_slide[0]) +
             " of as many points";
    case Reason::kInexact:
      return m.sigma_in_voxels ? "its standard deviation is " + figure(*m.sigma_in_voxels) + " coarse voxels"
                               : std::string("what it shares with the others does not determine its pose");
    case Reason::kSeenThrough:
      return "seen through walls: " + percent(m.free_space.violation_share()) +
             " of what it and its neighbours share lies before surfaces the other saw, " +
             percent(m.free_space.opposed_share()) + " was seen from opposite sides";
    default:
      return std::string(to_string(reason));
  }
}

}  // namespace

double ScanMeasurements::lead_a_pair() const {
  return std::clamp(lead, 0.0, kMostLeadAPair) / static_cast<double>(std::max<std::size_t>(num_across, 1));
}

ComponentReference ComponentReference::of(const std::vector<ScanMeasurements>& members) {
  std::vector<double> shares, residuals_m, leads_a_pair;
  for (const auto& m : members) {
    shares.push_back(m.evidence.inlier_share);
    residuals_m.push_back(m.evidence.median_residual_m);
    leads_a_pair.push_back(m.lead_a_pair());
  }
  if (shares.empty()) return {};
  std::sort(residuals_m.begin(), residuals_m.end());
  return {median(shares), residuals_m[(residuals_m.size() - 1) / 2], median(leads_a_pair)};
}

DecisionFeatures decision_features(const ScanMeasurements& m, const ComponentReference& component) {
  const AlignmentEvidence& e = m.evidence;
  const double lead = std::clamp(m.lead, kLeastLead, kMostLead);
  DecisionFeatures f{};
  f[0] = lead;
  f[1] = lead > 0 ? std::log1p(lead) : lead;
  f[2] = log_share(e.overlap);
  f[3] = log_share(e.inlier_share);
  f[4] = log_ratio(std::max(e.inlier_share, kLeastShare), component.inlier_share);
  f[5] = log_ratio(e.median_residual_m, component.residual_m);
  f[6] = weakest_left(e);
  f[7] = mean_left(e);
  f[8] = left_across(e);
  f[9] = tells_across(e) ? 0 : 1;
  f[10] = std::max(violations(m.free_space), violations(m.free_space_across));
  f[11] = std::max(opposed(m.free_space), opposed(m.free_space_across));
  f[12] = std::log(std::clamp(agreeing(e), 1.0, 1000.0) / 1000);
  f[13] = std::log(std::clamp(m.sigma_in_voxels.value_or(kMostSigma), kLeastSigma, kMostSigma));
  f[14] = std::log1p(m.lead_a_pair());
  f[15] = std::min(0.0, f[14] - std::log1p(component.lead_a_pair));
  return f;
}

void DecisionOptions::validate() const {
  if (!(confidence >= 0 && confidence < 1)) {
    throw InvalidOptions("confidence must be at least 0 and below 1, not " + std::to_string(confidence));
  }
}

Decision decide(const ScanMeasurements& m, const ComponentReference& component, const DecisionOptions& options) {
  Decision decision;
  decision.features = decision_features(m, component);
  if (agreeing(m.evidence) < static_cast<double>(kFewAgreeing)) {
    decision.reason = m.num_across == 0                      ? Reason::kNoLink
                      : m.evidence.num_points < kFewAgreeing ? Reason::kTooFewPoints
                                                             : Reason::kMisfit;
    decision.text = describe(decision.reason, m, component);
    return decision;
  }
  const DecisionFeatures& f = decision.features;
  decision.probability = kScanCalibration.probability(kScanModel.log_odds(f));
  if (decision.probability >= options.confidence) {
    decision.reason = Reason::kAccepted;
  } else {
    // What each kind of measurement takes from the log-odds, where the others are as right scans have them.
    std::array<DecisionFeatures, kNumReasons> instead;
    instead.fill(kScanModel.usual);
    for (std::size_t i = 0; i < f.size(); ++i) instead[static_cast<std::size_t>(reason_of(i))][i] = f[i];
    const auto worst = std::min_element(instead.begin(), instead.end(), [](const auto& x, const auto& y) {
      return kScanModel.log_odds(x) < kScanModel.log_odds(y);
    });
    decision.reason = static_cast<Reason>(worst - instead.begin());
    if (kScanModel.log_odds(*worst) >= kScanModel.log_odds(kScanModel.usual)) decision.reason = Reason::kAmbiguous;
  }
  decision.text = describe(decision.reason, m, component);
  return decision;
}

}  // namespace tcm_icp
