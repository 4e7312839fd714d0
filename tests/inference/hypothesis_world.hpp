#pragma once
// Scans at known poses, and hypotheses of pairs as a search would have found them.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "inference/compared_pairs.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp::testing {

/// Poses of a scan less than this apart are one.
constexpr double kSame_m = 1;
constexpr double kRounding = 1e-9;

inline double between(double low, double high, Rng& rng) { return low + (high - low) * uniform01(rng); }

/// Scans of points in a cube of 20 m, each in a frame of its own; tests add what is known of pairs.
class HypothesisWorld {
 public:
  HypothesisWorld(std::size_t num_scans, Rng& rng) : points_(random_points(50, 20, rng)) {
    for (std::size_t i = 0; i < num_scans; ++i) T_world_scan_.push_back(random_pose(50, rng));
  }

  std::size_t num_scans() const { return T_world_scan_.size(); }
  const Points& points() const { return points_; }
  Eigen::Isometry3d T_target_source(std::size_t target, std::size_t source) const {
    return T_world_scan_[target].inverse() * T_world_scan_[source];
  }

  /// The truth, with b moved by `motion` in its own frame.
  PoseHypothesis hypothesis(std::size_t a, std::size_t b, double log_odds,
                            const Eigen::Isometry3d& motion = Eigen::Isometry3d::Identity()) const {
    return {T_target_source(a, b) * motion, log_odds};
  }
  /// The truth, with b put `off_m` to the side.
  PoseHypothesis aside(std::size_t a, std::size_t b, double log_odds, double off_m) const {
    return hypothesis(a, b, log_odds, Eigen::Isometry3d(Eigen::Translation3d(0, off_m, 0)));
  }
  /// Off the truth by `angle_rad` and `shift_m`, as a fit of the pair is.
  PoseHypothesis noisy(std::size_t a, std::size_t b, double log_odds, double angle_rad, double shift_m,
                       Rng& rng) const {
    return {perturbed(T_target_source(a, b), points_, angle_rad, shift_m, rng), log_odds};
  }
  /// Anywhere: agrees with nothing but by a rare chance.
  PoseHypothesis wrong(double log_odds, Rng& rng) const { return {random_pose(50, rng), log_odds}; }

  /// Of a pair that was compared; more of the same pair join it.
  void add(std::size_t a, std::size_t b, const std::vector<PoseHypothesis>& hypotheses) {
    for (ComparedPair& pair : pairs_) {
      if (pair.a != a || pair.b != b) continue;
      pair.hypotheses.insert(pair.hypotheses.end(), hypotheses.begin(), hypotheses.end());
      return;
    }
    pairs_.push_back({a, b, hypotheses});
  }

  const std::vector<ComparedPair>& pairs() const { return pairs_; }
  PairGraph graph(std::vector<ComparedPair> pairs, const InferenceOptions& options = {}) const {
    return {std::move(pairs), std::vector<PointMoments>(num_scans(), PointMoments(points_)), kSame_m, options};
  }
  PairGraph graph(const InferenceOptions& options = {}) const { return graph(pairs_, options); }

  /// The scans named, where they are; in the frame of the first.
  Component truth(const std::vector<std::size_t>& members) const {
    Component out = component_of_one(members.front(), num_scans());
    for (const std::size_t i : members) out.T_reference_scan[i] = T_target_source(out.reference, i);
    return out;
  }
  /// How far [m] a member is from where it should be, the reference being right.
  double error_m(const Component& component, std::size_t scan) const {
    return pose_rmse_m(T_target_source(component.reference, scan), *component.T_reference_scan[scan], points_);
  }
  double worst_error_m(const Component& component) const {
    double worst = 0;
    for (const std::size_t i : component.members()) worst = std::max(worst, error_m(component, i));
    return worst;
  }

 private:
  Points points_;
  std::vector<Eigen::Isometry3d> T_world_scan_;
  std::vector<ComparedPair> pairs_;
};

}  // namespace tcm_icp::testing
