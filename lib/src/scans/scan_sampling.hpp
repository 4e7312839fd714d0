#pragma once
// The first pass over a scan: counts, local origin, working cloud without outliers.

#include <cstdint>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/core/scan.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"
#include "tcm_icp/scans/sampling_options.hpp"
#include "tcm_icp/visibility/viewpoint_clues.hpp"

namespace tcm_icp {

struct SampledScan {
  Scan scan;  ///< working cloud with outliers removed, with a normal at every point that has one
  std::vector<std::uint8_t> is_surface;  ///< of each point; not where the place is too rough
  ViewpointClues clues;                  ///< of the working cloud, if wanted
  OutlierRule outliers;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m] median point of the working cloud
  std::string digest{};                              ///< of all this depends on; empty without a work folder
};

/// What is found out about a scan while its neighbours are at hand, each with what stands before it. Who does not need
/// it should not pay for it: a conventional ICP asks for points, the paper's profile for normals.
enum class ScanDetail { kPoints, kNormals, kViewpointClues };

/// Streams the scan through a voxel sampler (origin: its first point), learns the outlier rule and applies it to the
/// working cloud, then finds the detail that is wanted; without normals the noise is 0. Memory follows
/// max_working_points.
/// @throws InputError, InvalidInput
SampledScan sample_scan(const ScanInput& input, const SamplingOptions& sampling, const OutlierOptions& outliers,
                        std::uint64_t seed, int num_threads, ScanDetail detail = ScanDetail::kViewpointClues);

}  // namespace tcm_icp
