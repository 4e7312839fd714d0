#pragma once
// The links of a result as edges of a pose graph.

#include <optional>
#include <vector>

#include "tcm_icp/io/pose_export.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// The accepted links between registered scans. Their information is that of their strength, the identity where none
/// is known.
std::vector<PoseGraphEdge> pose_graph_edges(const PipelineResult& result);

/// Information of a link's relative pose, as PoseGraphEdge has it; nothing where no direction has a standard deviation.
/// @param T_common_to  pose of the link's second scan, in the frame of `strength`
std::optional<Eigen::Matrix<double, 6, 6>> edge_information(const LinkStrength& strength,
                                                            const Eigen::Isometry3d& T_common_to);

}  // namespace tcm_icp
