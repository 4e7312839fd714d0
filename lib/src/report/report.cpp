#include <algorithm>
#include <utility>

#include "io/scan_status.hpp"
#include "report_parts.hpp"

namespace tcm_icp {
namespace {

Json to_json(const RefinementTrace& t) {
  return {{"steps", t.num_steps},
          {"accepted_steps", t.num_accepted},
          {"initial_cost", number(t.initial_cost)},
          {"final_cost", number(t.final_cost)},
          {"initial_held_out_cost", number(t.initial_held_out_cost)},
          {"final_held_out_cost", number(t.final_held_out_cost)},
          {"kept", t.kept}};
}

Json to_json(const AlignmentEvidence& e) {
  return {{"points", e.num_points},
          {"overlap", e.overlap},
          {"inlier_share", e.inlier_share},
          {"median_residual_m", e.median_residual_m},
          {"tolerance_m", e.tolerance_m},
          {"slide_m", e.slide_m},
          {"left_after_slide", e.left_after_slide},
          {"across", e.num_across},
          {"left_across", e.left_across}};
}

Json to_json(const RegistrationResult& r) {
  return {{"termination", to_string(r.termination)},
          {"iterations", r.num_iterations},
          {"correspondences", r.num_correspondences},
          {"median_residual_m", number(r.median_residual_m)},
          {"lp", to_json(r.lp)}};
}

Json to_json(const MergeRecord& m, const PipelineResult& result) {
  Json j{
      {"scan", result.scans[m.scan].file},
      {"accepted", m.accepted},
      {"reason", m.reason},
      {"tcm", {{"tau", number(m.tcm.tau())}, {"f", number(m.tcm.f)}, {"g", number(m.tcm.g)}, {"h", number(m.tcm.h)}}},
      {"simplex", to_json(m.simplex)}};
  if (m.descent) j["descent"] = to_json(*m.descent);
  if (m.annealing) j["annealing"] = to_json(*m.annealing);
  const long long descent = m.descent ? m.descent->num_steps : 0, annealing = m.annealing ? m.annealing->num_steps : 0;
  j["iterations"] = {{"simplex_pivots", m.simplex.lp.num_pivots},
                     {"descent_steps", descent},
                     {"annealing_steps", annealing},
                     {"sum", m.simplex.lp.num_pivots + descent + annealing}};
  return j;
}

// What a conventional method found; its poses follow the pairs of the tree.
Json pairs_json(const PipelineResult& result) {
  Json pairs = Json::array();
  long long icp = 0, ransac = 0;
  for (std::size_t k = 0; k < result.pairs.size(); ++k) {
    const PairFit& p = result.pairs[k];
    const bool in_tree = std::find(result.pair_tree.begin(), result.pair_tree.end(), k) != result.pair_tree.end();
    icp += p.icp_iterations;
    ransac += p.ransac_iterations;
    pairs.push_back({{"source", result.scans[p.source].file},
                     {"target", result.scans[p.target].file},
                     {"in_tree", in_tree},
                     {"converged", p.converged},
                     {"mean_distance_m", number(p.mean_distance_m)},
                     {"share", p.share},
                     {"iterations", {{"icp", p.icp_iterations}, {"ransac", p.ransac_iterations}}}});
  }
  return {{"feature_voxel_m", result.feature_voxel_m > 0 ? Json(result.feature_voxel_m) : Json()},
          {"iterations", {{"icp", icp}, {"ransac", ransac}}},
          {"pairs", pairs}};
}

const char* name_of(Refinement method) {
  switch (method) {
    case Refinement::kDescent:
      return "descent";
    case Refinement::kAnnealing:
      return "annealing";
    case Refinement::kDescentThenAnnealing:
      return "both";
    default:
      return "none";
  }
}

// The words of the command line, in the order of the enumerations.
template <typename Enum, std::size_t N>
const char* word(Enum value, const char* const (&words)[N]) {
  return words[static_cast<std::size_t>(value)];
}

Json paper_options_json(const PaperOptions& o) {
  return {{"matches", word(o.matches, {"nearest", "threshold", "mutual"})},
          {"kept_share", o.kept_share},
          {"slack", word(o.slack, {"both", "above", "below", "between"})},
          {"unknowns", word(o.unknowns, {"entries", "twist"})},
          {"points", word(o.points, {"sample", "all"})},
          {"rounds", o.max_rounds},
          {"end", word(o.end, {"motion", "slack"})},
          {"descent", word(o.descent, {"scans", "matches"})},
          {"marginal", o.marginal_share}};
}

Json options_json(const PipelineOptions& o, const RunContext& context) {
  Json options{
      {"profile", o.profile == Profile::kPaper ? "paper" : "robust"},
      {"solver", to_string(o.lp.lp.solver)},
      {"lp_formulation", name_of(o.formulation)},
      {"merge_order", name_of(o.merge_order)},
      {"without", word(o.without, {"nothing", "features", "slides", "implied", "free-space", "twins", "constant"})},
      {"reference", o.reference},
      {"graph_threshold", o.graph_threshold},
      {"level", o.level},
      {"outliers", name_of(o.outliers.method)},
      {"max_working_points", o.sampling.max_working_points},
      {"coarse_voxels", o.sampling.coarse_voxels},
      {"fine_voxels", o.sampling.fine_voxels},
      {"coarse_points", o.samples.coarse_points},
      {"fine_points", o.samples.fine_points},
      {"held_out_points", o.samples.held_out_points},
      {"adjustment_lp_steps", o.adjustment.lp_steps},
      {"adjustment_steps", o.adjustment.steps},
      {"adjustment_bending", o.adjustment.bending},
      {"confidence", o.decision.confidence},
      {"refinement", name_of(o.merging().refinement.method)},
      {"descent_steps", o.refinement.descent_steps},
      {"annealing_steps", o.refinement.annealing_steps},
      {"seed", context.seed},
      {"threads", context.num_threads},
      {"memory_limit_mb", context.memory_limit >> 20}};
  if (o.profile == Profile::kPaper) options["paper"] = paper_options_json(o.paper);
  return options;
}

// What was measured of a scan's place, and what was made of it.
Json decision_json(const PipelineResult& result, std::size_t scan) {
  const Decision& d = result.decisions[scan];
  Json j{{"reason", to_string(d.reason)}, {"probability", d.probability}};
  const auto& m = result.measurements[scan];
  if (!m) return j;
  j["lead"] = number(m->lead);
  j["support"] = number(m->support);
  j["other_place_m"] = m->other_distance ? number(*m->other_distance) : Json(nullptr);
  j["moves_with"] = m->num_moved - 1;
  j["features"] = d.features;
  return j;
}

Json project_json(const ReportOptions& o) {
  const auto told = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
  return {{"project", told(o.project)},
          {"client", told(o.client)},
          {"instrument", told(o.instrument)},
          {"operator", told(o.surveyor)}};
}

// Where the scan's middle lies in the frame of its component; null where no pose tells.
Json middle_json(const ScanPose& pose, const ScanSummary& scan) {
  const Eigen::Vector3d raw = scan.origin + scan.middle;
  if (pose.status != ScanStatus::kUnregistered) return vector(pose.T_reference_scan * raw);
  return pose.pose_in_component ? vector(*pose.pose_in_component * raw) : Json(nullptr);
}

}  // namespace

Json report_object(const PipelineResult& result, const PipelineOptions& options, const RunContext& context,
                   const RunDescription& description) {
  Json report{{"schema", 1},
              {"program", "tcm-icp"},
              {"version", description.version},
              {"command_line", description.command_line},
              {"started", description.started.empty() ? Json(nullptr) : Json(description.started)},
              {"initial_poses", description.initial_poses.empty() ? Json(nullptr) : Json(description.initial_poses)},
              {"method", result.method},
              {"options", options_json(options, context)},
              {"coarse_voxel_m", result.coarse_voxel_m},
              {"fine_voxel_m", result.fine_voxel_m},
              {"set_log_odds", result.set_log_odds},
              {"later_log_odds", result.later_log_odds},
              {"later_factor", result.later_factor},
              {"warnings", result.warnings},
              {"project", project_json(description.report)}};
  const Eigen::Vector3d origin = result.local_origin();
  for (const auto& s : result.scans) report["scans"].push_back(to_json(s));
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    report["scans"][i]["status"] = to_string(result.poses[i].status);
    report["scans"][i]["verdict"] = to_string(result.poses[i].verdict);
    report["scans"][i]["reason"] = result.poses[i].reason;
    report["scans"][i]["component"] = result.poses[i].component;
    report["scans"][i]["pose"] = pose_json(result, i);
    report["scans"][i]["middle_m"] = middle_json(result.poses[i], result.scans[i]);
    report["scans"][i]["evidence"] = result.evidence[i] ? to_json(*result.evidence[i]) : Json(nullptr);
    if (!result.measurements.empty()) {
      report["scans"][i]["decision"] = decision_json(result, i);
    }
    if (!result.viewpoints.empty()) {
      report["scans"][i]["viewpoint"] = result.viewpoints[i] ? to_json(*result.viewpoints[i]) : Json(nullptr);
      report["scans"][i]["free_space"] = to_json(result.free_space[i]);
    }
    if (!result.uncertainty.poses.empty()) {
      report["scans"][i]["uncertainty"] = to_json(result.uncertainty.poses[i], origin);
    }
  }
  report["graph"] = to_json(result.graph, result.reference, result.scans);
  if (result.method != "tcm") report["conventional"] = pairs_json(result);
  report["merges"] = Json::array();
  for (const auto& m : result.merges) report["merges"].push_back(to_json(m, result));
  report["adjustment"] = adjustment_json(result);
  if (Json survey = survey_json(result.survey); !survey.is_null()) report["survey"] = std::move(survey);
  report["links"] = Json::array();
  for (const auto& l : result.links) {
    report["links"].push_back({{"a", result.scans[l.a].file},
                               {"b", result.scans[l.b].file},
                               {"verdict", to_string(l.verdict)},
                               {"probability", l.probability},
                               {"reason", l.reason},
                               {"evidence", to_json(l.evidence)},
                               {"free_space", to_json(l.free_space)}});
    if (l.strength) report["links"].back()["strength"] = to_json(*l.strength, result.local_origin(l.a));
  }
  add_residuals(result, description.report.accept.residual_m, report);
  add_acceptance(description.report.accept, !result.survey.has_frame, report);
  report["misclosures"] = loops_json(result);
  report["hypotheses"] = Json::array();
  for (const auto& h : result.hypotheses) {
    Json entry{{"a", result.scans[h.a].file},
               {"b", result.scans[h.b].file},
               {"pose_of_b_in_a", to_json(Eigen::MatrixXd(h.T_a_b.matrix()))},
               {"method", to_string(h.candidate.method)},
               {"coarse_score", number(h.candidate.score)},
               {"coarse_margin", number(h.candidate.margin)},
               {"later", h.is_later},
               {"log_odds", h.log_odds},
               {"fate", to_string(h.status)},
               {"features", h.features},
               {"evidence", to_json(h.evidence)},
               {"free_space", to_json(h.free_space)}};
    if (h.by_survey != 0) entry["by_survey"] = h.by_survey;
    if (h.candidate.method == CoarseMethod::kImplied) {
      entry["asked_at"] = to_json(Eigen::MatrixXd(h.candidate.T_target_source.matrix()));
    }
    report["hypotheses"].push_back(std::move(entry));
  }
  for (const auto& s : result.stages) {
    report["stages"].push_back({{"name", s.name}, {"seconds", s.seconds}, {"peak_memory_mb", s.peak_memory_mb}});
  }
  return report;
}

std::string report_json(const PipelineResult& result, const PipelineOptions& options, const RunContext& context,
                        const RunDescription& description) {
  return json_text(report_object(result, options, context, description));
}

}  // namespace tcm_icp
