#include "tcm_icp/pipeline/result_writer.hpp"

#include "io/text_file.hpp"
#include "pipeline/pose_graph_edges.hpp"
#include "pipeline/registered_clouds.hpp"
#include "pipeline/stage_clock.hpp"
#include "report/report_html.hpp"
#include "tcm_icp/io/output_folder.hpp"
#include "tcm_icp/io/pose_export.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"

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

}  // namespace

void check_output_folder(const fs::path& folder, bool overwrite) {
  const OutputFolder trial(folder, overwrite, kMarker);  // made and removed: better now than after the work
}

void write_result(const fs::path& folder, bool overwrite, std::span<const ScanInput> inputs, PipelineResult& result,
                  const PipelineOptions& options, const OutputOptions& clouds, const RunContext& context,
                  const RunDescription& description) {
  OutputFolder output(folder, overwrite, kMarker);
  StageClock clock(result.stages);
  clock.begin("write");
  write_registered_clouds(output.work(), inputs, result, clouds, context);
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
  clock.end();
  Json report = report_object(result, options, context, description);
  add_options(clouds, report["options"]);
  write_text_file(output.work() / "report.json", json_text(report));
  write_text_file(output.work() / "report.html", report_html(report));
  output.commit();
}

void write_result(const fs::path& folder, bool overwrite, const std::vector<fs::path>& paths, PipelineResult& result,
                  const PipelineOptions& options, const OutputOptions& clouds, const RunContext& context,
                  const RunDescription& description) {
  write_result(folder, overwrite, scans_in_files(paths), result, options, clouds, context, description);
}

}  // namespace tcm_icp
