#pragma once
// Lines 6 and 7 of Algorithm 1: one scan fitted to S by the simplex method, and refined.

#include <Eigen/Geometry>

#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/merging/merge_options.hpp"
#include "tcm_icp/merging/merge_record.hpp"

namespace tcm_icp {

/// The pose after linear programs over every kind of point, then over surfaces, then descent and annealing where the
/// options ask for them; T_init where the programs fail. Fills in what the record says of the fit.
Eigen::Isometry3d fit_to_cloud(const PreparedScan& scan, const ScanPyramid& s, const Eigen::Isometry3d& T_init,
                               const MergeOptions& options, Rng& rng, MergeRecord& record);

/// The paper's way: simplex over all nearest neighbours in 12 entries, descent and annealing on tau, no verification.
Eigen::Isometry3d place_scan_as_printed(const PreparedScan& scan, const ScanPyramid& s, const Eigen::Isometry3d& T_init,
                                        const MergeOptions& options, Rng& rng, MergeRecord& record);

/// The refinement's own options with steps from the data.
DescentOptions descent_options(const RefinementOptions& options, double first_step_m, double last_step_m);
AnnealingOptions annealing_options(const RefinementOptions& options, double first_step_m, double last_step_m);

}  // namespace tcm_icp
