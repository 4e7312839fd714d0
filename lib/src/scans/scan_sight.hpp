#pragma once
// Where the scans of a set were taken from, and what that says of poses.

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "scans/prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/steps/step_store.hpp"
#include "tcm_icp/visibility/free_space.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// Where a scan was taken from, in its local frame. Cost: 20 to 180 ms.
std::optional<Viewpoint> find_viewpoint_of(const SampledScan& scan, std::uint64_t seed);

/// The same of each scan; while the working clouds are there. By scan lines, else by density, else by what hides:
/// then the origin of the file is one of the places to start from, since a raw scan's origin is its scanner. Reports
/// "finding viewpoints". @param steps  keeps them, where there is a work folder
/// @throws Cancelled
std::vector<std::optional<Viewpoint>> find_viewpoints(const std::vector<SampledScan>& scans, const RunContext& context,
                                                      const StepStore* steps = nullptr);

/// Gives the prepared scans their sight.
void make_sights(const std::vector<std::optional<Viewpoint>>& viewpoints, const RunContext& context,
                 std::vector<PreparedScan>& scans);

/// measure_free_space() of a pair. Counts are 0 where neither has a viewpoint.
FreeSpaceEvidence free_space(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b);

/// measure_violations() of a pair.
FreeSpaceEvidence violations(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b);

}  // namespace tcm_icp
