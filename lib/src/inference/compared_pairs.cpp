#include "inference/compared_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/decompositions.hpp"

namespace tcm_icp {
namespace {

// Hypotheses whose support would be below log(1 + e^-2) = 0.13 change nothing.
constexpr double kLeastSupported = -2;
// Of what taught a set's constant: less does not change it by what would matter.
constexpr double kFewTeachers = 0.05;

}  // namespace

std::size_t Component::size() const {
  return static_cast<std::size_t>(
      std::count_if(T_reference_scan.begin(), T_reference_scan.end(), [](const auto& T) { return T.has_value(); }));
}

std::vector<std::size_t> Component::members() const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < T_reference_scan.size(); ++i) {
    if (has(i)) out.push_back(i);
  }
  return out;
}

Component component_of_one(std::size_t scan, std::size_t num_scans) {
  Component out{scan, std::vector<std::optional<Eigen::Isometry3d>>(num_scans)};
  out.T_reference_scan[scan] = Eigen::Isometry3d::Identity();
  return out;
}

PairGraph::PairGraph(std::vector<ComparedPair> pairs, std::vector<PointMoments> moments, double same_m,
                     const InferenceOptions& options)
    : pairs_(std::move(pairs)),
      moments_(std::move(moments)),
      same_m_(same_m),
      options_(options),
      of_scan_(moments_.size()) {
  for (auto& pair : pairs_) {
    std::erase_if(pair.hypotheses,
                  [&](const auto& h) { return !h.implied && h.log_odds + options_.log_poses < kLeastSupported; });
    for (auto& h : pair.hypotheses) {
      h.mean = h.T_a_b * moments_[pair.b].mean;
      h.telling = h.is_there ? Telling{std::exp(options_.log_missed_there), 1} : telling(h.overlap);
      if (h.implied && !h.is_there) h.slid = slid(h.weakest_left);
      const Telling found = h.as_found(0);
      const double odds = odds_found(h.log_odds, h.implied, 0);
      h.most_support = h.slid > 0 ? std::log1p(found.shows * odds) : found.says(odds);
    }
  }
  std::erase_if(pairs_, [](const auto& pair) { return pair.hypotheses.empty(); });
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    num_teachers_ += pairs_[k].teachers.size();
    of_scan_[pairs_[k].a].push_back(k);
    of_scan_[pairs_[k].b].push_back(k);
    const auto& all = pairs_[k].hypotheses;
    if (std::any_of(all.begin(), all.end(), [](const auto& h) { return h.is_there; })) measured_.push_back(k);
  }
  for (const PointMoments& points : moments_) {
    const SymmetricEigen<3> axes = symmetric_eigen3(points.covariance);
    least_spread_m_.push_back(std::sqrt(std::max(0.0, axes.values.head<2>().sum())));
  }
}

PairGraph PairGraph::with(const std::vector<ComparedPair>& more) const {
  std::map<std::pair<std::size_t, std::size_t>, ComparedPair> pairs;
  for (const auto* some : {&pairs_, &more}) {
    for (const ComparedPair& pair : *some) {
      ComparedPair& known = pairs.try_emplace({pair.a, pair.b}, ComparedPair{pair.a, pair.b, {}}).first->second;
      known.hypotheses.insert(known.hypotheses.end(), pair.hypotheses.begin(), pair.hypotheses.end());
      known.teachers.insert(known.teachers.end(), pair.teachers.begin(), pair.teachers.end());
    }
  }
  std::vector<ComparedPair> all;
  for (auto& [scans, pair] : pairs) all.push_back(std::move(pair));
  return {std::move(all), moments_, same_m_, options_};
}

const PoseHypothesis* PairGraph::measured_at(const ComparedPair& pair, const Eigen::Isometry3d& T_a,
                                             const Eigen::Isometry3d& T_b) const {
  const auto found = std::find_if(pair.hypotheses.begin(), pair.hypotheses.end(),
                                  [&](const auto& h) { return h.is_there && is_at(pair, h, T_a, T_b); });
  return found == pair.hypotheses.end() ? nullptr : &*found;
}

template <typename Visit>
void PairGraph::for_agreeing(const ComparedPair& pair, const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b,
                             Visit visit) const {
  const Eigen::Vector3d mean =
      T_a.linear().transpose() * (T_b * moments_[pair.b].mean - T_a.translation());  // of b in a's frame
  const bool is_measured = measured_at(pair, T_a, T_b) != nullptr;
  for (const PoseHypothesis& h : pair.hypotheses) {
    if (is_measured ? h.implied && !h.is_there : h.is_there) continue;
    if ((h.mean - mean).squaredNorm() >= same_m_ * same_m_) continue;  // points are farther apart than their mean
    const double apart_m = rms_displacement(T_b.inverse() * (T_a * h.T_a_b), moments_[pair.b]);
    if (apart_m >= same_m_) continue;
    const double beyond_m = std::max(apart_m, same_m_ / 8);
    visit(h, beyond_m, std::log(8 * beyond_m / same_m_));
  }
}

Agreement PairGraph::agreement(const ComparedPair& pair, const Eigen::Isometry3d& T_a,
                               const Eigen::Isometry3d& T_b) const {
  Agreement best;
  for_agreeing(pair, T_a, T_b, [&](const PoseHypothesis& h, double beyond_m, double farther) {
    const Telling found = h.as_found(farther);
    const double odds = odds_found(h.log_odds, h.implied, farther), says = found.says(odds);
    if (best.hypothesis != nullptr && says <= best.support) return;
    const double shown = found.shows * odds;
    best = {says, &h, shown / (found.missed + shown) * options_.log_spread / (beyond_m * beyond_m)};
  });
  return best;
}

SupportAcross PairGraph::support_across(const ComparedPair& pair, const Eigen::Isometry3d& T_a,
                                        const Eigen::Isometry3d& T_b, double taught_by_others, double alike) const {
  std::optional<SupportAcross> most;
  const double less = alike > 0 && measured_at(pair, T_a, T_b) != nullptr ? alike : 0;
  for_agreeing(pair, T_a, T_b, [&](const PoseHypothesis& h, double, double farther) {
    const double says = h.as_found(farther).says(odds_found(h.log_odds, h.implied, farther));
    const double log_odds = h.log_odds - std::max(0.0, h.taught - taught_by_others);
    const double says_of_twins = h.as_implied(farther).says(odds_found(log_odds, true, farther) * std::exp(-less));
    if (!most) most = {says, says_of_twins};
    most = {std::max(most->support, says), std::max(most->against_twins, says_of_twins)};
  });
  return most.value_or(SupportAcross{});
}

double PairGraph::constant_without(const std::vector<std::size_t>& pairs) const {
  std::size_t count = 0;
  for (const std::size_t k : pairs) count += pairs_[k].teachers.size();
  if (static_cast<double>(count) <= kFewTeachers * static_cast<double>(num_teachers_))
    return std::numeric_limits<double>::infinity();
  std::vector<JudgedHypothesis> others;
  auto next = pairs.begin();
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (next != pairs.end() && *next == k) {
      ++next;
    } else {
      others.insert(others.end(), pairs_[k].teachers.begin(), pairs_[k].teachers.end());
    }
  }
  return set_constant(others, options_.set_spread);
}

double PairGraph::odds_found(double log_odds, bool implied, double farther) const {
  const double chance = options_.log_poses - (implied ? options_.log_implied : 0) - options_.log_spread * farther;
  return std::exp(std::min(log_odds, options_.most_log_odds) + chance);
}

Telling PairGraph::telling(double overlap) const {
  const double log_missed = options_.log_missed * std::min(1.0, overlap / options_.telling_overlap);
  if (options_.log_missed == 0) return {1, 1};
  return {std::exp(log_missed), std::expm1(log_missed) / std::expm1(options_.log_missed)};
}

double PairGraph::slid(double weakest_left) const {
  const double loose = (weakest_left - options_.firm_left) / (options_.loose_left - options_.firm_left);
  return options_.log_slid * std::clamp(loose, 0.0, 1.0);
}

double PairGraph::support_of(std::size_t scan, const Eigen::Isometry3d& T, const Component& component) const {
  double sum = -options_.log_poses;
  for (const std::size_t k : pairs_of(scan)) {
    const ComparedPair& pair = pairs_[k];
    const std::size_t other = pair.a == scan ? pair.b : pair.a;
    if (!component.has(other)) continue;
    const Eigen::Isometry3d& T_other = *component.T_reference_scan[other];
    sum += pair.a == scan ? support(pair, T, T_other) : support(pair, T_other, T);
  }
  return sum;
}

Eigen::Isometry3d PairGraph::mean_pose(std::size_t scan, const Eigen::Isometry3d& T, const Component& component) const {
  const PointMoments& points = moments_[scan];
  double sum = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Zero();
  // Points on a line say nothing of a turn about it; the poses do.
  const Eigen::Matrix3d spread = points.covariance + 1e-3 * points.covariance.trace() * Eigen::Matrix3d::Identity();
  for (const std::size_t k : pairs_of(scan)) {
    const ComparedPair& pair = pairs_[k];
    const std::size_t other = pair.a == scan ? pair.b : pair.a;
    if (!component.has(other)) continue;
    const Eigen::Isometry3d& T_other = *component.T_reference_scan[other];
    const Agreement says = pair.a == scan ? agreement(pair, T, T_other) : agreement(pair, T_other, T);
    if (says.hypothesis == nullptr) continue;
    const Eigen::Isometry3d& T_a_b = says.hypothesis->T_a_b;
    const Eigen::Isometry3d pose = T_other * (pair.a == scan ? T_a_b.inverse() : T_a_b);
    sum += says.pull;
    centre += says.pull * (pose * points.mean);
    turned += says.pull * pose.linear() * spread;
  }
  if (sum <= 0) return T;
  Eigen::Isometry3d mean = Eigen::Isometry3d::Identity();
  mean.linear() = project_onto_so3(turned);
  mean.translation() = centre / sum - mean.linear() * points.mean;
  return mean;
}

void PairGraph::add_poses(std::size_t scan, const ComparedPair& pair, const Component& component,
                          std::vector<Eigen::Isometry3d>& known) const {
  const double near_m = same_m_ / 8;
  const Eigen::Isometry3d& T_other = *component.T_reference_scan[pair.a == scan ? pair.b : pair.a];
  for (const PoseHypothesis& h : pair.hypotheses) {
    const Eigen::Isometry3d T = T_other * (pair.a == scan ? h.T_a_b.inverse() : h.T_a_b);
    const Eigen::Vector3d mean = T * moments_[scan].mean;
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const Eigen::Isometry3d& U) {
      // Points are farther apart than their mean.
      return (U * moments_[scan].mean - mean).squaredNorm() < near_m * near_m &&
             rms_displacement(U.inverse() * T, moments_[scan]) < near_m;
    });
    if (!is_known) known.push_back(T);
  }
}

}  // namespace tcm_icp
