#include "tcm_icp/pipeline/result_writer.hpp"

#include <algorithm>
#include <map>

#include "io/sha256.hpp"
#include "io/text_file.hpp"
#include "pipeline/pose_graph_edges.hpp"
#include "pipeline/registered_clouds.hpp"
#include "pipeline/stage_clock.hpp"
#include "report/cloud_picture.hpp"
#include "report/report_html.hpp"
#include "report/scene.hpp"
#include "report/scene_sample.hpp"
#include "report/section_cut.hpp"
#include "steps/input_digest.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/io/output_folder.hpp"
#include "tcm_icp/io/pose_export.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

// The file by which --force knows an earlier result.
constexpr const char* kMarker = "poses.json";

void add_options(const OutputOptions& clouds, Json& to) {
  to["format"] = std::string(extension_of(clouds.format)).substr(1);
  to["each"] = clouds.each;
  to["voxel_m"] = clouds.voxel_m;
  to["colour"] = clouds.colour == CloudColour::kKeep ? "keep" : "scan";
}

// Registered, or in a group that holds together by itself.
bool is_drawn(const PipelineResult& result, std::size_t scan) {
  return result.poses[scan].status != ScanStatus::kUnregistered || result.has_frame_of_its_own(scan);
}

// Of the file each scan comes from; several scans may be in one. Empty for scans that are in no file.
std::vector<std::string> check_sums(std::span<const ScanInput> inputs, const StepStore* steps, int num_threads) {
  const auto file_of = [](const ScanInput& input) { return parse_scan_path(input.path).file; };
  std::map<fs::path, std::string> sums;
  for (const auto& input : inputs) {
    if (input.is_file()) sums[file_of(input)];
  }
  std::vector<std::map<fs::path, std::string>::iterator> files;
  for (auto file = sums.begin(); file != sums.end(); ++file) files.push_back(file);
  parallel_for(num_threads, files.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const fs::path& file = files[k]->first;
      files[k]->second = steps != nullptr ? input_digest(*steps, file) : sha256_of_file(file);
    }
  });
  std::vector<std::string> out;
  for (const auto& input : inputs) out.push_back(input.is_file() ? sums.at(file_of(input)) : "");
  return out;
}

SceneSampler scene_sampler(const PipelineResult& result, std::size_t wanted) {
  std::vector<std::uint64_t> num_points;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    num_points.push_back(is_drawn(result, i) ? result.scans[i].num_points : 0);
  }
  return {num_points, wanted};
}

std::vector<double> view_cells(const PipelineResult& result) {
  constexpr double kCellsByExtent = 60;  // a scan covers some ten thousand of them
  std::vector<double> cells_m;
  for (const auto& scan : result.scans) cells_m.push_back(std::max(1e-9, scan.extent_m / kCellsByExtent));
  return cells_m;
}

Image preview(const Scene& scene) {
  constexpr int kWidth = 1600, kHeight = 800;
  return draw_preview(picture_points(scene), scene.registered().box, kWidth, kHeight);
}

}  // namespace

void check_output_folder(const fs::path& folder, bool overwrite) {
  const OutputFolder trial(folder, overwrite, kMarker);  // made and removed: better now than after the work
}

void write_result(const fs::path& folder, bool overwrite, std::span<const ScanInput> inputs, PipelineResult& result,
                  const PipelineOptions& options, const OutputOptions& clouds, const RunContext& context,
                  const RunDescription& description, const StepStore* steps) {
  description.report.accept.validate();
  OutputFolder output(folder, overwrite, kMarker);
  StageClock clock(result.stages);
  clock.begin("write");
  const bool is_seen = clouds.merged || clouds.each;
  SceneSampler sampler = scene_sampler(result, is_seen ? description.report.view_points : 0);
  std::vector<SectionCut> sections = is_seen ? choose_sections(result) : std::vector<SectionCut>();
  SectionCutter cutter(sections, result);
  const auto watch = [&](std::size_t i, std::span<const Eigen::Vector3d> points) {
    sampler.add(i, points, result.scans[i].origin);
    cutter.add(i, points);
  };
  if (is_seen) {
    write_registered_clouds(output.work(), inputs, result, clouds, context, kMostVoxels, watch);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (!result.has_frame_of_its_own(i)) continue;
      watch_scan(inputs, i, result, context, [&](std::size_t scan, std::span<const Eigen::Vector3d> points) {
        sampler.add(scan, points, result.scans[scan].origin);
      });
    }
  }
  const Scene scene = make_scene(result, sampler.take(view_cells(result), context.num_threads), context.num_threads);
  write_pose_file(output.work() / "poses.json",
                  {result.scans[result.reference].file, result.poses, result.survey.defined_by,
                   result.survey.has_frame ? result.survey.crs : ""});
  fs::create_directory(output.work() / "transforms");
  for (const auto& pose : result.poses) {
    if (pose.status == ScanStatus::kUnregistered) continue;
    const fs::path file = output.work() / "transforms" / (pose.file + ".txt");
    fs::create_directories(file.parent_path());  // "Setup1/scan.ply" is the name of one of several scan.ply
    write_transform(file, pose.T_reference_scan);
  }
  fs::create_directory(output.work() / "poses");
  write_pose_exports(output.work() / "poses", result.poses, pose_graph_edges(result));
  const std::vector<std::string> sums = check_sums(inputs, steps, context.num_threads);
  clock.end();
  Json report = report_object(result, options, context, description);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!sums[i].empty()) report["scans"][i]["sha256"] = sums[i];
  }
  add_options(clouds, report["options"]);
  write_text_file(output.work() / "report.json", json_text(report));
  write_text_file(output.work() / "report.html", report_html(report, scene, sections));
  if (scene.num_points() > 0) write_text_file(output.work() / "preview.png", png(preview(scene)));
  output.commit();
}

void write_result(const fs::path& folder, bool overwrite, const std::vector<fs::path>& paths, PipelineResult& result,
                  const PipelineOptions& options, const OutputOptions& clouds, const RunContext& context,
                  const RunDescription& description, const StepStore* steps) {
  write_result(folder, overwrite, scans_in_files(paths), result, options, clouds, context, description, steps);
}

}  // namespace tcm_icp
