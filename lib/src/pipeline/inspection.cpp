#include "tcm_icp/pipeline/inspection.hpp"

#include <limits>

#include "pipeline/scan_checks.hpp"
#include "pipeline/scan_set.hpp"
#include "report/report_parts.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

Eigen::AlignedBox3d raw_box(const Scan& scan) {
  Eigen::AlignedBox3d box;
  for (const auto& p : scan.cloud.points) box.extend(p + scan.origin);
  return box;
}

// tau of every pair, of the same clouds that merging measures; `measure(i, j, T_i_j)` gives one.
template <typename Measure>
Eigen::MatrixXd all_pairs(const std::vector<Eigen::Isometry3d>& T_common_local, const RunContext& context,
                          const Measure& measure) {
  const std::size_t n = T_common_local.size();
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd tau = Eigen::MatrixXd::Constant(size, size, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i) {
    context.report("measuring", i, n);
    parallel_for(context.num_threads, n - i - 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = i + 1 + begin; j < i + 1 + end; ++j) {
        const Eigen::Isometry3d T_i_j = T_common_local[i].inverse() * T_common_local[j];
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        tau(row, column) = tau(column, row) = measure(i, j, T_i_j).tau();
      }
    });
  }
  return tau;
}

Eigen::MatrixXd paper_tcm(const std::vector<PreparedScan>& scans, const std::vector<Eigen::Isometry3d>& T_common_local,
                          const RunContext& context) {
  std::vector<TcmCloud> clouds;
  for (const auto& scan : scans) clouds.emplace_back(scan.pyramid.level(0).cloud.points);
  return all_pairs(T_common_local, context, [&](std::size_t i, std::size_t j, const Eigen::Isometry3d& T_i_j) {
    return tcm_terms(clouds[i], clouds[j], T_i_j);
  });
}

Eigen::MatrixXd robust_tcm(const std::vector<PreparedScan>& scans, const std::vector<Eigen::Isometry3d>& T_common_local,
                           const RobustTcmOptions& options, const RunContext& context) {
  std::vector<RobustTcmCloud> clouds;
  for (const auto& scan : scans) clouds.emplace_back(scan.pyramid.level(1).cloud.points, options);
  return all_pairs(T_common_local, context, [&](std::size_t i, std::size_t j, const Eigen::Isometry3d& T_i_j) {
    return robust_tcm_terms(clouds[i], clouds[j], T_i_j);
  });
}

Json corner(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

Inspection inspect_scans(const std::vector<std::filesystem::path>& paths, const InitialPoses& initial_poses,
                         const PipelineOptions& options, const RunContext& context) {
  options.validate();
  if (paths.empty()) throw InvalidOptions("there is no scan to inspect; name at least one file");
  const std::vector<ScanInput> inputs = scans_in_files(paths);
  check_inputs(inputs, initial_poses);
  Inspection out;
  std::vector<SampledScan> sampled = read_scans(inputs, options, context, ScanDetail::kNormals);
  for (const auto& s : sampled) {
    out.scans.push_back(summarize(s));
    out.boxes_m.push_back(raw_box(s.scan));
  }
  for (const auto& [copy, original] : find_twins(sampled)) {
    context.warn(copy + " has the same points as " + original + "; register refuses such copies");
  }
  warn_of_units(out.scans, context);
  if (paths.size() < 2) return out;

  const Resolutions resolutions = choose_resolutions(sampled, options.sampling, context.num_threads);
  const auto T_common_local = values_of(initial_local_poses(initial_poses, sampled, true));
  const auto scans = prepare_scans(sampled, resolutions, options.samples, context);
  ScanComparison& comparison = out.comparison.emplace();
  comparison.coarse_voxel_m = resolutions.coarse_m;
  comparison.graph = compare_scans(scans, T_common_local, options, context);
  comparison.paper_tcm_m4 = paper_tcm(scans, T_common_local, context);
  comparison.robust_tcm_m2 = robust_tcm(scans, T_common_local, options.tcm, context);
  return out;
}

std::string inspection_json(const Inspection& inspection, const PipelineOptions& options, const RunContext& context,
                            const RunDescription& description) {
  Json json{{"schema", 1},
            {"program", "tcm-icp"},
            {"version", description.version},
            {"command_line", description.command_line},
            {"initial_poses", description.initial_poses.empty() ? Json(nullptr) : Json(description.initial_poses)},
            {"profile", options.profile == Profile::kPaper ? "paper" : "robust"},
            {"seed", context.seed}};
  for (std::size_t i = 0; i < inspection.scans.size(); ++i) {
    Json scan = to_json(inspection.scans[i]);
    scan["box_min_m"] = corner(inspection.boxes_m[i].min());
    scan["box_max_m"] = corner(inspection.boxes_m[i].max());
    json["scans"].push_back(scan);
  }
  json["coarse_voxel_m"] = json["tcm"] = json["graph"] = nullptr;
  if (const auto& c = inspection.comparison) {
    json["coarse_voxel_m"] = c->coarse_voxel_m;
    json["tcm"] = {{"paper_m4", to_json(c->paper_tcm_m4)}, {"robust_m2", to_json(c->robust_tcm_m2)}};
    json["graph"] = to_json(c->graph, c->graph.reference, inspection.scans);
  }
  return json_text(json);
}

}  // namespace tcm_icp
