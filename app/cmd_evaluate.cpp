// tcm-icp evaluate: errors of poses against ground truth.

#include <boost/program_options.hpp>
#include <iostream>
#include <map>

#include "command.hpp"
#include "evaluation_report.hpp"
#include "option_binding.hpp"
#include "parse_arguments.hpp"
#include "run_setup.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp::app {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

struct Request {
  std::string scans, poses, truth, json, bin;
  std::vector<std::string> units;
  ScoreOptions options;
  std::size_t rms_points = 50000;
  std::size_t cloud_points = 200000;
  std::uint64_t seed = 42;
  RunOptions run;
  double max_rotation_deg = 0, max_rmse = 0;
};

po::options_description describe(Request& r) {
  po::options_description what("Options", 110);
  what.add_options()("scans", po::value(&r.scans)->required(), "folder of the scans the poses belong to")  //
      ("poses", po::value(&r.poses)->required(), "poses.json of 'tcm-icp register'")                       //
      ("truth", po::value(&r.truth)->required(), "truth.json of the scene")                                //
      ("bin", po::value(&r.bin), kBinHelp)                                                                 //
      ("unit", po::value(&r.units), kUnitHelp)                                                             //
      ("json", po::value(&r.json), "write the figures here as well")                                       //
      ("min-overlap", bind_option(&r.options.min_overlap),
       "true overlap (0..1) from which a pair counts for registration recall")  //
      ("max-rotation", po::value(&r.max_rotation_deg),
       "[deg] a right pose is within; default: the truth's tolerance")  //
      ("max-rmse", po::value(&r.max_rmse),
       "and within this, in the unit of the scans; default: the truth's tolerance")  //
      ("rms-points", bind_option(&r.rms_points),
       "points, drawn over all registered scans, the total RMS is taken over")  //
      ("cloud-points", bind_option(&r.cloud_points),
       "points, shared out among all scans, that stand for the clouds whose distance is measured")  //
      ("seed", bind_option(&r.seed), "of both draws")                                               //
      ("help,h", "this text");
  add_run_options(r.run, what);
  return what;
}

void validate(const Request& r, const po::variables_map& given) {
  r.options.validate();
  if (r.rms_points < 1 || r.cloud_points < 1) throw InvalidOptions("--rms-points and --cloud-points need 1 or more");
  num_threads(r.run.threads);
  for (const auto& [name, value] : {std::pair("max-rotation", r.max_rotation_deg), {"max-rmse", r.max_rmse}})
    if (given.count(name) > 0 && !(value > 0))
      throw InvalidOptions("--" + std::string(name) + " = " + std::to_string(value) + "; needs > 0");
}

std::uint64_t count_points(const fs::path& path) {
  PointBlock block;
  ScanReader counter(path, ReadAttributes::kNo);
  while (counter.read(block)) continue;
  if (counter.num_points() == 0) throw InputError(path, "", "has no finite point", "evaluate scans that have points");
  return counter.num_points();
}

struct Samples {
  Points thinned;  ///< every k-th finite point, so that at most about 50,000 are left: their error is that of all of
                   ///< them to its printed digits
  Points drawn;    ///< as many as were asked for, drawn evenly
};

Samples sample(const fs::path& path, std::uint64_t num_points, std::size_t num_drawn, Rng& rng) {
  constexpr std::uint64_t kAtMost = 50000;
  const std::uint64_t step = std::max<std::uint64_t>(1, num_points / kAtMost);
  const auto chosen = sample_indices(rng, num_points, num_drawn);
  Samples out;
  std::uint64_t index = 0;
  auto next = chosen.begin();
  PointBlock block;
  ScanReader reader(path, ReadAttributes::kNo);
  while (reader.read(block)) {
    for (const auto& p : block.points) {
      if (index % step == 0) out.thinned.push_back(p);
      if (next != chosen.end() && *next == index) {
        out.drawn.push_back(p);
        ++next;
      }
      ++index;
    }
  }
  return out;
}

struct Estimates {
  std::vector<std::optional<Eigen::Isometry3d>> poses;  ///< in the order of the truth
  std::size_t reference = 0;
};

bool is_same_file(const fs::path& a, const fs::path& b) { return a == b || a.filename() == b; }

Estimates match(const Truth& truth, const PoseFile& file, const fs::path& path) {
  std::map<std::string, const ScanPose*> by_name;
  for (const auto& scan : file.scans) by_name[scan.file] = &scan;
  // Files of other programs name scans with their folders.
  for (const auto& scan : file.scans) by_name.emplace(fs::path(scan.file).filename(), &scan);
  Estimates out;
  std::optional<std::size_t> reference;
  for (const auto& scan : truth.scans) {
    const auto at = by_name.find(scan.file);
    if (at == by_name.end()) {
      throw InputError(path, "", "has no entry for " + scan.file, "give the poses of all scans of the truth");
    }
    const bool placed = at->second->status != ScanStatus::kUnregistered;
    if (placed && is_same_file(at->second->file, file.reference)) reference = out.poses.size();
    out.poses.push_back(placed ? std::optional(at->second->T_reference_scan) : std::nullopt);
  }
  if (!reference) {
    throw InputError(path, "", "its reference '" + file.reference + "' has no pose, or is not in the truth", "");
  }
  out.reference = *reference;
  return out;
}

Evaluation evaluate(const Request& r, const po::variables_map& given) {
  Evaluation out;
  out.truth = read_truth(r.truth);
  if (given.count("max-rotation") > 0) out.truth.tolerance.rotation_deg = r.max_rotation_deg;
  if (given.count("max-rmse") > 0) out.truth.tolerance.rmse_m = r.max_rmse;
  std::vector<fs::path> paths;
  for (const auto& scan : out.truth.scans) {
    paths.push_back(with_layout(fs::path(r.scans) / scan.file, parse_bin(r.bin)));
  }
  paths = with_units(paths, r.units);
  const Estimates estimates = match(out.truth, read_pose_file(r.poses), r.poses);
  std::vector<std::uint64_t> counts;
  for (const auto& path : paths) counts.push_back(count_points(path));
  const auto shares = share_out(std::max(r.cloud_points, r.rms_points), counts);
  std::vector<Points> thinned, drawn;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string& file = out.truth.scans[i].file;
    Rng rng = make_stream(r.seed, "evaluate", file);
    Samples samples = sample(paths[i], counts[i], shares[i], rng);
    thinned.push_back(std::move(samples.thinned));
    drawn.push_back(std::move(samples.drawn));
  }
  out.score = score_poses(out.truth, estimates.poses, estimates.reference, thinned, r.options);
  Rng rng = make_stream(r.seed, "evaluate rms");
  out.clouds = compare_clouds(out.truth, estimates.poses, estimates.reference, drawn, r.rms_points, rng,
                              num_threads(r.run.threads));
  out.min_overlap = r.options.min_overlap;
  out.seed = r.seed;
  return out;
}

}  // namespace

int cmd_evaluate(const Arguments& arguments) {
  Request request;
  const po::options_description description = describe(request);
  po::variables_map given;
  po::store(parse_arguments(arguments, description), given);
  if (given.count("help") > 0) {
    std::cout
        << "Usage: tcm-icp evaluate --scans DIR --poses POSES.json --truth TRUTH.json [--json FILE]\n"
           "How far each scan is from where it belongs, relative to the reference scan of the poses; each pair of "
           "scans\n"
           "that truly overlaps; and the registered cloud against that of the truth.\n"
           "ok: within the truth's tolerance; flagged: left unregistered; WRONG: said to be registered, and is not.\n\n"
        << description;
    return kSuccess;
  }
  po::notify(given);
  validate(request, given);
  const Evaluation evaluation = evaluate(request, given);
  print_evaluation(evaluation, std::cout);
  if (!request.json.empty()) write_evaluation(evaluation, request.json);
  return kSuccess;
}

}  // namespace tcm_icp::app
