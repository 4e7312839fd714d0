#include "tcm_icp/pipeline/result_writer.hpp"

#include <fstream>

#include "pipeline/pose_graph_edges.hpp"
#include "pipeline/stage_clock.hpp"
#include "report/report_html.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/io/output_folder.hpp"
#include "tcm_icp/io/pose_export.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/registered_ply_writer.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

// The file by which --force knows an earlier result.
constexpr const char* kMarker = "poses.json";

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw OutputError(path, "cannot be written", "check that the disk is not full");
}

void write_registered_cloud(const fs::path& path, const std::vector<fs::path>& paths, const PipelineResult& result,
                            const RunContext& context) {
  std::vector<std::vector<Attribute>> attributes;
  for (const auto& p : paths) attributes.push_back(ScanReader(p).attributes());
  RegisteredPlyWriter writer(path, attributes, result.scans[result.reference].file);
  PointBlock block, kept;
  std::vector<char> outlier;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (result.poses[i].status == ScanStatus::kUnregistered) continue;
    const ScanSummary& scan = result.scans[i];
    ScanReader reader(paths[i]);
    const std::size_t stride = reader.attribute_stride();
    while (reader.read(block)) {
      context.report("writing", i, paths.size());
      kept.points.clear();
      kept.attributes.clear();
      outlier.resize(block.size());
      parallel_for(context.num_threads, block.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          outlier[k] = scan.outliers.is_outlier(block.points[k] - scan.origin) ? 1 : 0;
        }
      });
      for (std::size_t k = 0; k < block.size(); ++k) {
        if (outlier[k] != 0) continue;
        kept.points.push_back(block.points[k]);
        const auto* bytes = block.attributes.data() + k * stride;
        kept.attributes.insert(kept.attributes.end(), bytes, bytes + stride);
      }
      if (kept.size() > 0) writer.write(i, kept, attributes[i], result.poses[i].T_reference_scan);
    }
  }
  writer.finish();
  if (writer.num_replaced() > 0) {
    context.warn(std::to_string(writer.num_replaced()) +
                 " attribute values were NaN or infinite and are 0 in registered.ply");
  }
}

}  // namespace

void check_output_folder(const fs::path& folder, bool overwrite) {
  const OutputFolder trial(folder, overwrite, kMarker);  // made and removed: better now than after the work
}

void write_result(const fs::path& folder, bool overwrite, const std::vector<fs::path>& paths, PipelineResult& result,
                  const PipelineOptions& options, const RunContext& context, const RunDescription& description) {
  OutputFolder output(folder, overwrite, kMarker);
  StageClock clock(result.stages);
  clock.begin("write");
  write_registered_cloud(output.work() / "registered.ply", paths, result, context);
  write_pose_file(output.work() / "poses.json", {result.scans[result.reference].file, result.poses});
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
  const Json report = report_object(result, options, context, description);
  write_text(output.work() / "report.json", json_text(report));
  write_text(output.work() / "report.html", report_html(report));
  output.commit();
}

}  // namespace tcm_icp
