#include "evaluation_report.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {
namespace {

using Json = nlohmann::ordered_json;

[[gnu::format(printf, 2, 3)]] void print(std::ostream& out, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out << line;
}

int name_width(const Truth& truth) {
  std::size_t width = 4;
  for (const auto& scan : truth.scans) width = std::max(width, scan.file.size());
  return static_cast<int>(std::min<std::size_t>(width, 100));
}

void print_error(const std::optional<PoseError>& error, std::ostream& out) {
  if (error) print(out, "  %14.4f  %15.4f  %10.4f", error->rotation_deg, error->translation_m, error->rmse_m);
}

void print_scans(const Evaluation& e, std::ostream& out) {
  const int w = name_width(e.truth);
  print(out, "%-*s  %-7s  %14s  %15s  %10s\n", w, "scan", "verdict", "rotation [deg]", "translation [m]", "rmse [m]");
  for (std::size_t i = 0; i < e.score.scans.size(); ++i) {
    const ScanScore& s = e.score.scans[i];
    print(out, "%-*s  %-7s", w, s.file.c_str(), to_string(s.verdict).c_str());
    print_error(s.error, out);
    out << (i == e.score.reference ? "  reference\n" : "\n");
  }
}

void print_pairs(const Evaluation& e, std::ostream& out) {
  const int w = 2 * name_width(e.truth) + 1;
  print(out, "\n%-*s  %-7s  %14s  %15s  %10s  %7s\n", w, "pair", "verdict", "rotation [deg]", "translation [m]",
        "rmse [m]", "overlap");
  for (const PairScore& pair : e.score.pairs) {
    const std::string names = e.truth.scans[pair.a].file + " " + e.truth.scans[pair.b].file;
    print(out, "%-*s  %-7s", w, names.c_str(), pair.is_ok ? "ok" : pair.error ? "WRONG" : "flagged");
    if (pair.error)
      print_error(pair.error, out);
    else
      print(out, "  %14s  %15s  %10s", "", "", "");
    if (!std::isnan(pair.overlap)) print(out, "  %7.2f", pair.overlap);
    out << '\n';
  }
  out << '\n';
}

void print_totals(const Evaluation& e, std::ostream& out) {
  const SceneScore& s = e.score;
  const Tolerance& tolerance = e.truth.tolerance;
  out << s.count(PoseVerdict::kOk) << "/" << s.scans.size() << " scans ok, " << s.count(PoseVerdict::kFlagged)
      << " flagged, " << s.count(PoseVerdict::kWrong) << " WRONG; pairs " << s.num_pairs_ok << "/" << s.num_pairs
      << "; tolerance " << tolerance.rotation_deg << " deg, " << tolerance.rmse_m << " m\n";
  if (s.num_pairs > 0)
    print(out, "registration recall %.3f: pairs of true overlap %g or more, within %g deg and %g m\n", s.recall(),
          e.min_overlap, tolerance.rotation_deg, tolerance.rmse_m);
  if (s.median)
    print(out, "median rotation %.4f deg, median translation %.4f m, median rmse %.4f m, largest rmse %.4f m\n",
          s.median->rotation_deg, s.median->translation_m, s.median->rmse_m, *s.max_rmse_m);
  const CloudComparison& c = e.clouds;
  print(out, "RMS of %zu points %.4f m\n", c.num_points, c.rms_m);
  print(out, "cloud to cloud, registered to truth: mean %.4f m, standard deviation %.4f m (%zu points to %zu)\n",
        c.registered_to_truth.mean_m, c.registered_to_truth.std_dev_m, c.registered_to_truth.num_points,
        c.truth_to_registered.num_points);
  print(out, "Hausdorff distance: registered to truth %.4f m, truth to registered %.4f m, symmetric %.4f m\n",
        c.registered_to_truth.max_m, c.truth_to_registered.max_m, c.hausdorff_m());
}

Json error_json(const std::optional<PoseError>& error, Json entry) {
  entry["rotation_deg"] = error ? Json(error->rotation_deg) : Json();
  entry["translation"] = error ? Json(error->translation_m) : Json();
  entry["rmse"] = error ? Json(error->rmse_m) : Json();
  return entry;
}

Json distance_json(const DirectedDistance& d) {
  return {{"points", d.num_points}, {"mean", d.mean_m}, {"standard_deviation", d.std_dev_m}, {"hausdorff", d.max_m}};
}

Json to_json(const Evaluation& e) {
  const SceneScore& score = e.score;
  Json scans = Json::array(), pairs = Json::array();
  for (const auto& s : score.scans) {
    scans.push_back(error_json(s.error, {{"file", s.file}, {"verdict", to_string(s.verdict)}}));
  }
  for (const auto& p : score.pairs) {
    const Json who{
        {"a", e.truth.scans[p.a].file}, {"b", e.truth.scans[p.b].file}, {"overlap", p.overlap}, {"ok", p.is_ok}};
    pairs.push_back(error_json(p.error, who));
  }
  return {{"scans", scans},
          {"pair_list", pairs},
          {"reference", score.scans[score.reference].file},
          {"ok", score.count(PoseVerdict::kOk)},
          {"flagged", score.count(PoseVerdict::kFlagged)},
          {"wrong", score.count(PoseVerdict::kWrong)},
          {"pairs", score.num_pairs},
          {"pairs_ok", score.num_pairs_ok},
          {"registration_recall", score.recall()},
          {"min_overlap", e.min_overlap},
          {"tolerance", {{"rotation_deg", e.truth.tolerance.rotation_deg}, {"rmse_m", e.truth.tolerance.rmse_m}}},
          {"median_rotation_deg", score.median ? Json(score.median->rotation_deg) : Json()},
          {"median_translation", score.median ? Json(score.median->translation_m) : Json()},
          {"median_rmse", score.median ? Json(score.median->rmse_m) : Json()},
          {"max_rmse", score.max_rmse_m ? Json(*score.max_rmse_m) : Json()},
          {"seed", e.seed},
          {"rms", {{"points", e.clouds.num_points}, {"rms", e.clouds.rms_m}}},
          {"registered_to_truth", distance_json(e.clouds.registered_to_truth)},
          {"truth_to_registered", distance_json(e.clouds.truth_to_registered)},
          {"hausdorff", e.clouds.hausdorff_m()}};
}

}  // namespace

void print_evaluation(const Evaluation& evaluation, std::ostream& out) {
  print_scans(evaluation, out);
  print_pairs(evaluation, out);
  print_totals(evaluation, out);
}

void write_evaluation(const Evaluation& evaluation, const std::filesystem::path& path) {
  std::ofstream out(path, std::ios::binary);
  out << to_json(evaluation).dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
  out.close();
  if (!out) throw OutputError(path, "cannot be written", "check the folder, its permissions and free space");
}

}  // namespace tcm_icp::app
