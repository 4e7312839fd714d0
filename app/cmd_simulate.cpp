// tcm-icp simulate: scans of a made-up scene, with exact truth.

#include <boost/program_options.hpp>
#include <iostream>

#include "command.hpp"
#include "console.hpp"
#include "option_binding.hpp"
#include "parse_arguments.hpp"
#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/output_folder.hpp"
#include "tcm_icp/simulation/scene_set.hpp"

namespace tcm_icp::app {
namespace {

namespace po = boost::program_options;

struct Request {
  SceneSetOptions scenes;
  std::string scene = scene_name(SceneKind::kTown);
  std::string out;
  std::string sensor;
  double overlap = 0;
  std::vector<double> initial_guess;
  RunOptions run;
  RunContext context;
};

po::options_description describe_sensor(Request& r) {
  ScannerOptions& scanner = r.scenes.scanner;
  po::options_description sensor("Sensor, and what it does wrong", 110);
  sensor.add_options()(
      "sensor", bind_option(&r.sensor),
      "terrestrial (a dome of rays), spinning (lines about the vertical) or aerial (a strip below)")               //
      ("step", bind_option(&scanner.step_deg), "[deg] between neighbouring rays")                                  //
      ("lines", bind_option(&scanner.num_lines), "of spinning, from the lowest to the highest ray")                //
      ("min-elevation", bind_option(&scanner.min_elevation_deg), "[deg] lowest ray; not of aerial")                //
      ("max-elevation", bind_option(&scanner.max_elevation_deg), "[deg] highest ray; not of aerial")               //
      ("swath", bind_option(&scanner.half_swath_deg), "[deg] of aerial, to either side of straight down")          //
      ("strip-length", bind_option(&scanner.strip_length_m), "[m] of aerial, flown during a scan")                 //
      ("line-spacing", bind_option(&scanner.line_spacing_m), "[m] of aerial, along the flight")                    //
      ("height", bind_option(&r.scenes.scanner_height_m), "[m] of the sensor above the ground")                    //
      ("min-range", bind_option(&scanner.min_range_m), "[m] nearer surfaces give no return")                       //
      ("max-range", bind_option(&scanner.max_range_m), "[m] farther surfaces give no return")                      //
      ("range-noise", bind_option(&scanner.range_noise_m), "[m] standard deviation along the ray")                 //
      ("angular-noise", bind_option(&scanner.angular_noise_deg), "[deg] standard deviation of a ray's direction")  //
      ("full-signal", bind_option(&scanner.full_return_signal),
       "reflectivity times cosine of incidence below which returns get lost in proportion")  //
      ("max-incidence", bind_option(&scanner.max_incidence_deg),
       "[deg] surfaces met at a more grazing angle give no return; 90: all do")                                      //
      ("dropouts", bind_option(&scanner.dropout_share), "share of returns that get lost")                            //
      ("beam-width", bind_option(&scanner.beam_width_deg), "[deg] of the beam: mixed pixels at edges; 0: none")      //
      ("speed", bind_option(&scanner.speed_m_s), "[m/s] motion during a turn, not corrected for; not of aerial")     //
      ("turns", bind_option(&scanner.turns_per_s), "[1/s] a scan is one turn")                                       //
      ("thinning", bind_option(&scanner.thinning_voxel_m), "[m] keep one return a voxel of this size; 0 keeps all")  //
      ("isolated", bind_option(&scanner.isolated_share), "share of returns in mid air");
  return sensor;
}

po::options_description describe_frames(SceneSetOptions& s) {
  po::options_description frames("Frames of the scans", 110);
  frames.add_options()("tilt", bind_option(&s.max_tilt_deg),
                       "[deg] largest tilt of a scan's frame; its heading is any")  //
      ("shift", bind_option(&s.max_shift_m), "[m] farthest a scan's origin may lie from its scanner; 0 keeps it there");
  return frames;
}

po::options_description describe(Request& r) {
  SceneSetOptions& s = r.scenes;
  po::options_description what("What to simulate", 110);
  what.add_options()(
      "scene", bind_option(&r.scene),
      "town, block (a closed loop), street (mobile), urban (moving platform), canopy (lake shore), "
      "orchard (equal rows), tunnel (equal rings), motorway, interior, plaza, bays (a building that repeats "
      "itself), storeys (alike, with stairs) or town-grid (all streets of a town); each has defaults of its own")  //
      ("scans", bind_option(&s.num_scans), "number of stations along the scene's path")                            //
      ("spacing", bind_option(&s.station_spacing_m),
       "[m] between stations; those of town and plaza share out their path")  //
      ("overlap", po::value(&r.overlap),
       "choose the spacing so that neighbouring scans share about this much (0.05..0.95)")               //
      ("clutter", bind_option(&s.bays.clutter), "of bays: things a bay, which tell it from the others")  //
      ("seed", bind_option(&r.context.seed), "the same seed gives the same bytes")                       //
      ("out", po::value(&r.out)->required(), "folder to make: 000.ply ..., truth.json")                  //
      ("force", "replace an earlier result in that folder")                                              //
      ("initial-guess", po::value(&r.initial_guess)->multitoken()->value_name("DEG METRES"),
       "also write initial_poses.json: the truth, off by 0.6 to 1 times this turn and shift; the first scan exact")  //
      ("help,h", "this text");
  add_run_options(r.run, what);
  return what.add(describe_sensor(r)).add(describe_frames(s));
}

SceneKind scene_asked(const std::string& name) {
  std::vector<std::string> known;
  for (const SceneKind kind : scene_kinds()) known.push_back(scene_name(kind));
  try {
    return scene_kind_from_name(name);
  } catch (const InvalidOptions& e) {
    throw InvalidOptions(e.what() + did_you_mean(name, known));
  }
}

SensorKind sensor_asked(const std::string& name) {
  try {
    return sensor_kind_from_name(name);
  } catch (const InvalidOptions& e) {
    throw InvalidOptions(e.what() + did_you_mean(name, {"terrestrial", "spinning", "aerial"}));
  }
}

/// What --scene and --sensor ask for, before anything else is read: the other options' defaults depend on it.
SceneSetOptions asked_defaults(const Arguments& arguments) {
  std::string scene = scene_name(SceneKind::kTown), sensor;
  po::options_description kinds;
  kinds.add_options()("scene", po::value(&scene))("sensor", po::value(&sensor));
  po::variables_map given;
  constexpr int kStyle = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::store(po::command_line_parser(arguments).options(kinds).allow_unregistered().style(kStyle).run(), given);
  po::notify(given);
  SceneSetOptions options = default_scene_set(scene_asked(scene));
  if (!sensor.empty()) use_sensor(options, sensor_asked(sensor));
  return options;
}

void print_summary(const SceneSet& set, std::ostream& out) {
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    double best_overlap = 0;
    for (Eigen::Index j = 0; j < set.truth.overlap.cols(); ++j) {
      const auto row = static_cast<Eigen::Index>(i);
      if (j != row) best_overlap = std::max(best_overlap, set.truth.overlap(row, j));
    }
    out << set.truth.scans[i].file << "  " << set.scans[i].cloud.size() << " points, best overlap " << best_overlap
        << '\n';
  }
}

}  // namespace

int cmd_simulate(const Arguments& arguments) {
  Request request;
  request.scenes = asked_defaults(arguments);
  request.scene = scene_name(request.scenes.scene);
  request.sensor = sensor_name(request.scenes.scanner.sensor);
  const po::options_description description = describe(request);
  po::variables_map given;
  po::store(parse_arguments(arguments, description), given);
  if (given.count("help") > 0) {
    std::cout << "Usage: tcm-icp simulate --scene "
                 "town|block|street|urban|canopy|orchard|tunnel|motorway|interior|plaza|bays|storeys|town-grid "
                 "--scans N --out DIR [--seed N] ...\n"
                 "LiDAR scans of a made-up scene, each in a frame of its own, with exact truth.\n\n"
              << description;
    return kSuccess;
  }
  po::notify(given);
  if (given.count("overlap") > 0) request.scenes.overlap = request.overlap;
  if (!request.initial_guess.empty()) {
    if (request.initial_guess.size() != 2) throw InvalidOptions("--initial-guess needs two numbers: DEG METRES");
    request.scenes.initial_guess = PosePerturbation{request.initial_guess[0], request.initial_guess[1]};
  }
  request.context.num_threads = num_threads(request.run.threads);
  request.scenes.validate();
  catch_interrupts();
  Console console(request.run.quiet, request.run.verbose);
  request.context.on_progress = [&](const Progress& p) { return console.progress(p); };
  OutputFolder folder(request.out, given.count("force") > 0, "truth.json");
  const SceneSet set = simulate_scene_set(request.scenes, request.context);
  request.context.report("writing", 0, 1);
  write_scene_set(set, folder.work());
  folder.commit();
  console.finish();
  if (!request.run.quiet) print_summary(set, std::cerr);
  return kSuccess;
}

}  // namespace tcm_icp::app
