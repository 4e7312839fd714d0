#include "tcm_icp/pipeline/pair_pipeline.hpp"

#include <algorithm>
#include <limits>

#include "pipeline/scan_checks.hpp"
#include "pipeline/scan_set.hpp"
#include "pipeline/stage_clock.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/baselines/spanning_tree.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

PairInput pair_input(const std::vector<SampledScan>& scans, const InitialPoses& initial_poses, double voxel_m) {
  PairInput input;
  input.voxel_size_m = voxel_m;
  input.T_init = initial_local_poses(initial_poses, scans, false);
  std::vector<double> spacings;
  for (const auto& s : scans) {
    input.scans.push_back(voxel_downsample({s.scan.cloud.points, {}}, voxel_m).points);
    spacings.push_back(s.scan.spacing_m);
  }
  input.spacing_m = median(spacings);
  return input;
}

// The graph of the report: the tree's pairs are its edges, 1 - share its measure.
CorrespondenceGraph tree_graph(std::size_t n, const PairFits& fits, const std::vector<std::size_t>& tree) {
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd measure = Eigen::MatrixXd::Constant(size, size, std::numeric_limits<double>::infinity());
  for (const std::size_t k : tree) {
    const auto a = static_cast<Eigen::Index>(fits.pairs[k].source), b = static_cast<Eigen::Index>(fits.pairs[k].target);
    measure(a, b) = measure(b, a) = 1 - fits.pairs[k].share;
  }
  return build_correspondence_graph(measure, std::numeric_limits<double>::max());
}

// Whether each scan's own pair in the tree converged: the one that leads to the reference.
std::vector<bool> converged_on_the_way(std::size_t n, const PairFits& fits, const std::vector<std::size_t>& tree,
                                       std::size_t reference) {
  std::vector<bool> reached(n, false), converged(n, false);
  reached[reference] = converged[reference] = true;
  for (std::size_t round = 0; round < n; ++round) {
    for (const std::size_t k : tree) {
      const auto [a, b] = std::pair(fits.pairs[k].source, fits.pairs[k].target);
      if (reached[a] == reached[b]) continue;
      const std::size_t from = reached[a] ? a : b, to = reached[a] ? b : a;
      reached[to] = true;
      converged[to] = converged[from] && fits.pairs[k].converged;
    }
  }
  return converged;
}

ScanPose scan_pose(const std::vector<SampledScan>& scans, std::size_t i, std::size_t reference,
                   const std::optional<Eigen::Isometry3d>& T_reference_scan, bool converged,
                   const std::string& method) {
  ScanPose pose;
  pose.file = scans[i].scan.file;
  if (i == reference) {
    pose.status = ScanStatus::kReference;
    pose.verdict = Verdict::kAccepted;
    pose.reason = "the reference";
    return pose;
  }
  pose.status = ScanStatus::kRegistered;
  pose.verdict = Verdict::kDoubtful;
  pose.reason = "merged by " + method +
                (converged ? ", which does not verify" : ", which did not converge on the way to the reference");
  // Every pair was fitted, so the tree reaches every scan. Raw coordinates: both local origins are put back.
  pose.T_reference_scan = Eigen::Translation3d(scans[reference].scan.origin) * T_reference_scan.value() *
                          Eigen::Translation3d(-scans[i].scan.origin);
  return pose;
}

PipelineResult run_pairs(std::span<const ScanInput> inputs, const InitialPoses& initial_poses,
                         const PipelineOptions& options, const RunContext& context, const std::string& name,
                         const PairMethod& method) {
  PipelineResult result;
  result.method = name;
  const std::size_t n = inputs.size();
  if (!options.reference.empty()) result.reference = find_scan(inputs, options.reference);
  StageClock clock(result.stages);
  clock.begin("read and sample");
  std::vector<SampledScan> scans = read_scans(inputs, options, context, ScanDetail::kPoints);
  refuse_twins(scans);
  for (const auto& s : scans) result.scans.push_back(summarize(s));
  result.warnings = warn_of_units(result.scans, context);
  clock.begin("prepare");
  result.coarse_voxel_m = result.fine_voxel_m = choose_resolutions(scans, options.sampling, context.num_threads).fine_m;
  const PairInput input = pair_input(scans, initial_poses, result.coarse_voxel_m);
  clock.begin("align pairs");
  PairFits fits = method(input, context);
  clock.begin("merge");
  const auto tree = maximum_spanning_tree(n, fits.pairs);
  if (options.reference.empty()) result.reference = tree_reference(n, fits.pairs, tree);
  const auto poses = poses_along_tree(n, fits.pairs, tree, result.reference);
  const auto converged = converged_on_the_way(n, fits, tree, result.reference);
  result.graph = tree_graph(n, fits, tree);
  result.graph.reference = result.reference;
  for (std::size_t i = 0; i < n; ++i) {
    result.poses.push_back(scan_pose(scans, i, result.reference, poses[i], converged[i], name));
    result.poses[i].unit = result.scans[i].unit;
  }
  result.evidence.assign(n, std::nullopt);
  result.pairs = std::move(fits.pairs);
  result.pair_tree = tree;
  result.feature_voxel_m = fits.feature_voxel_m;
  clock.end();
  return result;
}

}  // namespace

PipelineResult register_by_pairs(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                                 const PipelineOptions& options, const RunContext& context, const std::string& name,
                                 const PairMethod& method) {
  options.validate();
  const std::vector<ScanInput> inputs = scans_in_files(paths);
  check_inputs(inputs, initial_poses);
  return run_pairs(inputs, initial_poses, options, context, name, method);
}

}  // namespace tcm_icp
