#include "pipeline/scan_set.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/memory_budget.hpp"
#include "scans/scan_steps.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

double paper_correspondence(const IndexedPoints& a, const Points& b, const Eigen::Isometry3d& T_a_b) {
  const Points moved = transformed({b, {}}, T_a_b).points;
  const NeighborIndex index(moved);
  return correspondence_distance(a, {moved, index});
}

[[noreturn]] void refuse_twice(const std::filesystem::path& name) {
  throw InvalidInput(name.string() + ": named twice; name each scan once");
}

// Results have a file for each scan, of its name, in their folders.
void check_name(const std::filesystem::path& name) {
  const bool climbs = std::find(name.begin(), name.end(), "..") != name.end();
  if (!name.empty() && name.has_filename() && !name.is_absolute() && !climbs) return;
  throw InvalidInput("'" + name.string() + "' cannot be the name of a scan: give each one that could be a file's");
}

}  // namespace

std::vector<std::string> input_names(std::span<const ScanInput> inputs) {
  std::vector<std::filesystem::path> files;
  for (const auto& input : inputs) {
    if (input.is_file()) files.push_back(input.path);
  }
  const std::vector<std::string> of_files = scan_names(files);
  std::vector<std::string> names;
  std::size_t next_file = 0;
  for (const auto& input : inputs) names.push_back(input.is_file() ? of_files[next_file++] : input.path.string());
  return names;
}

std::size_t find_scan(std::span<const ScanInput> inputs, const std::string& name) {
  const std::vector<std::string> names = input_names(inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (names[i] == name || inputs[i].path == name) return i;
  }
  std::size_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data(), end, number);
  if (name.empty() || rest != end || error != std::errc()) {
    throw InvalidOptions("--reference " + name + ": no scan of that name; it must be one of the files given");
  }
  if (number < inputs.size()) return number;
  throw InvalidOptions("--reference " + name + ": the scans have the numbers 0 to " +
                       std::to_string(inputs.size() - 1));
}

void check_survey(std::span<const ScanInput> inputs, const InitialPoses& initial_poses, const Survey& survey,
                  bool paper) {
  if (survey.empty()) return;
  if (paper) {
    throw InvalidOptions(
        "control points, positions of scanners and fixed scans need --profile robust: the published "
        "method does not say how exact its poses are");
  }
  const std::vector<std::string> names = input_names(inputs);
  const auto index_of = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) throw InvalidOptions("the survey frame names '" + name + "', which is none of the scans");
    return static_cast<std::size_t>(at - names.begin());
  };
  const auto has_initial_pose = [&](const std::string& name) { return initial_poses[index_of(name)].has_value(); };
  for (const auto& point : survey.points) {
    if (!point.scan.empty()) index_of(point.scan);
  }
  for (const auto& fixed : survey.fixed) {
    if (has_initial_pose(fixed)) continue;
    throw InvalidOptions("--fix " + fixed +
                         ": the scan has no initial pose to stay at; give one in the file of --init");
  }
  for (const auto& prior : survey.priors) {
    const bool is_valid = has_initial_pose(prior.scan) && prior.sigma_position_m > 0 && prior.sigma_rotation_rad > 0;
    if (!is_valid) throw InvalidOptions("the initial pose of " + prior.scan + " has no standard deviation, or is none");
  }
  for (const auto& level : survey.levels) {
    index_of(level.scan);
    if (level.sigma_rad >= 0) continue;
    throw InvalidOptions("the standard deviation of the level of " + level.scan + " is not at least 0");
  }
}

void check_inputs(std::span<const ScanInput> inputs, const InitialPoses& initial_poses) {
  if (initial_poses.size() != inputs.size()) {
    throw InvalidOptions(std::to_string(initial_poses.size()) + " initial poses for " + std::to_string(inputs.size()) +
                         " scans");
  }
  std::set<std::pair<std::filesystem::path, std::size_t>> places;
  for (const auto& input : inputs) {
    if (!input.is_file()) {
      check_name(input.path);
      continue;
    }
    const ScanPath scan = parse_scan_path(input.path);
    std::error_code ignored;
    const auto canonical = std::filesystem::weakly_canonical(scan.file, ignored);
    const std::size_t number = std::max<std::size_t>(scan.number, 1);  // the only scan of its file may go without
    if (!places.insert({canonical.empty() ? scan.file : canonical, number}).second) refuse_twice(input.path);
  }
  std::set<std::string> names;
  for (const auto& name : input_names(inputs)) {
    if (!names.insert(name).second) refuse_twice(name);
  }
}

std::vector<SampledScan> read_scans(std::span<const ScanInput> inputs, const PipelineOptions& options,
                                    const RunContext& context, ScanDetail detail, const StepStore* steps) {
  // All headers first: the last file's absence should not cost the reading of all others.
  for (const auto& input : inputs) const ScanReader opened(input, ReadAttributes::kNo);
  const std::vector<std::string> names = input_names(inputs);
  std::vector<SampledScan> scans(inputs.size());
  const auto batch = static_cast<std::size_t>(context.num_threads);
  for (std::size_t first = 0; first < inputs.size(); first += batch) {
    context.report("reading", first, inputs.size());
    const std::size_t count = std::min(batch, inputs.size() - first);
    parallel_for(context.num_threads, count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) {
        scans[i] = in_budget(
            steps != nullptr
                ? sample_scan_once(*steps, inputs[i], options.sampling, options.outliers, context.seed, 1, detail)
                : sample_scan(inputs[i], options.sampling, options.outliers, context.seed, 1, detail));
        scans[i].scan.file = names[i];
      }
    });
  }
  return scans;
}

ScanSummary summarize(const SampledScan& s) {
  return {s.scan.file,         s.scan.unit,         s.scan.num_raw_points, s.scan.num_dropped_points,
          s.scan.cloud.size(), s.scan.voxel_size_m, s.scan.spacing_m,      s.scan.noise_m,
          s.scan.extent_m,     s.outliers,          s.scan.origin,         s.middle};
}

std::vector<PreparedScan> prepare_scans(std::vector<SampledScan>& scans, const Resolutions& resolutions,
                                        const SampleSizes& options, const RunContext& context) {
  context.report("preparing", 0, scans.size());
  std::vector<std::optional<PreparedScan>> prepared(scans.size());
  parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      prepared[i] = in_budget(prepare_scan(scans[i], resolutions, options, context.seed));
      scans[i].scan.cloud = Cloud();
      scans[i].is_surface = {};
      scans[i].clues = {};  // viewpoints are found before
      if (scans[i].digest.empty()) continue;
      prepared[i]->digest = prepared_digest(scans[i].digest, resolutions, options, context.seed);
    }
  });
  std::vector<PreparedScan> out;
  out.reserve(scans.size());
  for (auto& scan : prepared) out.push_back(std::move(*scan));
  return out;
}

InitialPoses initial_local_poses(const InitialPoses& initial_poses, const std::vector<SampledScan>& scans,
                                 bool as_they_lie) {
  InitialPoses poses(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!initial_poses[i] && !as_they_lie) continue;
    poses[i] = initial_poses[i].value_or(Eigen::Isometry3d::Identity()) * Eigen::Translation3d(scans[i].scan.origin);
  }
  return poses;
}

std::vector<Eigen::Isometry3d> values_of(const InitialPoses& poses) {
  std::vector<Eigen::Isometry3d> values;
  for (const auto& pose : poses) values.push_back(pose.value());
  return values;
}

CorrespondenceGraph compare_scans(const std::vector<PreparedScan>& scans,
                                  const std::vector<Eigen::Isometry3d>& T_common_local, const PipelineOptions& options,
                                  const RunContext& context) {
  const std::size_t n = scans.size();
  Eigen::MatrixXd measure = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    context.report("comparing", i, n);
    const PyramidLevel& a = scans[i].pyramid.level(1);
    std::optional<NeighborIndex> index;
    if (options.profile == Profile::kPaper) index.emplace(a.cloud.points);
    parallel_for(context.num_threads, n - i - 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = i + 1 + begin; j < i + 1 + end; ++j) {
        const Eigen::Isometry3d T_i_j = T_common_local[i].inverse() * T_common_local[j];
        const PyramidLevel& b = scans[j].pyramid.level(1);
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        measure(row, column) = measure(column, row) =
            index ? paper_correspondence({a.cloud.points, *index}, b.cloud.points, T_i_j)
                  : 1 - overlap(a, b, T_i_j, 2 * a.voxel_size_m);
      }
    });
  }
  std::optional<double> threshold;
  if (options.graph_threshold > 0) {
    threshold = options.graph_threshold;
  } else if (options.profile == Profile::kRobust) {
    threshold = 1 - kMinLinkOverlap;
  }
  return build_correspondence_graph(measure, threshold);
}

}  // namespace tcm_icp
