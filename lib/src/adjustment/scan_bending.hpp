#pragma once
// Sweeps of a moving scanner are bent; how they are is solved for beside their poses, so that it does not move them.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "adjustment/bend_evidence.hpp"
#include "registration/joint_normal_equations.hpp"
#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp {

constexpr int kPoseUnknowns = 6, kHarmonicUnknowns = 9;
constexpr int kBendUnknowns = kHarmonicUnknowns + 1;  // and the motion
constexpr int kBentUnknowns = kPoseUnknowns + kBendUnknowns;
using BentSums = LinkSums<kBentUnknowns>;

/// Where and how a scan was taken, in its own frame.
struct ScanOrigin {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< that the scanner turned about, of either sign; of unit length
  bool located = false;                             ///< whether the place is known
  bool swept = false;  ///< whether the points lie on lines that were swept about that place
};

/// A spinning scanner sees what lies in one direction at one time, and one that moves meanwhile from one place. Two
/// parts of that are solved for, neither of which asks for times or an order of the points:
///
/// - What scans have in common. While the scanner turns by a share of a turn, it moves by that share of `m`, the motion
///   during a whole turn. Where two scans see one place in directions that differ by such a share, they see it
///   displaced by it: in surfaces across the way, to the left and to the right by opposite signs, which turns each scan
///   against the one before, and bends a chain. `m` lies along the way, which is where its neighbours were taken from:
///   one number [m] a scan, of those whose place is known. Nothing is assumed of the direction in which turns begin.
/// - How scans differ. To first order a point in direction u (of unit length, from where the scan was taken) lies D u
///   off, with a 3 x 3 matrix D [m] a scan: the first harmonic of a constant motion during a turn. Of swept scans.
///
/// The motions of all scans are taken to be drawn from one normal distribution about 0, the entries of all D from
/// another. Their deviations are the most likely ones; where one is 0, that part is not solved for.
class ScanBending {
 public:
  /// @param origins  of each scan; scans that are not located are not bent
  explicit ScanBending(std::vector<ScanOrigin> origins);

  /// To be called when poses have moved.
  void set_poses(const std::vector<Eigen::Isometry3d>& T_reference_scan);

  /// Moves points of matches to where they would lie in scans that are not bent.
  void straighten(JointLink& link) const;

  /// How much scans are bent. To be asked before anything is straightened: where D fits already, what matches have in
  /// common is gone.
  void estimate(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames, const MatchNoise& noise,
                int num_threads);

  /// Whether there is anything to solve for but poses.
  bool any() const { return harmonic_.any() || motion_.any(); }
  /// [m] root mean square of what points lie off by D; 0 where there is nothing.
  double offset_m() const { return std::sqrt(3.0) * harmonic_.deviation_m; }  // of three coordinates
  /// [m] root mean square of the motions during a turn; 0 where there is nothing.
  double motion_m() const { return motion_.deviation_m; }

  /// Huber's sums over a link that was straightened: of both poses' unknowns, both D's, row by row, and both motions.
  BentSums sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m) const;
  /// Adds what is known of D and the motions before any match is looked at.
  void add_prior(JointNormalEquations& equations) const;
  void add_step(std::size_t scan, const Eigen::Matrix<double, kBendUnknowns, 1>& step_m);

 private:
  using Bend = Eigen::Matrix<double, kBendUnknowns, 1>;
  using Harmonic = Eigen::Matrix<double, kHarmonicUnknowns, 1>;
  using Gradient = Eigen::Matrix<double, kBentUnknowns, 1>;

  void find_ways(const std::vector<JointLink>& links);
  Eigen::Vector3d direction(std::size_t scan, const Eigen::Vector3d& point) const;
  Eigen::Vector3d offset_of(std::size_t scan, const Eigen::Vector3d& point) const;
  /// By how much of a turn the source scan sees a place farther on than the target does, of either sign; 0 where that
  /// says nothing.
  double turned(const JointLink& link, const Correspondence& match) const;
  Harmonic harmonic_gradient(const JointLink& link, const Correspondence& match, bool is_target) const;
  Gradient gradient(const JointLink& link, const Correspondence& match, bool is_target, const TwistFrame& frame,
                    double share) const;

  std::vector<ScanOrigin> origins_;
  // In the common frame:
  Points places_;
  Points ways_;  ///< of unit length, of either sign; zero where there is none
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();
  std::vector<Bend> bends_m_;
  BendPrior harmonic_, motion_;
};

}  // namespace tcm_icp
