#include "decision/link_decision.hpp"

#include <cmath>

#include "core/acceptance.hpp"
#include "core/figure_text.hpp"
#include "links/link_likelihood.hpp"

namespace tcm_icp {

LinkRecord judge_link(std::size_t a, std::size_t b, const LinkMeasurements& m, const SetReference& set) {
  LinkRecord out;
  out.a = a;
  out.b = b;
  out.evidence = m.evidence;
  out.free_space = m.free_space;
  out.probability = 1 / (1 + std::exp(-set.constant - pose_log_odds(link_features(m, std::nullopt, set))));
  out.verdict = out.probability >= kLinkAccepted  ? Verdict::kAccepted
                : out.probability < kLinkRejected ? Verdict::kRejected
                                                  : Verdict::kDoubtful;
  out.reason = percent(m.evidence.overlap) + " overlap, " + percent(m.evidence.inlier_share) +
               " of that agrees within the noise; moved by " + figure(m.evidence.slide_m, 2) +
               " m in its weakest direction, " + percent(m.evidence.left_after_slide[0]) +
               " of the agreement would be left";
  if (m.free_space.tells()) {
    out.reason += "; " + percent(m.free_space.violation_share()) + " is seen through walls";
  }
  return out;
}

}  // namespace tcm_icp
