#pragma once
// The components of a run put into the survey frame.

#include <optional>
#include <vector>

#include "pipeline/pipeline_input.hpp"
#include "pipeline/settled_component.hpp"
#include "survey/survey_evidence.hpp"

namespace tcm_icp {

struct SurveyPlacement {
  /// For raw coordinates, of every scan that is in the survey frame; empty where the frame is the reference scan's.
  InitialPoses T_survey_scan;
  std::vector<bool> is_confirmed;  ///< of each: links, or redundant control points, agree with that pose
  std::vector<std::optional<double>> sigma_in_voxels;  ///< of each: sigma_in_voxels()
};

/// What is known of each scan, for poses of pairs between local frames; nothing where that is nothing.
/// @param voxel_m  coarse: how good poses of pairs are
SurveyEvidence survey_evidence(const PipelineInput& input, const std::vector<PreparedScan>& scans, double voxel_m);

/// Adjusts each component to the control points, positions and fixed scans among its members, and so each scan that is
/// in none. The first component defines the frame as well as its observations do; others, and single scans, follow
/// where theirs leave no direction free. Fills in result.survey, the uncertainties and the strengths of links of what
/// was placed, and warns of blunders.
/// @param settled  the component of the reference first
SurveyPlacement fit_to_survey(const PipelineInput& input, const std::vector<PreparedScan>& scans,
                              const Resolutions& resolutions, const std::vector<SettledComponent>& settled,
                              PipelineResult& result);

}  // namespace tcm_icp
