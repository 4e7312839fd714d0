#include "tcm_icp/pipeline/result_writer.hpp"

#include <unistd.h>

#include <fstream>

#include "stage_clock.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/registered_ply_writer.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

// Removes what it guards unless told that all went well.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& beside) : path_(beside.parent_path()) {
    std::string name(1, '.');
    name.append(beside.filename().string()).append(".tmp-").append(std::to_string(getpid()));
    path_ /= name;
    std::error_code error;
    fs::remove_all(path_, error);
    if (!fs::create_directories(path_, error) || error) {
      throw OutputError(path_, "the folder cannot be made: " + error.message(),
                        "check that its parent can be written to and the disk is not full");
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

  void move_to(const fs::path& target) {
    std::error_code error;
    if (fs::exists(target)) {
      // The old result goes only when the new one is complete.
      fs::path old = path_;
      old += "-old";
      fs::rename(target, old, error);
      if (!error) fs::rename(path_, target, error);
      if (error) {
        std::error_code ignored;
        fs::rename(old, target, ignored);
        throw OutputError(target, "the old result cannot be replaced: " + error.message(), "choose another --out");
      }
      fs::remove_all(old, error);
    } else {
      fs::rename(path_, target, error);
      if (error) throw OutputError(target, "the folder cannot be made: " + error.message(), "choose another --out");
    }
    path_.clear();
  }

 private:
  fs::path path_;
};

fs::path without_trailing_slash(const fs::path& folder) {
  const fs::path absolute = fs::absolute(folder).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

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
  const fs::path target = without_trailing_slash(folder);
  std::error_code error;
  if (fs::exists(target, error)) {
    if (!overwrite) throw OutputError(folder, "exists already", "choose another --out or give --force to replace it");
    if (!fs::is_directory(target, error)) throw OutputError(folder, "is a file", "choose a folder for --out");
    if (!fs::is_empty(target, error) && !fs::exists(target / "poses.json", error)) {
      throw OutputError(folder, "is a folder that is no earlier result (it has no poses.json)",
                        "choose another --out; --force replaces results only");
    }
  }
  const TemporaryFolder trial(target);  // made and removed: better now than after the work
}

void write_result(const fs::path& folder, bool overwrite, const std::vector<fs::path>& paths, PipelineResult& result,
                  const PipelineOptions& options, const RunContext& context, const RunDescription& description) {
  check_output_folder(folder, overwrite);
  const fs::path target = without_trailing_slash(folder);
  TemporaryFolder temporary(target);
  StageClock clock(result.stages);
  clock.begin("write");
  write_registered_cloud(temporary.path() / "registered.ply", paths, result, context);
  write_pose_file(temporary.path() / "poses.json", {result.scans[result.reference].file, result.poses});
  fs::create_directory(temporary.path() / "transforms");
  for (const auto& pose : result.poses) {
    if (pose.status == ScanStatus::kUnregistered) continue;
    write_transform(temporary.path() / "transforms" / (pose.file + ".txt"), pose.T_reference_scan);
  }
  clock.end();
  write_text(temporary.path() / "report.json", report_json(result, options, context, description));
  temporary.move_to(target);
}

}  // namespace tcm_icp
