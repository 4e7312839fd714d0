#pragma once
// What inference starts from: pairs of scans that were compared, and the poses each of them may have.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "inference/set_constant.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/inference/inference_options.hpp"

namespace tcm_icp {

constexpr double kLeastGain = 1e-9;  // of support: less is rounding
/// Of the distance at which poses are one: fits to one optimum end nearer one another. A wall's other face may be
/// farther, and still one pose.
constexpr double kFittedShare = 0.25;

/// Of a hypothesis at the right pose: it shows nothing, or else something that is likelier there by its odds.
struct Telling {
  double missed = 1, shows = 1;  ///< as a search has it that may have missed the pose
  double says(double odds) const { return std::log(missed + shows * odds); }
};

/// Points of a scan at surfaces that another saw, or before them; of these, before them; and of those, of things that
/// cannot stand between two rays.
struct LookedAt {
  std::size_t points = 0, violations = 0, large = 0;
};

/// One pose a pair may have.
struct PoseHypothesis {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  double log_odds = 0;  ///< that it is right, by the pair and what the set's poses have taught
  /// Its fit started from where other pairs put the scans: that it lies there is no coincidence.
  bool implied = false;
  double overlap = 1;  ///< of the pair there
  /// Of the pair's agreement there, after a slide in its weakest direction: the more, the less holds the pose.
  double weakest_left = 0;
  double taught = 0;  ///< of the log-odds: the set's constant, as far as `teachers` have taught it
  /// Implied, and measured at the very poses that others imply, where no fit of the pair has ended: what it shows
  /// there, for them or against them. It tells nothing of others.
  bool is_there = false;
  LookedAt of_a = {}, of_b = {};  ///< of a pair that was measured: points of either scan, looked at by the other
  // PairGraph's
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< of b's points, in a's frame
  Telling telling = {};                            ///< were it implied: the less, the less overlaps
  double slid = 0;                                 ///< of log_slid, if it is implied: the more, the less holds it
  double most_support = 0;                         ///< for any poses

  /// @param farther  logarithm of how many times farther off the poses are than what is near
  Telling as_implied(double farther) const {
    return slid > 0 ? Telling{std::min(1.0, telling.missed * std::exp(slid * farther)), telling.shows} : telling;
  }
  Telling as_found(double farther) const { return implied ? as_implied(farther) : Telling{}; }
};

struct ComparedPair {
  std::size_t a = 0, b = 0;  ///< a < b
  std::vector<PoseHypothesis> hypotheses;
  std::vector<JudgedHypothesis> teachers = {};  ///< those of it that the set's constant was learnt from, among others
};

/// What a pair says of its scans' poses.
struct Agreement {
  double support = 0;
  const PoseHypothesis* hypothesis = nullptr;  ///< that says most; none: none agrees
  double pull = 0;                             ///< [1/m^2] with which it draws the poses to its own
};

/// What a pair across a cut says of its scans' poses.
struct SupportAcross {
  double support = 0;
  /// The same against poses at a twin, a place that looks like the right one to all pairs: that a hypothesis is found
  /// there is no coincidence, implied or not, and only what it shows counts; and what poses at a twin teach of the set
  /// is wrong.
  double against_twins = 0;
};

/// Scans that hold together; poses in the local frame of the reference.
struct Component {
  std::size_t reference = 0;
  std::vector<std::optional<Eigen::Isometry3d>> T_reference_scan;  ///< of every scan of the set; none: not a member

  bool has(std::size_t scan) const { return T_reference_scan[scan].has_value(); }
  std::size_t size() const;
  std::vector<std::size_t> members() const;  ///< ascending
};

/// One scan in its own frame.
Component component_of_one(std::size_t scan, std::size_t num_scans);

/// The pairs of a set, with what says which of their poses agree.
class PairGraph {
 public:
  /// @param moments  of each scan's points
  /// @param same_m   [m] > 0; poses of a scan whose rms distance over its points is less are one
  PairGraph(std::vector<ComparedPair> pairs, std::vector<PointMoments> moments, double same_m,
            const InferenceOptions& options);

  /// The same graph with further hypotheses of its pairs, and further pairs.
  PairGraph with(const std::vector<ComparedPair>& more) const;

  std::size_t num_scans() const { return moments_.size(); }
  const std::vector<ComparedPair>& pairs() const { return pairs_; }
  const std::vector<std::size_t>& pairs_of(std::size_t scan) const { return of_scan_[scan]; }
  const InferenceOptions& options() const { return options_; }

  bool same_pose(std::size_t scan, const Eigen::Isometry3d& T, const Eigen::Isometry3d& U) const {
    // Points are farther apart than their mean, which is found at a tenth of the cost.
    return same_mean(T * moments_[scan].mean, U * moments_[scan].mean) &&
           rms_displacement(T.inverse() * U, moments_[scan]) < same_m_;
  }
  /// Whether a fit that starts at one of two poses would end at the other, as far as can be told.
  bool is_fitted(std::size_t scan, const Eigen::Isometry3d& T, const Eigen::Isometry3d& U) const {
    return rms_displacement(T.inverse() * U, moments_[scan]) < kFittedShare * same_m_;
  }
  const Eigen::Vector3d& mean_of(std::size_t scan) const { return moments_[scan].mean; }
  /// Whether the mean of a scan's points lies near enough at two poses for the poses to be one.
  bool same_mean(const Eigen::Vector3d& at_one, const Eigen::Vector3d& at_other) const {
    return (at_one - at_other).squaredNorm() < same_m_ * same_m_;
  }
  /// How far apart [m] two poses of a scan that are one can put what lies `from_mean_m` from the mean of its points.
  double farthest_as_one(std::size_t scan, double from_mean_m) const {
    return same_m_ * std::hypot(1, from_mean_m / least_spread_m_[scan]);
  }

  /// How differently [chord] two poses of a scan that are one can turn a direction.
  double most_turn_as_one(std::size_t scan) const { return same_m_ / least_spread_m_[scan]; }

  /// What a pair says for its scans' poses: the logarithm of how much likelier they are with its hypotheses than if all
  /// of those were wrong, log(1 + exp(l + c)) of the one that says most; 0 where none agrees. c is what it is worth
  /// that a hypothesis and the poses agree so closely: log_poses up to same_m / 8, from there on log_spread less for
  /// every factor e in their distance, since wrong poses scatter and fits to a right one do not; and log_implied less
  /// where it is implied. The 1 is of a search that missed the right pose. A fit that starts there misses it rarely: an
  /// implied hypothesis of little odds counts against the poses, by log_missed at the most; by less where less than
  /// telling_overlap of the pair overlaps there, for the right pose seldom shows there either, and what it shows
  /// counts for less; and by less where it ended farther off and little holds it (log_slid). Where a pair was measured
  /// at these very poses its implied hypotheses about them are not asked, and it may count against them by
  /// log_missed_there.
  double support(const ComparedPair& pair, const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b) const {
    return agreement(pair, T_a, T_b).support;
  }

  /// The same, with the hypothesis it is due to. Its pull is the weight that makes a step of least squares one of
  /// ascent in the support.
  Agreement agreement(const ComparedPair& pair, const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b) const;

  /// The same, and against twins.
  /// @param taught_by_others  the set's constant by what poses at a twin would not have taught
  /// @param alike  >= 0; where the pair was measured at these poses: by how much less its agreement says against twins
  SupportAcross support_across(const ComparedPair& pair, const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b,
                               double taught_by_others, double alike) const;

  /// What a pair showed where it was measured at these very poses; null where it was not.
  const PoseHypothesis* measured_at(const ComparedPair& pair, const Eigen::Isometry3d& T_a,
                                    const Eigen::Isometry3d& T_b) const;

  /// Visits the pairs of the component that were measured at its very poses, ascending, with what each showed there.
  template <typename Visit>
  void for_measured(const Component& component, Visit visit) const {
    const auto& T = component.T_reference_scan;
    for (const std::size_t k : measured_) {
      const ComparedPair& pair = pairs_[k];
      if (!component.has(pair.a) || !component.has(pair.b)) continue;
      if (const PoseHypothesis* there = measured_at(pair, *T[pair.a], *T[pair.b])) visit(pair, *there);
    }
  }

  /// The set's constant as it would be without these pairs, ascending; infinite where they are too few to matter. Cost:
  /// all hypotheses that taught it.
  double constant_without(const std::vector<std::size_t>& pairs) const;

  /// What the members of `component` say for `scan` at T, less log_poses, which one pose of many has to be worth. A
  /// single hypothesis of log-odds l above 0 comes to about l; every other that agrees adds log_poses beside its own.
  double support_of(std::size_t scan, const Eigen::Isometry3d& T, const Component& component) const;

  /// The pose that hypotheses which agree with `scan` at T lead to on average: least squares over its points, by their
  /// pulls. T where none agrees.
  Eigen::Isometry3d mean_pose(std::size_t scan, const Eigen::Isometry3d& T, const Component& component) const;

  /// Adds the poses of `scan` that the hypotheses of its pair with a member lead to, but for those that are known.
  void add_poses(std::size_t scan, const ComparedPair& pair, const Component& component,
                 std::vector<Eigen::Isometry3d>& known) const;

 private:
  // Visits the hypotheses that agree with the poses, with their distance [m], what is near at least, and the logarithm
  // of how many times as far that is.
  template <typename Visit>
  void for_agreeing(const ComparedPair& pair, const Eigen::Isometry3d& T_a, const Eigen::Isometry3d& T_b,
                    Visit visit) const;
  // What a hypothesis says for such poses, before what a search may have missed.
  double odds_found(double log_odds, bool implied, double farther) const;
  Telling telling(double overlap) const;
  double slid(double weakest_left) const;
  // Where the pair was measured there: at these very poses.
  bool is_at(const ComparedPair& pair, const PoseHypothesis& h, const Eigen::Isometry3d& T_a,
             const Eigen::Isometry3d& T_b) const {
    return rms_displacement(T_b.inverse() * (T_a * h.T_a_b), moments_[pair.b]) < same_m_ / 8;
  }

  std::vector<ComparedPair> pairs_;
  std::vector<PointMoments> moments_;
  std::vector<double> least_spread_m_;  // of each scan's points: rms distance from an axis through their mean
  double same_m_;
  InferenceOptions options_;
  std::vector<std::vector<std::size_t>> of_scan_;
  std::vector<std::size_t> measured_;
  std::size_t num_teachers_ = 0;
};

}  // namespace tcm_icp
