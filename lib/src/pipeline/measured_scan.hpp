#pragma once
// What speaks for and against one scan's place among the others, as far as its points tell.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "scans/prepared_scan.hpp"
#include "tcm_icp/decision/scan_decision.hpp"
#include "tcm_icp/links/link_measurements.hpp"
#include "tcm_icp/registration/pose_covariance.hpp"

namespace tcm_icp {

/// A pair of a scan that was adjusted, and what it shows at the adjusted poses.
struct LinkOfScan {
  std::size_t other = 0;
  const LinkMeasurements* measurements = nullptr;
};

/// The scan's held-out points against the union of those it overlaps most with, and what all its pairs see. Neither
/// lead nor sigma.
/// @param T  of every scan of the set that `links` name, and of this one
ScanMeasurements measure_scan(const std::vector<PreparedScan>& scans, std::size_t scan,
                              const std::vector<LinkOfScan>& links, const std::vector<Eigen::Isometry3d>& T);

/// Rms over the scan's points of the standard deviation that its pose's covariance leaves them, in coarse voxels; none
/// where the pose is not determined.
std::optional<double> sigma_in_voxels(const PoseUncertainty& uncertainty, const PointMoments& points,
                                      const Eigen::Isometry3d& T, double coarse_m);

}  // namespace tcm_icp
