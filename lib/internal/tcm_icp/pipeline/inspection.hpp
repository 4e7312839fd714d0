#pragma once
// What is known of scans before any is placed: counts, extents, TCM between pairs, correspondence graph.

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/pipeline/result_writer.hpp"

namespace tcm_icp {

/// How the scans of a set compare, at their initial poses.
struct ScanComparison {
  double coarse_voxel_m = 0;      ///< [m] resolution scans are placed with, common to the set
  Eigen::MatrixXd paper_tcm_m4;   ///< [m^4] tau as printed, n x n; symmetric, NaN on the diagonal
  Eigen::MatrixXd robust_tcm_m2;  ///< [m^2] tau with statistics in place of minima; the same form
  CorrespondenceGraph graph;      ///< of the profile asked for
};

struct Inspection {
  std::vector<ScanSummary> scans;
  std::vector<Eigen::AlignedBox3d> boxes_m;  ///< [m] of each working cloud, outliers left out; raw coordinates
  std::optional<ScanComparison> comparison;  ///< of two or more scans
};

/// Reads, samples and compares the scans where they lie, or at their initial poses, as Pipeline::run() does in the
/// paper profile: there the same measures and the same reference come out. No links are searched. Raw points stream by
/// once; memory follows the working clouds. Cost: tau of n^2 / 2 pairs.
/// @param initial_poses  one a scan; where none is given the scan is taken as it lies
/// @throws InputError, InvalidInput  as Pipeline::run(), but one scan is enough
/// @throws InvalidOptions            an option out of its bounds, no scan
/// @throws Cancelled                 the context's on_progress asked for it
Inspection inspect_scans(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                         const PipelineOptions& options, const RunContext& context);

/// The inspection as JSON text (docs/formats.md). Numbers that are not known are null.
std::string inspection_json(const Inspection& inspection, const PipelineOptions& options, const RunContext& context,
                            const RunDescription& description);

}  // namespace tcm_icp
