// tcm-icp evaluate: errors of poses against ground truth.

#include <boost/program_options.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "option_binding.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/evaluation/metrics.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp::app {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

struct Request {
  std::string scans, poses, truth, json;
  ScoreOptions options;
};

po::options_description describe(Request& r) {
  po::options_description what("Options", 110);
  what.add_options()("scans", po::value(&r.scans)->required(), "folder of the scans the poses belong to")  //
      ("poses", po::value(&r.poses)->required(), "poses.json of 'tcm-icp register'")                       //
      ("truth", po::value(&r.truth)->required(), "truth.json of the scene")                                //
      ("json", po::value(&r.json), "write the figures here as well")                                       //
      ("min-overlap", bind_option(&r.options.min_overlap),
       "true overlap (0..1) from which a pair counts for pair recall")  //
      ("help,h", "this text");
  return what;
}

/// Every k-th finite point, so that at most about 50,000 are left: their error is that of all of them to its printed
/// digits. Two passes, since k depends on how many there are.
Points thinned_points(const fs::path& path) {
  constexpr std::uint64_t kAtMost = 50000;
  PointBlock block;
  ScanReader counter(path, ReadAttributes::kNo);
  while (counter.read(block)) continue;
  const std::uint64_t step = std::max<std::uint64_t>(1, counter.num_points() / kAtMost);
  Points points;
  std::uint64_t index = 0;
  ScanReader reader(path, ReadAttributes::kNo);
  while (reader.read(block)) {
    for (const auto& p : block.points) {
      if (index++ % step == 0) points.push_back(p);
    }
  }
  if (points.empty()) throw InputError(path, "", "has no finite point", "evaluate scans that have points");
  return points;
}

struct Estimates {
  std::vector<std::optional<Eigen::Isometry3d>> poses;  ///< in the order of the truth
  std::size_t reference = 0;
};

Estimates match(const Truth& truth, const PoseFile& file, const fs::path& path) {
  std::map<std::string, const ScanPose*> by_name;
  for (const auto& scan : file.scans) by_name[fs::path(scan.file).filename()] = &scan;
  Estimates out;
  std::optional<std::size_t> reference;
  for (const auto& scan : truth.scans) {
    const auto at = by_name.find(scan.file);
    if (at == by_name.end()) {
      throw InputError(path, "", "has no entry for " + scan.file, "give the poses of all scans of the truth");
    }
    const bool placed = at->second->status != ScanStatus::kUnregistered;
    if (placed && scan.file == fs::path(file.reference).filename()) reference = out.poses.size();
    out.poses.push_back(placed ? std::optional(at->second->T_reference_scan) : std::nullopt);
  }
  if (!reference) {
    throw InputError(path, "", "its reference '" + file.reference + "' has no pose, or is not in the truth", "");
  }
  out.reference = *reference;
  return out;
}

void print_table(const Truth& truth, const SceneScore& score, std::ostream& out) {
  char line[256];
  std::size_t width = 4;
  for (const auto& scan : score.scans) width = std::max(width, scan.file.size());
  const int w = static_cast<int>(std::min<std::size_t>(width, 100));
  std::snprintf(line, sizeof line, "%-*s  %-7s  %14s  %10s\n", w, "scan", "verdict", "rotation [deg]", "rmse [m]");
  out << line;
  for (std::size_t i = 0; i < score.scans.size(); ++i) {
    const ScanScore& s = score.scans[i];
    std::snprintf(line, sizeof line, "%-*s  %-7s", w, s.file.c_str(), to_string(s.verdict).c_str());
    out << line;
    if (s.error) {
      std::snprintf(line, sizeof line, "  %14.4f  %10.4f", s.error->rotation_deg, s.error->rmse_m);
      out << line;
    }
    out << (i == score.reference ? "  reference\n" : "\n");
  }
  out << score.count(PoseVerdict::kOk) << "/" << score.scans.size() << " scans ok, "
      << score.count(PoseVerdict::kFlagged) << " flagged, " << score.count(PoseVerdict::kWrong) << " WRONG; pairs "
      << score.num_pairs_ok << "/" << score.num_pairs << "; tolerance " << truth.tolerance.rotation_deg << " deg, "
      << truth.tolerance.rmse_m << " m\n";
  if (!score.median) return;
  std::snprintf(line, sizeof line, "median rotation %.4f deg, median rmse %.4f m, largest rmse %.4f m\n",
                score.median->rotation_deg, score.median->rmse_m, *score.max_rmse_m);
  out << line;
}

nlohmann::ordered_json to_json(const Truth& truth, const SceneScore& score) {
  using Json = nlohmann::ordered_json;
  Json scans = Json::array();
  for (const auto& s : score.scans) {
    Json entry{{"file", s.file}, {"verdict", to_string(s.verdict)}};
    entry["rotation_deg"] = s.error ? Json(s.error->rotation_deg) : Json();
    entry["rmse"] = s.error ? Json(s.error->rmse_m) : Json();
    scans.push_back(entry);
  }
  return {{"scans", scans},
          {"reference", score.scans[score.reference].file},
          {"ok", score.count(PoseVerdict::kOk)},
          {"flagged", score.count(PoseVerdict::kFlagged)},
          {"wrong", score.count(PoseVerdict::kWrong)},
          {"pairs", score.num_pairs},
          {"pairs_ok", score.num_pairs_ok},
          {"tolerance", {{"rotation_deg", truth.tolerance.rotation_deg}, {"rmse_m", truth.tolerance.rmse_m}}},
          {"median_rotation_deg", score.median ? Json(score.median->rotation_deg) : Json()},
          {"median_rmse", score.median ? Json(score.median->rmse_m) : Json()},
          {"max_rmse", score.max_rmse_m ? Json(*score.max_rmse_m) : Json()}};
}

void write_json(const nlohmann::ordered_json& json, const fs::path& path) {
  std::ofstream out(path, std::ios::binary);
  out << json.dump(1) << '\n';
  out.close();
  if (!out) throw OutputError(path, "cannot be written", "check the folder, its permissions and free space");
}

}  // namespace

int cmd_evaluate(const Arguments& arguments) {
  Request request;
  const po::options_description description = describe(request);
  po::variables_map given;
  po::store(po::command_line_parser(arguments).options(description).positional({}).run(), given);
  if (given.count("help") > 0) {
    std::cout
        << "Usage: tcm-icp evaluate --scans DIR --poses POSES.json --truth TRUTH.json [--json FILE]\n"
           "How far each scan is from where it belongs, relative to the reference scan of the poses.\n"
           "ok: within the truth's tolerance; flagged: left unregistered; WRONG: said to be registered, and is not.\n\n"
        << description;
    return kSuccess;
  }
  po::notify(given);
  request.options.validate();
  const Truth truth = read_truth(request.truth);
  const Estimates estimates = match(truth, read_pose_file(request.poses), request.poses);
  std::vector<Points> points;
  for (const auto& scan : truth.scans) points.push_back(thinned_points(fs::path(request.scans) / scan.file));
  const SceneScore score = score_poses(truth, estimates.poses, estimates.reference, points, request.options);
  print_table(truth, score, std::cout);
  if (!request.json.empty()) write_json(to_json(truth, score), request.json);
  return kSuccess;
}

}  // namespace tcm_icp::app
