#include "links/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "inference/set_constant.hpp"
#include "links/feature_scales.hpp"
#include "links/link_likelihood.hpp"

namespace tcm_icp {
namespace {

constexpr double kSameConstant = 0.1;  // log-odds; less moves no scan

// Consensus of the best clearly different pose of the pair, that free space does not veto, by this one's. Poses are
// looked at by the same points, so that this tells them apart better than where they came from.
double second_best_ratio(const LinkHypothesis& h, const std::vector<LinkHypothesis>& all, const PointMoments& moments_b,
                         double same_m) {
  const double own = h.measurements.evidence.consensus();
  double best = 0;
  for (const LinkHypothesis& other : all) {
    if (other.measurements.free_space.vetoes()) continue;
    if (rms_displacement(h.T_a_b.inverse() * other.T_a_b, moments_b) < same_m) continue;
    best = std::max(best, other.measurements.evidence.consensus());
  }
  return own > 0 ? best / own : best > 0 ? std::numeric_limits<double>::infinity() : 0;
}

bool is_implied(const LinkHypothesis& h) { return h.candidate.method == CoarseMethod::kImplied; }

}  // namespace

bool has_within(const std::vector<Eigen::Isometry3d>& known, const Eigen::Isometry3d& T_a_b, double distance_m,
                const PointMoments& moments) {
  return std::any_of(known.begin(), known.end(), [&](const Eigen::Isometry3d& T) {
    return rms_displacement(T_a_b.inverse() * T, moments) < distance_m;
  });
}

LinkFeatures features_of(const LinkHypothesis& h, const SetReference& set) {
  return link_features(h.measurements, SearchMeasurements{h.candidate.method, h.candidate.margin, h.second_best_ratio},
                       set);
}

HypothesisSet::HypothesisSet(double voxel_m, double noise_m, std::vector<PointMoments> moments, SurveyEvidence survey)
    : voxel_m_(voxel_m), noise_m_(noise_m), moments_(std::move(moments)), survey_(std::move(survey)) {
  reference_ = SetReference::of(voxel_m_, noise_m_, {});
}

void HypothesisSet::add(std::size_t a, std::size_t b, const std::vector<LinkHypothesis>& hypotheses) {
  std::vector<LinkHypothesis>& known = pairs_[{a, b}];
  for (const LinkHypothesis& h : hypotheses) {
    const auto is_same = [&](const LinkHypothesis& k) {
      return rms_displacement(k.T_a_b.inverse() * h.T_a_b, moments_[b]) < fitted_m();
    };
    const auto same = std::find_if(known.begin(), known.end(), is_same);
    if (same == known.end()) {
      known.push_back(h);
    } else if (h.stage == SearchStage::kDeep) {
      // Whether it stays beside or in place of an implied one is seen once it is scored.
      if (std::none_of(same, known.end(), [&](const auto& k) { return !is_implied(k) && is_same(k); }))
        known.push_back(h);
    } else if (is_implied(*same) && !is_implied(h)) {
      *same = h;  // a search that was told nothing says more than a fit from where others put it, whichever came first
    }
  }
}

void HypothesisSet::score() {
  // Later ones are of scans that the first search left, and mostly wrong, the more the harder the scans are.
  std::vector<LinkMeasurements> first;
  for (const auto& [pair, hypotheses] : pairs_) {
    for (const auto& h : hypotheses) {
      if (!h.is_later()) first.push_back(h.measurements);
    }
  }
  const SetReference learnt = reference_;
  reference_ = SetReference::of(voxel_m_, noise_m_, first);
  reference_.constant = learnt.constant;
  reference_.later_constant = learnt.later_constant;
  reference_.later_slope = learnt.later_slope;
  for (auto& [pair, hypotheses] : pairs_) {
    for (auto& h : hypotheses) {
      h.second_best_ratio = second_best_ratio(h, hypotheses, moments_[pair.second], same_m());
      h.log_odds = in_set(h, hypothesis_log_odds(features_of(h, reference_)));
    }
  }
  if (!survey_.empty()) weigh_by_survey();
  for (auto& [pair, hypotheses] : pairs_) {
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
                     [](const LinkHypothesis& x, const LinkHypothesis& y) { return x.log_odds > y.log_odds; });
  }
}

void HypothesisSet::weigh_by_survey() {
  blunders_.clear();
  for (auto& [pair, hypotheses] : pairs_) {
    for (auto& h : hypotheses) h.by_survey = by_survey(pair.first, pair.second, h.T_a_b);
  }
  blunders_ = survey_blunders(likely_by_survey(), moments_.size());
  for (auto& [pair, hypotheses] : pairs_) {
    for (auto& h : hypotheses) {
      if (is_blunder(pair.first) || is_blunder(pair.second)) h.by_survey = 0;
      h.log_odds += h.by_survey;
    }
  }
}

double HypothesisSet::by_survey(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
  return is_blunder(a) || is_blunder(b) ? 0 : survey_.log_odds(a, b, T_a_b);
}

std::vector<PairBySurvey> HypothesisSet::likely_by_survey() const {
  std::vector<PairBySurvey> out;
  for (const auto& [pair, hypotheses] : pairs_) {
    double most = -std::numeric_limits<double>::infinity();
    for (const LinkHypothesis& h : hypotheses) {
      if (h.log_odds > 0) most = std::max(most, h.by_survey);
    }
    if (std::isfinite(most)) out.push_back({pair.first, pair.second, most});
  }
  return out;
}

void HypothesisSet::drop_unlikely_deep() {
  const auto is_deep = [](const LinkHypothesis& h) { return h.stage == SearchStage::kDeep; };
  std::size_t dropped = 0;
  for (auto& [pair, hypotheses] : pairs_) {
    dropped += std::erase_if(hypotheses, [&](const auto& h) { return is_deep(h) && by_itself(h) < 0; });
    std::vector<Eigen::Isometry3d> left;
    for (const auto& h : hypotheses) {
      if (is_deep(h)) left.push_back(h.T_a_b);
    }
    dropped += std::erase_if(hypotheses, [&, b = pair.second](const auto& h) {
      return is_implied(h) && has_within(left, h.T_a_b, fitted_m(), moments_[b]);
    });
  }
  if (dropped > 0) score();
}

bool HypothesisSet::learn_constants(const std::vector<Component>& components, const std::vector<std::vector<Cut>>& cuts,
                                    double set_spread) {
  std::vector<JudgedHypothesis> first, later;
  teachers_.clear();
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Component& component = components[c];
    const Leads leads(cuts[c], moments_.size());
    const auto& T = component.T_reference_scan;
    for (const auto& [pair, hypotheses] : pairs_) {
      const auto [a, b] = pair;
      if (!component.has(a) || !component.has(b)) continue;
      const double sure = 1 / (1 + std::exp(-leads.between(a, b)));
      for (const auto& h : hypotheses) {
        if (is_implied(h)) continue;  // agrees with poses right or wrong
        const bool right = rms_displacement((T[a]->inverse() * *T[b]).inverse() * h.T_a_b, moments_[b]) < same_m();
        const JudgedHypothesis judged{by_itself(h), right, sure};
        (h.is_later() ? later : first).push_back(judged);
        if (!h.is_later()) teachers_[pair].push_back(judged);
      }
    }
  }
  const double constant = set_constant(first, set_spread);
  const SetShift of_later = set_shift(later, set_spread, set_spread);
  const double change =
      std::max({std::abs(constant - reference_.constant), std::abs(of_later.constant - reference_.later_constant),
                std::abs(of_later.slope - reference_.later_slope)});
  reference_.constant = constant;
  reference_.later_constant = of_later.constant;
  reference_.later_slope = of_later.slope;
  return change > kSameConstant;
}

double HypothesisSet::log_odds(std::size_t a, std::size_t b) const {
  const auto pair = pairs_.find({std::min(a, b), std::max(a, b)});
  if (pair == pairs_.end() || pair->second.empty()) return -std::numeric_limits<double>::infinity();
  return pair->second.front().log_odds;
}

PoseHypothesis HypothesisSet::pose_of(const LinkHypothesis& h) const {
  const AlignmentEvidence& evidence = h.measurements.evidence;
  const double taught = h.is_later() ? 0 : reference_.constant;
  return {h.T_a_b, h.log_odds, is_implied(h), evidence.overlap, weakest_left(evidence), taught};
}

PoseHypothesis HypothesisSet::pose_of(const MeasuredPose& measured) const {
  LinkHypothesis h{measured.T_a_b, {measured.T_a_b, CoarseMethod::kImplied}, measured.measurements};
  if (const auto known = pairs_.find({measured.a, measured.b}); known != pairs_.end()) {
    h.second_best_ratio = second_best_ratio(h, known->second, moments_[measured.b], same_m());
  }
  h.by_survey = by_survey(measured.a, measured.b, h.T_a_b);
  h.log_odds = in_set(h, hypothesis_log_odds(features_of(h, reference_))) + h.by_survey;
  PoseHypothesis out = pose_of(h);
  out.is_there = true;
  const FreeSpaceEvidence& seen = measured.measurements.free_space;
  out.of_a = {seen.num_points - seen.num_points_of_b, seen.num_violating - seen.num_violating_of_b,
              seen.num_large - seen.num_large_of_b};
  out.of_b = {seen.num_points_of_b, seen.num_violating_of_b, seen.num_large_of_b};
  return out;
}

PairGraph HypothesisSet::graph(const std::vector<bool>& open, const InferenceOptions& options) const {
  std::vector<ComparedPair> pairs;
  for (const auto& [pair, hypotheses] : pairs_) {
    if (!open[pair.first] || !open[pair.second]) continue;
    ComparedPair compared{pair.first, pair.second, {}, {}};
    for (const auto& h : hypotheses) compared.hypotheses.push_back(pose_of(h));
    if (const auto taught = teachers_.find(pair); taught != teachers_.end()) compared.teachers = taught->second;
    pairs.push_back(std::move(compared));
  }
  return {std::move(pairs), moments_, same_m(), options};
}

std::vector<ComparedPair> HypothesisSet::compared_there(const std::vector<MeasuredPose>& measured) const {
  std::vector<ComparedPair> out;
  for (const MeasuredPose& m : measured) out.push_back({m.a, m.b, {pose_of(m)}});
  return out;
}

std::vector<std::pair<std::size_t, std::size_t>> HypothesisSet::without_unlikely(
    std::vector<std::pair<std::size_t, std::size_t>> pairs, const std::vector<Eigen::Isometry3d>& T_reference_scan,
    const std::vector<ComparedPair>& there) const {
  std::map<std::pair<std::size_t, std::size_t>, const ComparedPair*> shown;
  for (const ComparedPair& pair : there) shown[{pair.a, pair.b}] = &pair;
  const auto stays = [&](const std::pair<std::size_t, std::size_t>& pair) {
    const auto compared = pairs_.find(pair);
    if (compared == pairs_.end()) return true;
    const Eigen::Isometry3d T_a_b = T_reference_scan[pair.first].inverse() * T_reference_scan[pair.second];
    const auto is_likely_there = [&](const auto& h) {
      return h.log_odds > 0 && rms_displacement(T_a_b.inverse() * h.T_a_b, moments_[pair.second]) < same_m();
    };
    const auto has_one = [&](const auto& all) { return std::any_of(all.begin(), all.end(), is_likely_there); };
    const auto known = shown.find(pair);
    return has_one(compared->second) || (known != shown.end() && has_one(known->second->hypotheses));
  };
  std::vector<std::size_t> group(moments_.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  std::vector<bool> kept;
  for (const auto& pair : pairs) {
    kept.push_back(stays(pair));
    if (kept.back()) group[find(pair.first)] = find(pair.second);
  }
  std::size_t k = 0;
  std::erase_if(pairs, [&](const auto& pair) { return !kept[k++] && find(pair.first) == find(pair.second); });
  return pairs;
}

}  // namespace tcm_icp
