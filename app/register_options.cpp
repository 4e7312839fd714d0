#include "register_options.hpp"

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>
#include <string_view>
#include <utility>

#include "option_binding.hpp"
#include "parse_arguments.hpp"
#include "run_setup.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {
namespace {

namespace po = boost::program_options;

// Enumerations stand on the command line by name.
template <typename Enum, std::size_t N>
struct Names {
  const char* option;
  std::array<std::pair<const char*, Enum>, N> entries;

  Enum parse(const std::string& text) const {
    std::string all;
    std::vector<std::string> known;
    for (const auto& [name, value] : entries) {
      if (text == name) return value;
      all += (all.empty() ? "" : ", ") + std::string(name);
      known.emplace_back(name);
    }
    throw InvalidOptions(std::string("--") + option + " '" + text + "': choose one of " + all +
                         did_you_mean(text, known));
  }
  const char* name(Enum wanted) const {
    for (const auto& [name, value] : entries) {
      if (value == wanted) return name;
    }
    return "";
  }
};

constexpr Names<Method, 3> kMethods{"method",
                                    {{{"tcm", Method::kTcm}, {"icp", Method::kIcp}, {"features", Method::kFeatures}}}};
constexpr Names<Profile, 2> kProfiles{"profile", {{{"robust", Profile::kRobust}, {"paper", Profile::kPaper}}}};
constexpr Names<LpSolver, 2> kSolvers{"solver", {{{"glpk", LpSolver::kGlpk}, {"cgal", LpSolver::kCgal}}}};
constexpr Names<LpFormulation, 4> kFormulations{"lp.formulation",
                                                {{{"plane", LpFormulation::kPointToPlane},
                                                  {"point", LpFormulation::kPointToPoint},
                                                  {"entries", LpFormulation::kEntries},
                                                  {"squares", LpFormulation::kLeastSquares}}}};
constexpr Names<MergeOrder, 6> kMergeOrders{"merge-order",
                                            {{{"tcm", MergeOrder::kTcm},
                                              {"paper-tcm", MergeOrder::kPaperTcm},
                                              {"robust-tcm", MergeOrder::kRobustTcm},
                                              {"overlap", MergeOrder::kOverlap},
                                              {"file", MergeOrder::kFile},
                                              {"random", MergeOrder::kRandom}}}};
constexpr Names<LeftOut, 7> kLeftOut{"without",
                                     {{{"nothing", LeftOut::kNothing},
                                       {"features", LeftOut::kFeatures},
                                       {"slides", LeftOut::kSlides},
                                       {"implied", LeftOut::kImpliedPoses},
                                       {"free-space", LeftOut::kFreeSpace},
                                       {"twins", LeftOut::kTwins},
                                       {"constant", LeftOut::kSetConstant}}}};
constexpr Names<OutlierMethod, 4> kOutlierMethods{"outliers",
                                                  {{{"kmeans", OutlierMethod::kKMeans},
                                                    {"distance", OutlierMethod::kDistance},
                                                    {"lof", OutlierMethod::kLof},
                                                    {"none", OutlierMethod::kNone}}}};
constexpr Names<Refinement, 5> kRefinements{"refinement",
                                            {{{"auto", Refinement::kAuto},
                                              {"none", Refinement::kNone},
                                              {"descent", Refinement::kDescent},
                                              {"annealing", Refinement::kAnnealing},
                                              {"both", Refinement::kDescentThenAnnealing}}}};

constexpr Names<PaperMatches, 3> kPaperMatches{"paper.matches",
                                               {{{"nearest", PaperMatches::kNearest},
                                                 {"threshold", PaperMatches::kThreshold},
                                                 {"mutual", PaperMatches::kMutual}}}};
constexpr Names<PaperSlack, 4> kPaperSlacks{"paper.slack",
                                            {{{"both", PaperSlack::kBoth},
                                              {"above", PaperSlack::kAbove},
                                              {"below", PaperSlack::kBelow},
                                              {"between", PaperSlack::kBetween}}}};
constexpr Names<PaperEnd, 2> kPaperEnds{"paper.end", {{{"motion", PaperEnd::kMotion}, {"slack", PaperEnd::kSlack}}}};
constexpr Names<PaperPoints, 2> kPaperPoints{"paper.points",
                                             {{{"sample", PaperPoints::kSample}, {"all", PaperPoints::kAll}}}};
constexpr Names<PaperUnknowns, 2> kPaperUnknowns{
    "paper.unknowns", {{{"entries", PaperUnknowns::kEntries}, {"twist", PaperUnknowns::kTwist}}}};
constexpr Names<PaperDescent, 2> kPaperDescents{
    "paper.descent", {{{"scans", PaperDescent::kWholeScans}, {"matches", PaperDescent::kMatches}}}};

constexpr Names<CloudFormat, 6> kFormats{"format",
                                         {{{"ply", CloudFormat::kPly},
                                           {"las", CloudFormat::kLas},
                                           {"pcd", CloudFormat::kPcd},
                                           {"text", CloudFormat::kText},
                                           {"e57", CloudFormat::kE57},
                                           {"ptx", CloudFormat::kPtx}}}};
constexpr Names<CloudColour, 2> kColours{"colour", {{{"keep", CloudColour::kKeep}, {"scan", CloudColour::kScan}}}};

// What the command line holds as text before it becomes an enumeration.
struct Choices {
  std::string profile, solver, outliers, refinement, formulation, merge_order, without, method = "tcm";
  std::string voxel = "0", format = kFormats.name(OutputOptions{}.format),
              colour = kColours.name(OutputOptions{}.colour);
  std::string accept_residual = "0", accept_overlap = "0", accept_sigma = "0";
  std::string paper_matches, paper_slack, paper_end, paper_points, paper_unknowns, paper_descent;

  explicit Choices(const PipelineOptions& p)
      : profile(kProfiles.name(p.profile)),
        solver(kSolvers.name(p.lp.lp.solver)),
        outliers(kOutlierMethods.name(p.outliers.method)),
        refinement(kRefinements.name(p.refinement.method)),
        formulation(kFormulations.name(p.formulation)),
        merge_order(kMergeOrders.name(p.merge_order)),
        without(kLeftOut.name(p.without)),
        paper_matches(kPaperMatches.name(p.paper.matches)),
        paper_slack(kPaperSlacks.name(p.paper.slack)),
        paper_end(kPaperEnds.name(p.paper.end)),
        paper_points(kPaperPoints.name(p.paper.points)),
        paper_unknowns(kPaperUnknowns.name(p.paper.unknowns)),
        paper_descent(kPaperDescents.name(p.paper.descent)) {}

  void apply(PipelineOptions& p) const {
    p.profile = kProfiles.parse(profile);
    p.lp.lp.solver = kSolvers.parse(solver);
    p.outliers.method = kOutlierMethods.parse(outliers);
    p.refinement.method = kRefinements.parse(refinement);
    p.formulation = kFormulations.parse(formulation);
    p.merge_order = kMergeOrders.parse(merge_order);
    p.without = kLeftOut.parse(without);
    p.paper.matches = kPaperMatches.parse(paper_matches);
    p.paper.slack = kPaperSlacks.parse(paper_slack);
    p.paper.end = kPaperEnds.parse(paper_end);
    p.paper.points = kPaperPoints.parse(paper_points);
    p.paper.unknowns = kPaperUnknowns.parse(paper_unknowns);
    p.paper.descent = kPaperDescents.parse(paper_descent);
  }
};

std::string shortest_digits(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// "5cm" is a likely mistake, so the error tells the unit.
double parse_voxel(const std::string& text) {
  double length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(length) && length >= 0) return length;
  throw InvalidOptions("--voxel '" + text +
                       "': give a length of at least 0 as a bare number, in the unit of the scans (0.05 for 5 cm where "
                       "that is the metre; 0: all points)");
}

/// "6mm", "0.6 cm", "0.006": a bare number is metres, as results are.
double parse_length(const std::string& option, const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{
      {{"", 1}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"ft", 0.3048}}};
  double length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  for (const auto& [name, metres] : kUnits) {
    if (error == std::errc() && unit == name && std::isfinite(length) && length >= 0) return length * metres;
  }
  throw InvalidOptions("--" + option + " '" + text +
                       "': give a length of at least 0 with its unit: 6mm, 0.6cm, 0.006m (m where there is none; 0: no "
                       "limit)");
}

/// "30%" or "0.3".
double parse_share(const std::string& option, const std::string& text) {
  double share = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), share);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (rest == "%" || rest == " %") share /= 100;
  const bool is_known = rest.empty() || rest == "%" || rest == " %";
  if (error == std::errc() && is_known && share >= 0 && share <= 1) return share;
  throw InvalidOptions("--" + option + " '" + text + "': give a share of 0% to 100%: 30% or 0.3 (0: no limit)");
}

template <typename T>
auto* value(T& target) {
  return bind_option(&target);
}

// What decides how scans are sampled and compared, before any is placed.
void add_comparison_options(ScanSetOptions& o, Choices& c, po::options_description& to) {
  to.add_options()("profile", value(c.profile), "robust: past the paper, verified; paper: to the letter")(
      "init", value(o.initial_poses),
      "file of initial poses, where there are any, as poses.json or truth.json has them; headers: those in the "
      "headers of PTX and E57 scans, as of one common frame")("bin", value(o.bin), kBinHelp)(
      "unit", po::value(&o.units), kUnitHelp)(
      "graph-threshold", value(o.pipeline.graph_threshold),
      "correspondence measure below which two scans are connected, at initial poses; 0: from the data")(
      "seed", value(o.seed), "seed of all random numbers")("threads", value(o.threads), kThreadsHelp)(
      "memory", value(o.memory), kMemoryHelp);
}

po::options_description outlier_options(PipelineOptions& p, Choices& c) {
  po::options_description outliers("Outlier removal; lengths in the unit of the scans, 0: from the data");
  outliers.add_options()("outliers", value(c.outliers), "kmeans, distance, lof or none")(
      "outliers.clusters", value(p.outliers.kmeans_clusters), "kmeans: number of clusters k")(
      "outliers.radius", value(p.outliers.kmeans_radius_m), "kmeans: radius r of the seeding spheres")(
      "outliers.threshold", value(p.outliers.kmeans_threshold_m),
      "kmeans: points farther from every centroid are outliers")("outliers.neighbors", value(p.outliers.num_neighbors),
                                                                 "distance, lof: number of neighbours")(
      "outliers.distance-factor", value(p.outliers.distance_factor),
      "distance: outliers are this many average spacings away")(
      "outliers.lof-threshold", value(p.outliers.lof_threshold),
      "lof: outliers are this much sparser than their neighbours");
  return outliers;
}

po::options_description sampling_options(PipelineOptions& p) {
  po::options_description sampling("Sampling");
  sampling.add_options()("sampling.working-points", value(p.sampling.max_working_points),
                         "most points of a scan kept in memory")(
      "sampling.coarse-voxels", value(p.sampling.coarse_voxels),
      "voxels of a scan at the resolution scans are placed with")(
      "sampling.fine-voxels", value(p.sampling.fine_voxels),
      "voxels of a scan at the resolution they are adjusted with")("sampling.max-surface-variation",
                                                                   value(p.sampling.max_surface_variation),
                                                                   "0..0.333; rougher places do not count as surfaces");
  return sampling;
}

po::options_description paper_options(PaperOptions& o, Choices& c) {
  po::options_description paper("Readings of the paper's method, --profile paper (docs/decisions/0009)");
  paper.add_options()("paper.matches", value(c.paper_matches),
                      "points the simplex matches: nearest (all), threshold (within that of the correspondence graph) "
                      "or mutual (nearest both ways)")(
      "paper.kept-share", value(o.kept_share), "above 0, at most 1; of the matches, those with the least distances")(
      "paper.slack", value(c.paper_slack),
      "in each coordinate: both (=, slack both ways), above (<), below (>) or between (mean of the two)")(
      "paper.unknowns", value(c.paper_unknowns), "entries (12 of R and T) or twist (6 of a small motion)")(
      "paper.points", value(c.paper_points), "sample (as many as --lp.coarse-points) or all of the coarse voxels")(
      "paper.rounds", value(o.max_rounds), "most rounds of matching and simplex")(
      "paper.end", value(c.paper_end),
      "what ends them before: motion (points no longer move) or slack (it no longer falls)")(
      "paper.descent", value(c.paper_descent), "what descent and annealing take tau over: scans (whole) or matches")(
      "paper.marginal", value(o.marginal_share),
      "marginal change of the descent and the annealing at first, as a share of the coarse voxel");
  return paper;
}

po::options_description survey_options(SurveyOptions& o) {
  po::options_description survey("Survey frame, in place of the reference scan's");
  survey.add_options()("control", value(o.control),
                       "CSV of control points: name, scan, measured x, y, z, given X, Y, Z, sigma; blunders are named")(
      "gnss", value(o.positions), "CSV of scanners' positions: scan, X, Y, Z, sigma")(
      "fix", po::value(&o.fixed), "keep this scan where --init puts it; may be given many times")(
      "crs", value(o.crs),
      "coordinate system of that frame, for the files written: EPSG:n, well-known text or a file of it")(
      "level-sigma", po::value(&o.level_sigmas_deg),
      "[deg] scans are upright with this standard deviation, in the adjustment; SCAN=DEG for one scan or file; 0: it "
      "need not be; may be given many times");
  return survey;
}

po::options_description report_options(ReportOptions& o, Choices& c) {
  po::options_description report("Report");
  report.add_options()("accept-residual", value(c.accept_residual),
                       "largest RMS residual of a scan and of a link that is accepted: 6mm; 0: no limit")(
      "accept-overlap", value(c.accept_overlap),
      "least overlap of a scan with the others, and of a link: 30%; 0: no limit")(
      "accept-sigma", value(c.accept_sigma),
      "largest standard deviation of a scan's position that is accepted: 5mm; 0: no limit")(
      "project", value(o.project), "name of the project, for the report")("client", value(o.client), "for whom it is")(
      "instrument", value(o.instrument), "what the scans were taken with")("operator", value(o.surveyor),
                                                                           "who took or registered them")(
      "view-points", value(o.view_points), "points of the 3D view and the pictures; 0: neither");
  return report;
}

po::options_description cloud_options(OutputOptions& o, Choices& c) {
  po::options_description clouds("Clouds written");
  clouds.add_options()("format", value(c.format),
                       "ply, las (1.4), pcd, text, e57 or ptx: of the merged cloud and of --each")(
      "each", po::bool_switch(&o.each)->default_value(o.each),
      "every registered scan in the common frame in a file of its own, too: scans/")(
      "voxel", value(c.voxel),
      "length, in the unit of the scans: the merged cloud keeps one point in each cube of this edge; 0: all points")(
      "colour", value(c.colour), "keep: the scans' own, by scan where none has any; scan: by scan");
  return clouds;
}

// What `register --help` shows: what to write, how to run, and what most sets of scans may need.
constexpr std::array kUsedMost{"out",
                               "force",
                               "work",
                               "config",
                               "format",
                               "each",
                               "init",
                               "bin",
                               "unit",
                               "control",
                               "gnss",
                               "fix",
                               "crs",
                               "accept-residual",
                               "accept-overlap",
                               "accept-sigma",
                               "reference",
                               "level",
                               "profile",
                               "confidence",
                               "outliers",
                               "method",
                               "seed",
                               "threads",
                               "quiet",
                               "verbose",
                               "help",
                               "help-all"};

// Options that may stand in a file, too.
po::options_description configurable(RegisterOptions& o, Choices& c) {
  PipelineOptions& p = o.pipeline;
  po::options_description main("Method");
  main.add_options()("method", value(c.method),
                     "tcm: this program's; icp, features: conventional ones to compare with (no outlier removal unless "
                     "asked for, no verdicts)");
  add_comparison_options(o, c, main);
  main.add_options()(
      "reference", value(p.reference),
      "file of the reference scan, or its number in the report; empty: the correspondence graph chooses")(
      "level", po::bool_switch(&p.level)->default_value(p.level),
      "z points up in every scan, within 10 degrees: links are searched upright only")(
      "merge-order", value(c.merge_order),
      "which scan is merged next: tcm (as the profile measures it), paper-tcm, robust-tcm, overlap, file or random")(
      "without", value(c.without),
      "stage of the robust profile that is left out, to measure what it is worth: nothing, features, slides, implied "
      "(pairs asked where others put them), free-space, twins or constant (of the set)")(
      "confidence", value(p.decision.confidence), "least probability of a place for a scan to count as registered")(
      "solver", value(c.solver), "simplex solver: glpk or cgal (exact, slow, for comparison)");
  po::options_description placement("Simplex, refinement, adjustment");
  placement.add_options()(
      "lp.formulation", value(c.formulation),
      "what a step of the robust profile minimises: plane or point (6 parameters), entries (the paper's 12), squares "
      "(least squares, no simplex)")("lp.max-pivots", value(p.lp.lp.max_pivots), "most simplex pivots of one program")(
      "lp.max-seconds", value(p.lp.lp.max_seconds), "[s] longest time of one program")(
      "lp.coarse-points", value(p.samples.coarse_points), "points of a scan in the coarse programs")(
      "lp.fine-points", value(p.samples.fine_points), "points of a scan in the fine programs")(
      "lp.held-out-points", value(p.samples.held_out_points),
      "points for verification, kept from every fit where there are enough")(
      "refinement", value(c.refinement),
      "of fits to the merged cloud: none, descent, annealing, both; auto: both in the paper's profile, none in robust, "
      "where scans are not fitted to it but adjusted jointly")("refinement.points", value(p.refinement.points),
                                                               "points the cost is taken over, and as many held out")(
      "descent.steps", value(p.refinement.descent_steps), "most steps of the descent")(
      "annealing.steps", value(p.refinement.annealing_steps), "steps of the annealing after the simplex")(
      "annealing.initial-temperature", value(p.refinement.initial_temperature), "in units of the cost at the start")(
      "annealing.final-temperature", value(p.refinement.final_temperature),
      "the same, at the end; cooling is geometric")("adjustment.lp-steps", value(p.adjustment.lp_steps),
                                                    "joint linear programs over all poses; 0: none")(
      "adjustment.steps", value(p.adjustment.steps), "most joint least-squares steps of all poses after them; 0: none")(
      "adjustment.bending", value(p.adjustment.bending),
      "yes or no: how scanners that spun and moved bent their scans is solved for in these steps");
  main.add(survey_options(o.survey))
      .add(cloud_options(o.clouds, c))
      .add(report_options(o.report, c))
      .add(outlier_options(p, c))
      .add(sampling_options(p))
      .add(placement)
      .add(paper_options(p.paper, c));
  return main;
}

po::options_description command_line_only(RegisterOptions& o, std::string& config) {
  po::options_description general("Output and control");
  general.add_options()("out,o", po::value(&o.out), "folder for the result; must not exist, or --force")(
      "force", po::bool_switch(&o.force), "replace an earlier result")(
      "work", po::value(&o.work), "folder that keeps finished steps, to go on from")(
      "config", po::value(&config), "read options from FILE (name = value)")(
      "print-config", po::bool_switch(&o.print_config), "write the effective options to stdout and stop")(
      "quiet,q", po::bool_switch(&o.quiet), kQuietHelp)("verbose,v", po::bool_switch(&o.verbose),
                                                        "say what happens to each scan")(
      "help,h", po::bool_switch(&o.help), "the options used most")("help-all", po::bool_switch(&o.help_all),
                                                                   "all options");
  return general;
}

// What each step takes beside what may stand in a file.
po::options_description step_command_line(std::string_view command, StepOptions& o, std::string& config) {
  po::options_description general("Output and control");
  general.add_options()("work", po::value(&o.work), "work folder: what steps hand on to one another");
  if (command == "match") {
    general.add_options()("block", po::value(&o.block), "K/N: block K of N of the pairs that were planned, K from 1");
  }
  if (command == "solve" || command == "write") {
    general.add_options()("out,o", po::value(&o.out),
                          command == "solve" ? "folder for the result; must not exist, or --force"
                                             : "folder of the result: poses.json is read, scans/ written");
  }
  if (command == "solve") general.add_options()("force", po::bool_switch(&o.force), "replace an earlier result");
  general.add_options()("config", po::value(&config), "read options from FILE, as register does")(
      "quiet,q", po::bool_switch(&o.quiet), kQuietHelp)("verbose,v", po::bool_switch(&o.verbose), kVerboseHelp)(
      "help,h", po::bool_switch(&o.help), "this text");
  return general;
}

po::options_description inspect_description(InspectOptions& o, Choices& c) {
  po::options_description all("Options");
  all.add_options()("json", po::bool_switch(&o.json), "write JSON in place of the tables");
  add_comparison_options(o, c, all);
  all.add_options()("quiet,q", po::bool_switch(&o.quiet), kQuietHelp)(
      "verbose,v", po::bool_switch(&o.verbose), kVerboseHelp)("help,h", po::bool_switch(&o.help), "this text");
  all.add(outlier_options(o.pipeline, c)).add(sampling_options(o.pipeline));
  return all;
}

// Once the text has become options.
void finish(ScanSetOptions& o, const Choices& choices) {
  choices.apply(o.pipeline);
  num_threads(o.threads);
  memory_bytes(o.memory);
  o.pipeline.validate();
}

// The library takes -1 for the largest whole number there is.
void refuse_negative_counts(const po::parsed_options& parsed, const po::variables_map& map) {
  for (const auto& option : parsed.options) {
    const auto at = map.find(option.string_key);
    if (at == map.end() || boost::any_cast<std::uint64_t>(&at->second.value()) == nullptr) continue;
    if (option.value.at(0).front() == '-') {
      throw InvalidOptions("--" + option.string_key + " must be at least 0, not " + option.value[0]);
    }
  }
}

void store_checked(const po::parsed_options& parsed, po::variables_map& map) {
  po::store(parsed, map);
  refuse_negative_counts(parsed, map);
}

// The published rivals have no outlier removal: none unless it is asked for.
void use_conventional_defaults(const po::variables_map& map, Choices& choices) {
  if (choices.profile != kProfiles.name(Profile::kRobust)) {
    throw InvalidOptions("--profile " + choices.profile + " belongs to --method tcm; leave one of the two out");
  }
  if (map["outliers"].defaulted()) choices.outliers = kOutlierMethods.name(OutlierMethod::kNone);
}

void read_config(const std::string& path, const po::options_description& options, po::variables_map& map) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    throw InputError(path, "", "the option file cannot be opened", "check the path given to --config");
  }
  std::stringstream text;
  text << in.rdbuf();
  refuse_placeholders(text.str(), path);
  try {
    store_checked(po::parse_config_file(text, options), map);
  } catch (const po::unknown_option& e) {
    const std::string what = unknown_option_error(e, options, "").what();
    throw InvalidOptions(joined(path + ": " + what, "--print-config shows what may stand there"));
  } catch (const po::error& e) {
    throw InvalidOptions(path + ": " + e.what() + "; --print-config shows what may stand there");
  }
}

}  // namespace

namespace {

// Reads both, the command line and the file that it names.
void read_options(RegisterOptions& o, Choices& choices, const po::options_description& general,
                  const Arguments& arguments) {
  const po::options_description file_options = configurable(o, choices);
  po::options_description scans;
  scans.add_options()("scan", po::value(&o.scans));
  po::options_description all;
  all.add(general).add(file_options).add(scans);

  po::variables_map map;
  store_checked(parse_arguments(arguments, all, "scan"), map);
  if (map.count("config") != 0) read_config(map["config"].as<std::string>(), file_options, map);
  po::notify(map);
  o.method = kMethods.parse(choices.method);
  o.clouds.format = kFormats.parse(choices.format);
  o.clouds.colour = kColours.parse(choices.colour);
  o.clouds.voxel_m = parse_voxel(choices.voxel);
  o.clouds.validate();
  o.report.accept = {parse_length("accept-residual", choices.accept_residual),
                     parse_share("accept-overlap", choices.accept_overlap),
                     parse_length("accept-sigma", choices.accept_sigma)};
  if (o.method != Method::kTcm) use_conventional_defaults(map, choices);
  finish(o, choices);
}

struct StepText {
  std::string_view command, usage, text;
};

constexpr std::array kSteps{
    StepText{"sample", "sample SCAN... --work DIR [OPTIONS]",
             "Step 1 of a registration: reads scans, and keeps in the work folder what stands for each from then on."},
    StepText{
        "plan", "plan SCAN... --work DIR [OPTIONS]",
        "Step 2 of a registration: ranks all pairs of all scans, and writes down in the work folder which to search\n"
        "first (plan.json). Says how many there are."},
    StepText{
        "match", "match --work DIR --block K/N [OPTIONS]",
        "Step 3 of a registration: searches block K of N of the pairs that were planned, and keeps what it finds."},
    StepText{
        "solve", "solve SCAN... --work DIR --out DIR [OPTIONS]",
        "Step 4 of a registration: poses and report from what is in the work folder; what is not there is done. The\n"
        "points of the scans are not read again: there is no merged cloud, and there are no pictures."},
    StepText{
        "write", "write SCAN... --work DIR --out DIR [OPTIONS]",
        "Step 5 of a registration: writes scans of a solved one in the common frame, each to a file in scans/, as\n"
        "'tcm-icp register --each' does."}};

}  // namespace

RegisterOptions parse_register_options(const Arguments& arguments) {
  RegisterOptions o;
  Choices choices(o.pipeline);
  std::string config;
  read_options(o, choices, command_line_only(o, config), arguments);
  return o;
}

StepOptions parse_step_options(std::string_view command, const Arguments& arguments) {
  StepOptions o;
  Choices choices(o.pipeline);
  std::string config;
  read_options(o, choices, step_command_line(command, o, config), arguments);
  if (o.help) return o;
  if (o.method != Method::kTcm) throw InvalidOptions("--method: only tcm has steps; leave it out");
  if (o.work.empty()) {
    throw InvalidOptions("--work DIR is missing: where are the steps to be kept?");
  }
  return o;
}

void print_step_help(std::string_view command, std::ostream& out) {
  StepOptions o;
  Choices choices(o.pipeline);
  const po::options_description file_options = configurable(o, choices);
  po::options_description of_registration("Of the registration, among others");
  for (const char* name : {"bin", "unit", "seed", "threads", "memory"}) {
    of_registration.add(boost::make_shared<po::option_description>(file_options.find(name, false)));
  }
  std::string config;
  const auto* const step =
      std::find_if(kSteps.begin(), kSteps.end(), [&](const StepText& s) { return s.command == command; });
  out << "Usage: tcm-icp " << step->usage << "\n\n"
      << step->text
      << "\nAll steps of a registration take the same options as 'tcm-icp register', best by one --config file.\n\n"
      << step_command_line(command, o, config) << '\n'
      << of_registration
      << "\n'tcm-icp register --help-all' lists the other options; docs/cluster.md shows how steps are run.\n";
}

InspectOptions parse_inspect_options(const Arguments& arguments) {
  InspectOptions o;
  Choices choices(o.pipeline);
  po::options_description all = inspect_description(o, choices);
  all.add_options()("scan", po::value(&o.scans));
  po::variables_map map;
  store_checked(parse_arguments(arguments, all, "scan"), map);
  po::notify(map);
  finish(o, choices);
  return o;
}

void print_inspect_help(std::ostream& out) {
  InspectOptions o;
  Choices choices(o.pipeline);
  out << "Usage: tcm-icp inspect SCAN... [--json] [--init POSES.json] [OPTIONS]\n\n"
         "What is known of scans before they are registered: counts, extents, spacing and noise; of two or more also\n"
         "the TCM of each pair and the correspondence graph with the reference scan it chooses, at the initial poses;\n"
         "scans without one are taken as they lie.\n\n"
      << inspect_description(o, choices)
      << "\nExample: tcm-icp inspect datasets/town/*.ply --init datasets/town/initial_poses.json\n";
}

void print_register_help(Help which, std::ostream& out) {
  RegisterOptions o;
  Choices choices(o.pipeline);
  std::string config;
  out << "Usage: tcm-icp register SCAN... --out DIR [OPTIONS]\n\n"
         "Puts overlapping LiDAR scans (PLY, LAS, E57, PCD, PTX, PTS, text), wherever each lies, into the frame of\n"
         "one of them. SCAN is a file, a folder, a pattern, or one scan of a file (hall.ptx#2). DIR receives "
         "poses.json,\n"
         "poses/, transforms/, registered.ply, preview.png, report.json and report.html. Lengths are in the unit of "
         "the scans.\n\n";
  const po::options_description general = command_line_only(o, config), file_options = configurable(o, choices);
  if (which == Help::kAll) {
    out << general << '\n' << file_options;
  } else {
    po::options_description most("Options used most; --help-all lists all");
    for (const char* name : kUsedMost) {
      const auto* option = general.find_nothrow(name, false);
      most.add(
          boost::make_shared<po::option_description>(option != nullptr ? *option : file_options.find(name, false)));
    }
    out << most;
  }
  out << "\nExample: tcm-icp register datasets/town/*.ply --out out/town\n";
}

void print_register_config(const RegisterOptions& options, std::ostream& out) {
  RegisterOptions o = options;
  Choices choices(o.pipeline);
  choices.method = kMethods.name(o.method);
  choices.format = kFormats.name(o.clouds.format);
  choices.colour = kColours.name(o.clouds.colour);
  choices.voxel = shortest_digits(o.clouds.voxel_m);
  choices.accept_residual = shortest_digits(o.report.accept.residual_m);
  choices.accept_overlap = shortest_digits(o.report.accept.overlap);
  choices.accept_sigma = shortest_digits(o.report.accept.sigma_m);
  // The defaults of a description made from the effective values are the effective values.
  const po::options_description description = configurable(o, choices);
  po::variables_map map;
  po::store(po::command_line_parser(Arguments{}).options(description).run(), map);
  out << "# tcm-icp register --config FILE\n" << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const auto& unit : o.units) out << "unit = " << unit << '\n';
  for (const auto& fixed : o.survey.fixed) out << "fix = " << fixed << '\n';
  for (const auto& sigma : o.survey.level_sigmas_deg) out << "level-sigma = " << sigma << '\n';
  for (const auto& option : description.options()) {
    const std::string& name = option->long_name();
    if (name == "unit" || name == "fix" || name == "level-sigma") continue;  // as many as were given, or none
    const boost::any& v = map[option->long_name()].value();
    out << option->long_name() << " = ";
    if (const auto* text = boost::any_cast<std::string>(&v)) out << *text;
    if (const auto* yes = boost::any_cast<bool>(&v)) out << (*yes ? "true" : "false");
    if (const auto* number = boost::any_cast<double>(&v)) out << *number;
    if (const auto* number = boost::any_cast<int>(&v)) out << *number;
    if (const auto* number = boost::any_cast<std::uint64_t>(&v)) out << *number;
    out << '\n';
  }
}

}  // namespace tcm_icp::app
