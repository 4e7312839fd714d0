#pragma once
// What is known of the survey frame, as evidence for how two scans lie to one another.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tcm_icp {

/// What is known of one scan. All that is given is in the survey frame.
struct SurveyedScan {
  struct Point {
    std::string name;                                    ///< points of one name share their given place
    Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< [m] in the scan
    Eigen::Vector3d given = Eigen::Vector3d::Zero();     ///< [m]
    double sigma_given_m = 1, sigma_measured_m = 0;      ///< along the axis that is known least
  };
  struct Pose {
    Eigen::Isometry3d T_survey_scan = Eigen::Isometry3d::Identity();
    double sigma_position_m = 0;    ///< of the scan's middle
    double sigma_rotation_rad = 0;  ///< about each axis
  };

  std::vector<Point> points;
  std::optional<Pose> pose;
  double sigma_level_rad = 0;                        ///< of its z axis from the vertical; 0: not known to be upright
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m] mean of its points
  double radius_m = 0;                               ///< rms distance of its points from there
};

/// Two scans that both have control points, positions, weighted poses or levels cannot lie just anywhere.
class SurveyEvidence {
 public:
  SurveyEvidence() = default;  ///< nothing is known

  /// @param voxel_m  > 0; poses of pairs that have been fitted are as good as that [m], rms over their points
  SurveyEvidence(std::vector<SurveyedScan> scans, double voxel_m);

  bool empty() const { return scans_.empty(); }

  /// What is known of both, against a pose: half of the squared normalised residual of what contradicts it most, as far
  /// as that is beyond three standard deviations; -8 at the least, for what is known may be a blunder. Distances
  /// between points of either scan are compared, points with the pose of the other scan, poses, and verticals. Poses
  /// are between the frames that the scans' points are in. Cost: pairs of points.
  double log_odds(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const;

 private:
  double largest_residual(const SurveyedScan& a, const SurveyedScan& b, const Eigen::Isometry3d& T_a_b) const;

  std::vector<SurveyedScan> scans_;
  double voxel_m_ = 0;
};

/// What the survey says of the poses that a pair by itself shows to be likelier right than wrong.
struct PairBySurvey {
  std::size_t a = 0, b = 0;
  double log_odds = 0;  ///< SurveyEvidence::log_odds() of the one it contradicts least
};

/// Scans of which something else is known than is true, or something is known of the wrong scan: one after another
/// those that most of their pairs contradict, two at least. Where no more than one in five of the scans that have
/// pairs, or one of three and more, explain nearly all that contradicts the survey, these; otherwise none, for then the
/// pairs are wrong. Cost: scans times pairs.
std::vector<bool> survey_blunders(const std::vector<PairBySurvey>& pairs, std::size_t num_scans);

}  // namespace tcm_icp
