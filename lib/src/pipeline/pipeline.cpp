#include "tcm_icp/pipeline/pipeline.hpp"

#include <algorithm>
#include <string>

#include "core/memory_budget.hpp"
#include "pipeline/pipeline_input.hpp"
#include "pipeline/scan_checks.hpp"
#include "pipeline/scan_order.hpp"
#include "pipeline/scan_set.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

bool PipelineResult::all_registered() const {
  return std::none_of(poses.begin(), poses.end(),
                      [](const ScanPose& p) { return p.status == ScanStatus::kUnregistered; });
}

Eigen::Vector3d PipelineResult::local_origin(std::size_t scan) const {
  if (!has_frame_of_its_own(scan)) return local_origin();
  const auto is_its_reference = [&](const ScanPose& p) {
    return p.component == poses[scan].component && p.pose_in_component &&
           p.pose_in_component->matrix() == Eigen::Matrix4d::Identity();
  };
  const auto at = std::find_if(poses.begin(), poses.end(), is_its_reference);
  return at == poses.end() ? local_origin() : scans[static_cast<std::size_t>(at - poses.begin())].origin;
}

Pipeline::Pipeline(PipelineOptions options, std::shared_ptr<const StepStore> steps)
    : options_(std::move(options)), steps_(std::move(steps)) {
  options_.validate();
}

PipelineResult Pipeline::run(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                             const RunContext& context, const Survey& survey) const {
  return run(scans_in_files(paths), initial_poses, context, survey);
}

PipelineResult Pipeline::run(std::span<const ScanInput> inputs, const InitialPoses& initial_poses,
                             const RunContext& context, const Survey& survey) const {
  if (inputs.size() < 2) {
    throw InvalidOptions("registration needs at least two scans, not " + std::to_string(inputs.size()) +
                         "; name the files of all scans");
  }
  check_inputs(inputs, initial_poses);
  const std::size_t named = options_.reference.empty() ? 0 : find_scan(inputs, options_.reference);
  const bool paper = options_.profile == Profile::kPaper;
  check_survey(inputs, initial_poses, survey, paper);
  const PipelineOptions& options = options_;
  PipelineResult result;
  const MemoryBudget budget(context);
  StageClock clock(result.stages);
  clock.begin("read and sample");
  std::vector<SampledScan> sampled =
      read_scans(inputs, options, context, paper ? ScanDetail::kNormals : ScanDetail::kViewpointClues, steps_.get());
  // Who asks for the order of the list gets it, and so does the paper, whose reference is the middle one of equals.
  const bool as_listed = paper || options.merge_order == MergeOrder::kFile;
  const std::vector<std::size_t> order = as_listed ? order_of_list(inputs.size()) : order_by_content(sampled);
  refuse_twins(sampled);
  sampled = in_order(std::move(sampled), order);
  std::vector<std::string> files;
  for (const auto& s : sampled) {
    files.push_back(s.scan.file);
    result.scans.push_back(summarize(s));
  }
  result.warnings = warn_of_units(result.scans, context);
  const InitialPoses guesses = in_order(initial_poses, order);
  result.reference = static_cast<std::size_t>(std::find(order.begin(), order.end(), named) - order.begin());
  (paper ? run_paper_pipeline : run_robust_pipeline)(
      {sampled, files, guesses, survey, options, context, clock, steps_.get()}, result);
  clock.end();
  restore_order(order, result);
  if (const std::string said = budget.shortfall(); !said.empty()) {
    context.warn(said);
    result.warnings.push_back(said);
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) result.poses[i].unit = result.scans[i].unit;
  return result;
}

}  // namespace tcm_icp
