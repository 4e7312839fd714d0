#pragma once
// Scans that hold together, adjusted to what is known of the survey frame.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/registration/refinement.hpp"

namespace tcm_icp {

/// The scans of one component as the joint adjustment left them, in its local frame.
struct ScanNetwork {
  std::vector<Eigen::Isometry3d> T_local_scan;
  std::vector<TwistFrame> frames;  ///< of each scan, in the local frame
  /// [m^2] of all scans' steps about their frames, 6 n x 6 n, as the joint adjustment gives it: zero for its reference.
  Eigen::MatrixXd covariance_m2;
};

/// The common frame, in place of a scan.
constexpr std::size_t kNoScan = std::numeric_limits<std::size_t>::max();

/// A point of a scan whose place in the survey frame is given.
struct PointObservation {
  std::string name;                                    ///< observations of one name share the given place
  std::size_t scan = kNoScan;                          ///< kNoScan: measured in the local frame itself
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< [m] in the scan
  Eigen::Vector3d given = Eigen::Vector3d::Zero();     ///< [m] in the survey frame, near its origin
  Eigen::Vector3d sigma_given_m = Eigen::Vector3d::Ones();
  Eigen::Vector3d sigma_measured_m = Eigen::Vector3d::Zero();
  bool is_check = false;
};

/// A scan whose pose is known.
struct PoseObservation {
  std::string name;  ///< of the scan, for remarks
  std::size_t scan = 0;
  Eigen::Isometry3d T_survey_scan = Eigen::Isometry3d::Identity();
  double sigma_rotation_rad = 0, sigma_position_m = 0;  ///< > 0; the position is that of the frame's centre
  bool is_fixed = false;  ///< by the user's word: it is named where it contradicts the others, and not left out
};

/// A scan whose z axis is upright.
struct LevelObservation {
  std::size_t scan = 0;
  double sigma_rad = 0;  ///< > 0
};

struct SurveyObservations {
  std::vector<PointObservation> points;
  std::vector<PoseObservation> poses;
  std::vector<LevelObservation> levels;
};

/// Which of the points and poses take part.
struct UsedObservations {
  std::vector<bool> points, poses;
};

struct SurveyPoint {
  bool is_used = false, is_blunder = false;
  Eigen::Vector3d residual_m = Eigen::Vector3d::Zero();  ///< computed less given
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();     ///< of that, by what was stated
  double redundancy = 0;                                 ///< 0..3
  std::optional<double> test;  ///< chi squared with three degrees of freedom; nothing where it is not checked
};

struct SurveySolution {
  Eigen::Isometry3d T_survey_local = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Isometry3d> T_survey_scan;
  /// Of the twist (rotation [rad] about the scan's centre, translation [m]) of each, axes of the survey frame.
  std::vector<Eigen::Matrix<double, 6, 6>> covariance;
  int num_rotations = 0;  ///< 0..3 directions of rotation that are determined; the others turn as little as can be
  int degrees_of_freedom = 0;
  double chi_squared = 0;       ///< of all that was used
  double largest_change_m = 0;  ///< [m] rms over its points by which a scan was moved among the others, at most
  std::vector<SurveyPoint> points;
  std::vector<std::string> remarks;

  bool is_determined() const { return num_rotations == 3; }
};

/// Value that chi squared with so many degrees of freedom exceeds once in a thousand times (Wilson and Hilferty, 1931).
double chi_squared_limit(int degrees_of_freedom);

/// Generalised least squares in the six parameters of the survey frame and the steps of all scans, which the joint
/// adjustment's covariance weighs against the observations: scans follow control points as far as they are loose.
/// Blunders are found by data snooping (Baarda, 1968): of all points, all given places together, and poses that are not
/// fixed, the one that contradicts the others most leaves, as long as its squared normalised residual exceeds what
/// chance gives once in a thousand times; then all is adjusted anew. One stays where the frame would be less determined
/// without it, and where no more would be left than have left.
/// Rotations that observations leave free beyond 0.2 rad are held where they turn the local frame least.
/// @pre at least one point that is no check, or one pose
/// Cost: O(m^3 + m n^2) for m observed coordinates and n scans, for each blunder.
SurveySolution adjust_to_survey(const ScanNetwork& network, const SurveyObservations& observations);

}  // namespace tcm_icp
