#pragma once
// Sweeps of a moving scanner are bent; how they are is solved for beside their poses, so that it does not move them.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "registration/joint_normal_equations.hpp"
#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

constexpr int kPoseUnknowns = 6, kBendUnknowns = 9;
constexpr int kBentUnknowns = kPoseUnknowns + kBendUnknowns;
using BentSums = LinkSums<kBentUnknowns>;

/// A spinning scanner sees what lies in one direction at one time, and one that moves meanwhile from one place: to
/// first order a point in direction u (of unit length, from where the scan was taken) lies D u off, with a 3 x 3 matrix
/// D [m] a scan. That is the first harmonic of a constant motion during a turn; it asks neither for times nor for an
/// order of the points. Entries of all D are taken to be drawn from one normal distribution about 0. Its deviation is
/// the most likely one (MacKay, Bayesian interpolation, 1992); where that is 0, scans are not bent, and only poses are
/// solved for.
class ScanBending {
 public:
  /// @param places_in_scan  where each scan was taken from, in its own frame
  /// @param swept           whether its points lie on lines that were swept about that place; others are not bent
  ScanBending(Points places_in_scan, std::vector<bool> swept);

  /// To be called when poses have moved.
  void set_poses(const std::vector<Eigen::Isometry3d>& T_reference_scan);

  /// Moves points of matches to where they would lie in scans that are not bent.
  void straighten(JointLink& link) const;

  /// How much D's entries vary, by what each scan's matches say of its D, its own pose being free and its neighbours
  /// held. Matches of one pair of scans may all err alike, and so may those of one place: only what several pairs and
  /// many places say bears it out. To be asked before anything is straightened: where D fits already, what matches have
  /// in common is gone.
  /// @param noise_m  [m] of residuals; Huber's threshold is its kHuberFactor
  /// @param block_m  [m] smallest edge of a place: the resolution of the points
  void estimate(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames, double noise_m,
                double block_m, int num_threads);

  /// Whether there is anything to solve for but poses.
  bool any() const { return deviation_m_ > 0; }
  /// [m] root mean square of what points lie off; 0 where there is nothing.
  double offset_m() const;

  /// Huber's sums over a link that was straightened: of both poses' unknowns, and of both D's, row by row.
  BentSums sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m) const;
  /// Adds what is known of D before any match is looked at.
  void add_prior(JointNormalEquations& equations) const;
  void add_step(std::size_t scan, const Eigen::Matrix<double, kBendUnknowns, 1>& step_m);

 private:
  using Bend = Eigen::Matrix<double, kBendUnknowns, 1>;
  using Gradient = Eigen::Matrix<double, kBentUnknowns, 1>;

  /// What the matches of one scan say of its D.
  struct Evidence {
    Bend curvatures = Bend::Zero();  ///< along the eigenvectors
    Bend scores = Bend::Zero();      ///< [m] along them, at D = 0
    double squares_m2 = 0;           ///< of the scores of all matches
    double alike_squares_m2 = 0;     ///< of those of all pairs, or of all places, what is more
  };
  Evidence evidence_of(std::size_t scan, const std::vector<const JointLink*>& links, const TwistFrame& frame,
                       double threshold_m, double block_m) const;

  Eigen::Vector3d direction(std::size_t scan, const Eigen::Vector3d& point) const;
  Eigen::Vector3d offset_of(std::size_t scan, const Eigen::Vector3d& point) const;
  Gradient gradient(const Correspondence& match, std::size_t scan, const TwistFrame& frame,
                    const Eigen::Vector3d& point) const;

  Points places_in_scan_, places_;  ///< the second in the common frame
  std::vector<bool> swept_;
  std::vector<Bend> bends_m_;
  double deviation_m_ = 0;
  double weight_ = 0;  ///< of D's squares, beside squared residuals
};

}  // namespace tcm_icp
