#pragma once
// TCM-ICP from files to poses: Algorithm 1 of the paper, one call a line.

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/steps/step_store.hpp"
#include "tcm_icp/survey/survey.hpp"

namespace tcm_icp {

class Pipeline {
 public:
  /// @param steps  keeps what is done on the way and has what was done before (robust profile); nullptr: nothing is
  /// kept
  /// @throws InvalidOptions
  explicit Pipeline(PipelineOptions options, std::shared_ptr<const StepStore> steps = nullptr);

  /// Registers the scans. Raw points stream by once; memory follows the working clouds.
  /// @param initial_poses  one a scan; a scan without one is found by its links, or taken as it lies (paper profile)
  /// @throws InputError, InvalidInput  a file that cannot be read, fewer than two scans, the same file twice,
  ///                                   fewer than three points or all points equal
  /// @param survey         what defines the common frame in place of the reference scan; robust profile only
  /// @throws InvalidOptions            a reference that is no scan, a fixed scan without an initial pose
  /// @throws Cancelled                 the context's on_progress asked for it
  PipelineResult run(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                     const RunContext& context, const Survey& survey = {}) const;

  /// The same of scans from any source.
  PipelineResult run(std::span<const ScanInput> inputs, const InitialPoses& initial_poses, const RunContext& context,
                     const Survey& survey = {}) const;

  const PipelineOptions& options() const { return options_; }

 private:
  PipelineOptions options_;
  std::shared_ptr<const StepStore> steps_;
};

}  // namespace tcm_icp
