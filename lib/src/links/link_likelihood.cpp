#include "links/link_likelihood.hpp"

#include <algorithm>
#include <array>

namespace tcm_icp {
namespace {

struct LogisticModel {
  double constant;
  LinkFeatures weights;
};

// Scans that have no viewpoint show less; what they show has to count for more.
struct LinkModel {
  LogisticModel sighted, blind;
};

#include "link_model.inc"

double log_odds(const LinkModel& models, const LinkFeatures& features) {
  const LogisticModel& model = features[kBlind] > 0 ? models.blind : models.sighted;
  double sum = model.constant;
  for (std::size_t i = 0; i < features.size(); ++i) sum += model.weights[i] * features[i];
  return sum;
}

}  // namespace

double hypothesis_log_odds(const LinkFeatures& features) { return log_odds(kHypothesisModel, features); }

double pose_log_odds(const LinkFeatures& features) { return log_odds(kPoseModel, features); }

}  // namespace tcm_icp
