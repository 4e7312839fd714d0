#pragma once
// JSON of what both the report of a run and an inspection tell.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "tcm_icp/graph/correspondence_graph.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/pipeline/result_writer.hpp"

namespace tcm_icp {

using Json = nlohmann::ordered_json;

/// All of report.json, which report.html shows, too. File names may hold bytes that are not UTF-8.
Json report_object(const PipelineResult& result, const PipelineOptions& options, const RunContext& context,
                   const RunDescription& description);

/// null for NaN and infinity, which JSON does not know.
Json number(double value);

Json vector(const Eigen::Vector3d& v);
/// As it is written to a file; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const Json& json);

/// Rows first.
Json to_json(const Eigen::MatrixXd& matrix);

const char* name_of(OutlierMethod method);
const char* name_of(LpFormulation formulation);
const char* name_of(MergeOrder order);
Json to_json(const ScanSummary& scan);
Json to_json(const FreeSpaceEvidence& evidence);
Json to_json(const Viewpoint& viewpoint);
Json to_json(const LpFigures& lp);
Json to_json(const CorrespondenceGraph& graph, std::size_t reference, const std::vector<ScanSummary>& scans);

/// "residuals" of the run, of each scan and of each link. @param limit_m  what counts as within the limit; 0: none
void add_residuals(const PipelineResult& result, double limit_m, Json& report);
/// "acceptance" of the run, of each scan and of each link, where limits are given. After add_residuals().
void add_acceptance(const AcceptanceLimits& limits, bool is_reference_frame, Json& report);

/// Null where the scan has no pose in the common frame.
Json pose_json(const PipelineResult& result, std::size_t scan);
/// How well loops of three pairs close that were fitted each by itself; the worst are listed.
Json loops_json(const PipelineResult& result);

/// The joint adjustment and what limits its poses.
Json adjustment_json(const PipelineResult& result);
/// Null where no survey frame was asked for.
Json survey_json(const SurveyRecord& survey);
/// Null where the pose is not determined. `origin` is added to positions.
Json to_json(const PoseUncertainty& pose, const Eigen::Vector3d& origin);
Json to_json(const LinkStrength& strength, const Eigen::Vector3d& origin);

}  // namespace tcm_icp
