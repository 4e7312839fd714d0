#pragma once
// The pairs that a registration begins with, as blocks for any number of machines.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// Of height maps (CorrelationGrid).
struct PlannedGrid {
  double cell_m = 0;
  int size = 0;
};

struct PlannedPair {
  std::size_t a = 0, b = 0;  ///< places in MatchPlan::scans
  PlannedGrid screening, full;
};

/// All that a block needs to know of its set.
struct MatchPlan {
  std::string program;             ///< that made it: others give other bits
  std::string options;             ///< digest of those that count
  std::vector<std::string> scans;  ///< digests of the samples
  double coarse_m = 0, fine_m = 0;
  std::vector<PlannedPair> pairs;  ///< neighbours have scans in common
};

/// Samples one scan, and finds out where it was taken from, unless the work folder has that already.
/// @return  the digest of the sample
/// @throws InputError, InvalidInput, OutputError
std::string sample_into(const StepStore& steps, const ScanInput& scan, const PipelineOptions& options,
                        const RunContext& context);

/// Ranks the partners of every scan and plans the first pairs; samples are made where they are missing. Memory is that
/// of a registration. @throws as Pipeline::run()
MatchPlan plan_matches(const StepStore& steps, std::span<const ScanInput> scans, const PipelineOptions& options,
                       const RunContext& context);

/// Searches and fits the pairs of block `k` of `num_blocks`, k = 1, ..., num_blocks; memory is that of their scans.
/// @return  how many pairs these are
/// @throws InvalidOptions  a plan of another program or of other options, no such block
/// @throws InvalidInput    a sample that the plan names is not in the work folder
std::size_t match_block(const StepStore& steps, const MatchPlan& plan, std::size_t k, std::size_t num_blocks,
                        const PipelineOptions& options, const RunContext& context);

/// The plan in the work folder: plan.json. @throws OutputError
void write_plan(const StepStore& steps, const MatchPlan& plan);
/// @throws InputError  there is none, or it is damaged
MatchPlan read_plan(const StepStore& steps);

}  // namespace tcm_icp
