#pragma once
// How well the final poses are determined, from the matches of the joint adjustment's last step.

#include <Eigen/Geometry>
#include <vector>

#include "adjustment/joint_matches.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/links/link_record.hpp"
#include "tcm_icp/registration/pose_covariance.hpp"

namespace tcm_icp {

/// Covariance of every pose; and the strength of every link, in the order of `pairs`.
void measure_uncertainty(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                         const Resolutions& resolutions, const std::vector<Eigen::Isometry3d>& T_reference_scan,
                         int num_threads, JointUncertainty& uncertainty, std::vector<LinkRecord>& links);

/// Covariance [m^2] of the steps of all scans together about scan_frames(), 6 n x 6 n: zero for the reference, very
/// large for what the matches do not determine.
Eigen::MatrixXd joint_covariance(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                                 const Resolutions& resolutions, const std::vector<Eigen::Isometry3d>& T_reference_scan,
                                 int num_threads);

}  // namespace tcm_icp
