#include "tcm_icp/pipeline/pipeline_options.hpp"

#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

template <typename T>
void require(bool ok, const char* rule, T value) {
  if (!ok) throw InvalidOptions(std::string(rule) + ", not " + std::to_string(value));
}

}  // namespace

void SamplingOptions::validate() const {
  require(max_working_points >= 1000, "sampling max_working_points must be at least 1000", max_working_points);
  require(coarse_voxels >= 100, "sampling coarse_voxels must be at least 100", coarse_voxels);
  require(fine_voxels >= coarse_voxels, "sampling fine_voxels must be at least coarse_voxels", fine_voxels);
  require(max_surface_variation >= 0 && max_surface_variation <= 1.0 / 3,
          "sampling max_surface_variation must be between 0 and 1/3", max_surface_variation);
}

void SampleSizes::validate() const {
  require(coarse_points >= 100, "samples coarse_points must be at least 100", coarse_points);
  require(fine_points >= 100, "samples fine_points must be at least 100", fine_points);
  require(held_out_points >= 100, "samples held_out_points must be at least 100", held_out_points);
}

void AdjustmentOptions::validate() const {
  require(lp_steps >= 0, "adjustment lp_steps must be at least 0", lp_steps);
  require(steps >= 0, "adjustment steps must be at least 0", steps);
}

void RefinementOptions::validate() const {
  require(points >= 20, "refinement points must be at least 20", points);
  require(descent_steps >= 1, "refinement descent_steps must be at least 1", descent_steps);
  require(annealing_steps >= 0, "refinement annealing_steps must be at least 0", annealing_steps);
  require(initial_temperature > 0, "refinement initial_temperature must be above 0", initial_temperature);
  require(final_temperature > 0 && final_temperature <= initial_temperature,
          "refinement final_temperature must be above 0 and at most initial_temperature", final_temperature);
}

void InferenceOptions::validate() const {
  require(log_poses > 0, "inference log_poses must be above 0", log_poses);
  require(log_implied >= 0 && log_implied <= log_poses, "inference log_implied must be between 0 and log_poses",
          log_implied);
  require(set_spread >= 0, "inference set_spread must be at least 0", set_spread);
  require(log_missed <= 0, "inference log_missed must be at most 0", log_missed);
  require(log_missed_there <= 0, "inference log_missed_there must be at most 0", log_missed_there);
  require(telling_overlap > 0, "inference telling_overlap must be positive", telling_overlap);
  require(firm_left >= 0 && firm_left <= 1, "inference firm_left must be between 0 and 1", firm_left);
  require(loose_left > firm_left, "inference loose_left must be above firm_left", loose_left);
  require(log_slid >= 0, "inference log_slid must be at least 0", log_slid);
  require(log_twins >= 0, "inference log_twins must be at least 0", log_twins);
  require(log_alike >= 0, "inference log_alike must be at least 0", log_alike);
  require(log_spread >= 0, "inference log_spread must be at least 0", log_spread);
  require(most_log_odds > 0, "inference most_log_odds must be above 0", most_log_odds);
  require(max_starts >= 1, "inference max_starts must be at least 1", max_starts);
  require(max_grown_scans >= 1, "inference max_grown_scans must be at least 1", max_grown_scans);
  require(max_sweeps >= 1, "inference max_sweeps must be at least 1", max_sweeps);
}

void PipelineOptions::validate() const {
  require(graph_threshold >= 0, "graph_threshold must be at least 0", graph_threshold);
  sampling.validate();
  outliers.validate();
  tcm.validate();
  lp.validate();
  samples.validate();
  adjustment.validate();
  refinement.validate();
  paper.validate();
  inference.validate();
  decision.validate();
}

MergeOptions PipelineOptions::merging() const {
  const bool is_paper = profile == Profile::kPaper;
  // A fit to what was merged before takes its error on, and a chain of them drifts; inferred poses are better to
  // adjust.
  const bool is_adjusted = adjustment.lp_steps + adjustment.steps > 0;
  const bool is_refined = refinement.method != Refinement::kAuto && refinement.method != Refinement::kNone;
  const bool fits = is_paper || is_refined || !is_adjusted;
  MergeOptions out{merge_order, is_paper, fits, tcm, formulation, lp, refinement, paper, 0};
  if (refinement.method == Refinement::kAuto) {
    out.refinement.method = is_paper ? Refinement::kDescentThenAnnealing : Refinement::kNone;
  }
  return out;
}

}  // namespace tcm_icp
