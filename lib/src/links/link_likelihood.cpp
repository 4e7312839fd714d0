#include "links/link_likelihood.hpp"

#include <algorithm>
#include <array>

namespace tcm_icp {
namespace {

struct LinkModel {
  double constant;
  LinkFeatures weights;
};

#include "link_model.inc"

double log_odds(const LinkModel& model, const LinkFeatures& features) {
  double sum = model.constant;
  for (std::size_t i = 0; i < features.size(); ++i) sum += model.weights[i] * features[i];
  return sum;
}

}  // namespace

double hypothesis_log_odds(const LinkFeatures& features) { return log_odds(kHypothesisModel, features); }

double pose_log_odds(const LinkFeatures& features) { return log_odds(kPoseModel, features); }

}  // namespace tcm_icp
