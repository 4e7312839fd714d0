#include "adjustment/uncertainty.hpp"

#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

constexpr double kContactInVoxels = 12;  // the edge of what both scans have to have points in: a few dozen of them

}  // namespace

void measure_uncertainty(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                         const Resolutions& resolutions, const std::vector<Eigen::Isometry3d>& T_reference_scan,
                         int num_threads, JointUncertainty& uncertainty, std::vector<LinkRecord>& links) {
  const std::vector<JointLink> matches =
      match_pairs(scans, pairs, T_reference_scan, kGateInVoxels * resolutions.fine_m, num_threads);
  PoseCovarianceOptions options;
  options.smallest_block_m = resolutions.fine_m;
  uncertainty = estimate_uncertainty(scan_frames(scans, T_reference_scan), reference, matches, options, num_threads);
  parallel_for(num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::vector<JointLink> both{matches[2 * k], matches[2 * k + 1]};
      links[k].strength = link_strength(both, uncertainty.noise_m, uncertainty.block_m);
      links[k].residuals = link_residuals(both, T_reference_scan, kContactInVoxels * resolutions.fine_m);
    }
  });
}

Eigen::MatrixXd joint_covariance(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                                 const Resolutions& resolutions, const std::vector<Eigen::Isometry3d>& T_reference_scan,
                                 int num_threads) {
  const std::vector<JointLink> matches =
      match_pairs(scans, pairs, T_reference_scan, kGateInVoxels * resolutions.fine_m, num_threads);
  PoseCovarianceOptions options;
  options.smallest_block_m = resolutions.fine_m;
  options.keeps_joint = true;
  return estimate_uncertainty(scan_frames(scans, T_reference_scan), reference, matches, options, num_threads)
      .joint_covariance_m2;
}

}  // namespace tcm_icp
