#pragma once
// The poses that pairs of scans may have, with what speaks for each.

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "core/acceptance.hpp"
#include "inference/compared_pairs.hpp"
#include "inference/cuts.hpp"
#include "survey/survey_evidence.hpp"
#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/links/link_measurements.hpp"

namespace tcm_icp {

/// What found a hypothesis.
enum class SearchStage : char {
  kFirst,  ///< the first search of the set, or poses that others imply
  kLater,  ///< a search for scans that the first left without a clear place
  kDeep,   ///< more of what searches found (kGreatDepth), where their best left scans without one
};

/// A pose that a pair may have, after a fit.
struct LinkHypothesis {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();  ///< local frames
  PoseCandidate candidate;                                  ///< what the fit started from
  LinkMeasurements measurements;
  SearchStage stage = SearchStage::kFirst;
  double second_best_ratio = 0;  ///< SearchMeasurements::second_best_ratio
  double by_survey = 0;          ///< part of log_odds: SurveyEvidence::log_odds(), where that is no blunder
  double log_odds = 0;           ///< that it is right, by the pair and what its set usually shows

  bool is_later() const { return stage != SearchStage::kFirst; }
};

/// Whether one of the poses is nearer than `distance_m` (rms over the scan that the moments are of).
bool has_within(const std::vector<Eigen::Isometry3d>& known, const Eigen::Isometry3d& T_a_b, double distance_m,
                const PointMoments& moments);

/// What it measures, among the hypotheses of a set.
LinkFeatures features_of(const LinkHypothesis& h, const SetReference& set);

/// What a pair shows at a pose that others imply, as measured there.
struct MeasuredPose {
  std::size_t a = 0, b = 0;  ///< a < b
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  LinkMeasurements measurements;
};

/// All hypotheses of a set, by pairs (a < b).
class HypothesisSet {
 public:
  /// @param moments  of each scan's points
  /// @param survey   of the same scans, in the frames that poses are between
  HypothesisSet(double voxel_m, double noise_m, std::vector<PointMoments> moments, SurveyEvidence survey = {});

  /// A pair that was compared, with or without a hypothesis. A pose it has already is left as it is.
  void add(std::size_t a, std::size_t b, const std::vector<LinkHypothesis>& hypotheses);

  /// Log-odds of all hypotheses anew: they are relative to one another. The likeliest of a pair comes first.
  void score();

  /// Without the deep ones that are likelier wrong than right by themselves. So many are looked at for the one that
  /// stands out; of the others so few are right that they say nothing but that it may lie anywhere. What is left takes
  /// the place of implied ones of the same pose. @pre scored
  void drop_unlikely_deep();

  /// Learns from the hypotheses that agree with `components`, and those that contradict them, how much likelier or
  /// unlikelier this set's are than those of other sets that look alike: a constant in the log-odds of those that the
  /// first search found, and another in those that were found since. Of the latter fewer are right, the more the harder
  /// their scans are, which says nothing of the former. What hangs by a small lead counts little. score() brings them
  /// into effect. Cost: pairs times scans.
  /// @param cuts        weakest_cuts() of each component
  /// @param set_spread  InferenceOptions::set_spread
  /// @return whether a constant is another than before
  bool learn_constants(const std::vector<Component>& components, const std::vector<std::vector<Cut>>& cuts,
                       double set_spread);

  const std::map<std::pair<std::size_t, std::size_t>, std::vector<LinkHypothesis>>& pairs() const { return pairs_; }
  const SetReference& reference() const { return reference_; }
  const std::vector<PointMoments>& moments() const { return moments_; }
  double same_m() const { return kSameLinkPose * voxel_m_; }
  double fitted_m() const { return kFittedShare * same_m(); }  ///< a coarse voxel

  /// Of the likeliest hypothesis; minus infinity where there is none.
  double log_odds(std::size_t a, std::size_t b) const;

  /// The pairs of the scans with `open`.
  PairGraph graph(const std::vector<bool>& open, const InferenceOptions& options) const;

  /// What pairs show at poses that others imply, judged as the set's hypotheses are; for PairGraph::with().
  std::vector<ComparedPair> compared_there(const std::vector<MeasuredPose>& measured) const;

  /// Without pairs that were compared and of which no hypothesis that is likelier right than wrong leads to their pose,
  /// as long as other pairs connect both scans. Such a pair shares little, and what its surfaces lie next to may be a
  /// wall's other face: a scan of the simulated interiors was drawn off by 0.1 m, half a street by 1.8 coarse voxels
  /// from links that were sure. Pairs that were not compared stay, and those that are likelier right by what they show
  /// at their pose, wherever their own fits slid to.
  /// @param T_reference_scan  of every scan that a pair names
  /// @param there             compared_there() of some of the pairs
  std::vector<std::pair<std::size_t, std::size_t>> without_unlikely(
      std::vector<std::pair<std::size_t, std::size_t>> pairs, const std::vector<Eigen::Isometry3d>& T_reference_scan,
      const std::vector<ComparedPair>& there) const;

 private:
  PoseHypothesis pose_of(const LinkHypothesis& h) const;
  PoseHypothesis pose_of(const MeasuredPose& measured) const;

  /// Adds what the survey says to all log-odds, but of scans of which it says something wrong. @pre log_odds are by
  /// what pairs show alone
  void weigh_by_survey();
  double by_survey(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const;
  /// Of each pair that has hypotheses above even odds. @pre log_odds are by what pairs show alone
  std::vector<PairBySurvey> likely_by_survey() const;
  bool is_blunder(std::size_t scan) const { return !blunders_.empty() && blunders_[scan]; }

  /// Log-odds in this set of a hypothesis with such log-odds by itself; and the other way round.
  double in_set(const LinkHypothesis& h, double by_itself) const {
    return h.is_later() ? reference_.later_constant + reference_.later_slope * by_itself
                        : reference_.constant + by_itself;
  }
  double by_itself(const LinkHypothesis& h) const {
    const double in_set = h.log_odds - h.by_survey;
    return h.is_later() ? (in_set - reference_.later_constant) / reference_.later_slope : in_set - reference_.constant;
  }

  double voxel_m_, noise_m_;
  std::vector<PointMoments> moments_;
  SurveyEvidence survey_;
  std::vector<bool> blunders_;  // of each scan, whether what is known of it is set aside; empty: of none
  std::map<std::pair<std::size_t, std::size_t>, std::vector<LinkHypothesis>> pairs_;
  SetReference reference_;
  // What the constant of those that the first search found was learnt from.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<JudgedHypothesis>> teachers_;
};

}  // namespace tcm_icp
