// tcm-icp simulate: scans of a made-up scene, with exact truth.

#include <boost/program_options.hpp>
#include <iostream>
#include <thread>

#include "command.hpp"
#include "console.hpp"
#include "option_binding.hpp"
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
  std::vector<double> initial_guess;
  RunContext context;
};

po::options_description describe(Request& r) {
  SceneSetOptions& s = r.scenes;
  ScannerOptions& scanner = s.scanner;
  po::options_description what("What to simulate", 110);
  what.add_options()("scene", bind_option(&r.scene),
                     "town, block (a closed loop) or street; each has defaults of its own")       //
      ("scans", bind_option(&s.num_scans), "number of stations along the scene's path")           //
      ("spacing", bind_option(&s.station_spacing_m), "[m] between stations of block and street")  //
      ("seed", bind_option(&r.context.seed), "the same seed gives the same bytes")                //
      ("threads", bind_option(&r.context.num_threads), "changes the time, never the result")      //
      ("out", po::value(&r.out)->required(), "folder to make: 000.ply ..., truth.json")           //
      ("force", "replace an earlier result in that folder")                                       //
      ("initial-guess", po::value(&r.initial_guess)->multitoken()->value_name("DEG METRES"),
       "also write initial_poses.json: the truth, off by 0.6 to 1 times this turn and shift; the first scan exact")  //
      ("help,h", "this text");
  po::options_description sensor("Scanner", 110);
  sensor.add_options()("step", bind_option(&scanner.step_deg), "[deg] between neighbouring rays")                    //
      ("min-elevation", bind_option(&scanner.min_elevation_deg), "[deg] lowest ray")                                 //
      ("max-elevation", bind_option(&scanner.max_elevation_deg), "[deg] highest ray")                                //
      ("max-range", bind_option(&scanner.max_range_m), "[m] farther surfaces give no return")                        //
      ("range-noise", bind_option(&scanner.range_noise_m), "[m] standard deviation along the ray")                   //
      ("angular-noise", bind_option(&scanner.angular_noise_deg), "[deg] standard deviation of a ray's direction")    //
      ("thinning", bind_option(&scanner.thinning_voxel_m), "[m] keep one return a voxel of this size; 0 keeps all")  //
      ("isolated", bind_option(&scanner.isolated_share), "share of returns in mid air");
  po::options_description frames("Frames of the scans", 110);
  frames.add_options()("tilt", bind_option(&s.max_tilt_deg),
                       "[deg] largest tilt of a scan's frame; its heading is any")  //
      ("shift", bind_option(&s.max_shift_m), "[m] farthest a scan's origin may lie from its scanner; 0 keeps it there");
  return what.add(sensor).add(frames);
}

/// What --scene asks for, before anything else is read: the other options' defaults depend on it.
SceneKind asked_scene(const Arguments& arguments) {
  std::string scene = scene_name(SceneKind::kTown);
  po::options_description only_scene;
  only_scene.add_options()("scene", po::value(&scene));
  po::variables_map given;
  po::store(po::command_line_parser(arguments).options(only_scene).allow_unregistered().run(), given);
  po::notify(given);
  return scene_kind_from_name(scene);
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
  request.context.num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  request.scenes = default_scene_set(asked_scene(arguments));
  request.scene = scene_name(request.scenes.scene);
  const po::options_description description = describe(request);
  po::variables_map given;
  po::store(po::command_line_parser(arguments).options(description).positional({}).run(), given);
  if (given.count("help") > 0) {
    std::cout << "Usage: tcm-icp simulate --scene town|block|street --scans N --out DIR [--seed N] ...\n"
                 "LiDAR scans of a made-up scene, each in a frame of its own, with exact truth.\n\n"
              << description;
    return kSuccess;
  }
  po::notify(given);
  if (!request.initial_guess.empty()) {
    if (request.initial_guess.size() != 2) throw InvalidOptions("--initial-guess needs two numbers: DEG METRES");
    request.scenes.initial_guess = PosePerturbation{request.initial_guess[0], request.initial_guess[1]};
  }
  if (request.context.num_threads < 1)
    throw InvalidOptions("--threads = " + std::to_string(request.context.num_threads) + "; needs >= 1");
  request.scenes.validate();
  catch_interrupts();
  Console console(/*quiet=*/false, /*verbose=*/false);
  request.context.on_progress = [&](const Progress& p) { return console.progress(p); };
  OutputFolder folder(request.out, given.count("force") > 0, "truth.json");
  const SceneSet set = simulate_scene_set(request.scenes, request.context);
  request.context.report("writing", 0, 1);
  write_scene_set(set, folder.work());
  folder.commit();
  console.finish();
  print_summary(set, std::cerr);
  return kSuccess;
}

}  // namespace tcm_icp::app
