// Registration of one pair of scans: register_lp against PCL, on the same sampled points and from the same eight
// starts.
//
//   tcm_icp_benchmark_registration [--dump FOLDER] [--pair TARGET SOURCE TRUTH.json]... [Google Benchmark's options]
//
// --dump writes what the methods are given to FOLDER, a folder a pair, for programs that are no libraries to us.
//
// Times are from sampled points without normals to the pose: whatever a method needs besides (normals, trees,
// covariances) counts. Counters are the error against the truth: of all eight starts the median and the worst.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scan_pair.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/normals.hpp"
#include "tcm_icp/core/place_sampling.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/scan_writer.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "tcm_icp/registration/normal_space_sampling.hpp"
#ifdef TCM_ICP_HAVE_PCL
#include "pcl_registration.hpp"
#endif

namespace tcm_icp {
namespace {

constexpr std::size_t kNumStarts = 8;

/// Farthest a match may be, at first and at last; the same for every method.
struct Gates {
  double initial_m, final_m;
};

// At first twice what the starts are off (rms over the source's points), at last three voxels.
Gates gates_of(const ScanPair& pair, const std::vector<Eigen::Isometry3d>& starts) {
  double sum_m2 = 0;
  for (const auto& T : starts) {
    const double off_m = rms_displacement(pair.T_target_source.inverse() * T, pair.source);
    sum_m2 += off_m * off_m;
  }
  const double final_m = 3 * pair.voxel_size_m;
  return {std::max(final_m, 2 * std::sqrt(sum_m2 / static_cast<double>(starts.size()))), final_m};
}

Cloud with_normals(const Points& points) {
  return {points, estimate_normals(points, NeighborIndex(points), {}, 1).normals};
}

/// @param num_samples  source points used, sampled by normals; 0 for all
Eigen::Isometry3d run_lp(const ScanPair& pair, const Eigen::Isometry3d& T_init, const Gates& gates,
                         std::size_t num_samples) {
  Cloud source = with_normals(pair.source);
  if (num_samples > 0) {
    Rng rng = make_stream(4, "benchmark sample");
    Cloud sampled;
    const auto priorities = place_priorities(source.points, pair.voxel_size_m, rng);
    for (const std::size_t i : normal_space_sample(source, num_samples, priorities)) {
      sampled.points.push_back(source.points[i]);
      sampled.normals.push_back(source.normals[i]);
    }
    source = std::move(sampled);
  }
  const ScanPyramid target(with_normals(pair.target), pair.voxel_size_m, 3);
  LpRegistrationOptions options;
  options.initial_gate_m = gates.initial_m;
  options.final_gate_m = gates.final_m;
  const RegistrationResult result = register_lp(source, target, T_init, options);
  if (!result.usable()) throw Error("register_lp: " + std::string(to_string(result.termination)));
  return result.T_target_source;
}

using Method = std::function<Eigen::Isometry3d(const ScanPair&, const Eigen::Isometry3d& T_init, const Gates&)>;

std::vector<std::pair<std::string, Method>> methods() {
  std::vector<std::pair<std::string, Method>> out;
  out.emplace_back("lp", [](const auto& p, const auto& T, const auto& g) { return run_lp(p, T, g, 0); });
  out.emplace_back("lp_5000", [](const auto& p, const auto& T, const auto& g) { return run_lp(p, T, g, 5'000); });
#ifdef TCM_ICP_HAVE_PCL
  using Steps = std::vector<double>;
  out.emplace_back("pcl_icp", [](const auto& p, const auto& T, const auto& g) {
    return pcl_icp(p.source, p.target, T, Steps{g.initial_m});
  });
  out.emplace_back("pcl_icp_two_gates", [](const auto& p, const auto& T, const auto& g) {
    return pcl_icp(p.source, p.target, T, Steps{g.initial_m, g.final_m});
  });
  out.emplace_back("pcl_point_to_plane_two_gates", [](const auto& p, const auto& T, const auto& g) {
    return pcl_point_to_plane(with_normals(p.source), with_normals(p.target), T, Steps{g.initial_m, g.final_m});
  });
  out.emplace_back("pcl_gicp", [](const auto& p, const auto& T, const auto& g) {
    return pcl_gicp(p.source, p.target, T, Steps{g.initial_m}, 0);
  });
  out.emplace_back("pcl_gicp_two_gates_small_steps", [](const auto& p, const auto& T, const auto& g) {
    return pcl_gicp(p.source, p.target, T, Steps{g.initial_m, g.final_m}, 1e-4);
  });
#endif
  return out;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

void run_method(benchmark::State& state, const ScanPair& pair, const Method& method) {
  const auto starts = starts_near_truth(pair, kNumStarts);
  const Gates gates = gates_of(pair, starts);
  std::vector<double> rmse_m, rotation_deg;
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Isometry3d T = method(pair, starts[i++ % kNumStarts], gates);
    const Eigen::Isometry3d error = pair.T_target_source.inverse() * T;
    rmse_m.push_back(rms_displacement(error, pair.source));
    rotation_deg.push_back(rotation_angle_rad(error.linear()) * 180 / std::numbers::pi);
  }
  state.counters["points"] = static_cast<double>(pair.source.size() + pair.target.size()) / 2;
  state.counters["rotation_deg"] = median(rotation_deg);
  state.counters["rmse_m"] = median(rmse_m);
  state.counters["worst_rotation_deg"] = *std::max_element(rotation_deg.begin(), rotation_deg.end());
  state.counters["worst_rmse_m"] = *std::max_element(rmse_m.begin(), rmse_m.end());
}

nlohmann::json rows_of(const Eigen::Isometry3d& T) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index row = 0; row < 4; ++row) rows.push_back({T(row, 0), T(row, 1), T(row, 2), T(row, 3)});
  return rows;
}

void dump(const ScanPair& pair, const std::filesystem::path& folder) {
  const auto starts = starts_near_truth(pair, kNumStarts);
  const Gates gates = gates_of(pair, starts);
  std::filesystem::create_directories(folder);
  write_scan(folder / "target.ply", {.points = pair.target, .attributes = {}}, {});
  write_scan(folder / "source.ply", {.points = pair.source, .attributes = {}}, {});
  nlohmann::json json{{"voxel_size_m", pair.voxel_size_m},
                      {"gates_m", {gates.initial_m, gates.final_m}},
                      {"T_target_source", rows_of(pair.T_target_source)},
                      {"starts", nlohmann::json::array()}};
  for (const auto& T : starts) json["starts"].push_back(rows_of(T));
  std::ofstream(folder / "pair.json") << json.dump(1) << '\n';
}

struct Arguments {
  std::vector<ScanPair> pairs{street_pair()};
  std::filesystem::path dump_folder;
};

Arguments parse(int argc, char** argv) {
  Arguments out;
  for (int i = 1; i < argc;) {
    const std::string_view name = argv[i];
    if (name == "--dump" && i + 1 < argc) {
      out.dump_folder = argv[i + 1];
      i += 2;
    } else if (name == "--pair" && i + 3 < argc) {
      out.pairs.push_back(read_pair(argv[i + 1], argv[i + 2], argv[i + 3]));
      i += 4;
    } else {
      throw InvalidOptions("expected --dump FOLDER or --pair TARGET SOURCE TRUTH.json, not " + std::string(name));
    }
  }
  return out;
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const Arguments arguments = parse(argc, argv);
  for (const ScanPair& pair : arguments.pairs) {
    if (!arguments.dump_folder.empty()) dump(pair, arguments.dump_folder / pair.name);
    for (const auto& [name, method] : methods()) {
      benchmark::RegisterBenchmark((pair.name + "/" + name).c_str(), run_method, pair, method)
          ->Iterations(kNumStarts)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace tcm_icp

int main(int argc, char** argv) {
  try {
    return tcm_icp::run(argc, argv);
  } catch (const tcm_icp::Error& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}
