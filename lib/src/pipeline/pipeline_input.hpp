#pragma once
// What both profiles start from: the scans as read, in an order that comes from what they hold.

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "pipeline/stage_clock.hpp"
#include "scans/scan_sampling.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

struct PipelineInput {
  std::vector<SampledScan>& sampled;  ///< working clouds are given up on the way
  const std::vector<std::string>& files;
  const InitialPoses& initial_poses;  ///< for raw coordinates
  const Survey& survey;
  const PipelineOptions& options;
  const RunContext& context;
  StageClock& clock;
  const StepStore* steps = nullptr;  ///< nullptr: nothing is kept
};

/// Algorithm 1 of the paper, to the letter. Fills in all but scans and stages.
void run_paper_pipeline(const PipelineInput& input, PipelineResult& result);

/// Compared without a guess, inferred, merged, adjusted, decided. Fills in all but scans and stages.
void run_robust_pipeline(const PipelineInput& input, PipelineResult& result);

/// A pose between two scans' local frames, for their raw coordinates.
inline Eigen::Isometry3d for_raw_coordinates(const Eigen::Isometry3d& T_target_source, const Scan& target,
                                             const Scan& source) {
  return Eigen::Translation3d(target.origin) * T_target_source * Eigen::Translation3d(-source.origin);
}

}  // namespace tcm_icp
