#pragma once
// What is known of the survey frame beside the scans: control points, positions of scanners, scans that stay.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tcm_icp {

/// What a control point is for.
enum class PointUse {
  kControl,  ///< adjusted to
  kCheck,    ///< compared with the result only
};

/// A point measured in one scan whose coordinates in the survey frame are given: a target, or the scanner itself.
struct ControlPoint {
  std::string name;                                    ///< of the point; several observations may share it
  std::string scan;                                    ///< name of the scan; empty: `measured` is in the common frame
  Eigen::Vector3d measured = Eigen::Vector3d::Zero();  ///< [m] raw coordinates of the scan
  Eigen::Vector3d given = Eigen::Vector3d::Zero();     ///< [m] survey frame
  Eigen::Vector3d sigma_given_m = Eigen::Vector3d::Ones();     ///< [m] > 0, along the axes of the survey frame
  Eigen::Vector3d sigma_measured_m = Eigen::Vector3d::Zero();  ///< [m] >= 0, along the axes of the scan
  PointUse use = PointUse::kControl;                           ///< whether the result is adjusted to it
  bool is_scanner = false;                                     ///< from a list of scanners' positions
};

/// An initial pose that is known by so much.
struct PosePrior {
  std::string scan;               ///< name of the scan
  double sigma_position_m = 0;    ///< [m] > 0, the same along all axes
  double sigma_rotation_rad = 0;  ///< [rad] > 0, the same about all axes
};

/// A scan whose z axis is vertical by so much, as its compensator tells.
struct ScanLevel {
  std::string scan;      ///< its name
  double sigma_rad = 0;  ///< about x and about y; 0: not known to be upright
};

/// Empty where the common frame is that of the reference scan.
struct Survey {
  std::vector<ControlPoint> points;  ///< those of one name share their given coordinates
  std::vector<std::string> fixed;    ///< names of scans that stay where their initial poses put them
  std::vector<PosePrior> priors;     ///< of scans whose initial poses have a weight
  /// [rad] standard deviation of each scan's z axis from the vertical, about x and about y; 0: not known to be upright
  double sigma_level_rad = 0;
  std::vector<ScanLevel> levels;  ///< of scans for which that does not hold
  std::string crs;                ///< of the survey frame, as text for files; empty: not known

  /// Whether nothing defines another frame.
  bool empty() const { return points.empty() && fixed.empty() && priors.empty(); }
};

}  // namespace tcm_icp
