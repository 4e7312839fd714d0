#include "option_descriptions.hpp"

#include "option_binding.hpp"
#include "parse_arguments.hpp"
#include "run_setup.hpp"

namespace tcm_icp::app {
namespace {

namespace po = boost::program_options;

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

}  // namespace

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

}  // namespace tcm_icp::app
