#include "tcm_icp/pipeline/write_scan.hpp"

#include <unistd.h>

#include <algorithm>

#include "pipeline/registered_clouds.hpp"
#include "pipeline/scan_set.hpp"
#include "scans/scan_steps.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

/// Results call a scan by the end of its path.
std::size_t place_of(const fs::path& scan, const PoseFile& poses) {
  const std::string number = std::to_string(parse_scan_path(scan).number);
  fs::path whole = fs::absolute(parse_scan_path(scan).file).lexically_normal();
  if (number != "0") whole += "#" + number;
  const std::string path = whole.generic_string();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < poses.scans.size(); ++i) {
    const std::string& name = poses.scans[i].file;
    if (path == name || path.ends_with("/" + name)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  throw InvalidOptions(
      scan.string() +
      (found.empty() ? ": no scan of the result is called so" : ": several scans of the result are called so") +
      "; name the file as when the poses were found");
}

/// A folder in the result for the unfinished file, gone at the end. Machines may give processes one number, but not one
/// scan.
class Unfinished {
 public:
  Unfinished(const fs::path& folder, std::size_t scan)
      : path_(folder / (".write-" + std::to_string(scan) + "-" + std::to_string(getpid()))) {
    std::error_code error;
    fs::create_directories(path_, error);
    if (error) throw OutputError(path_, "cannot be made: " + error.message(), "check the rights of the folder");
  }
  ~Unfinished() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

std::optional<fs::path> write_scan(const StepStore& steps, const fs::path& folder, const fs::path& scan,
                                   const PoseFile& poses, const PipelineOptions& options, const OutputOptions& clouds,
                                   const RunContext& context) {
  const std::size_t place = place_of(scan, poses);
  if (poses.scans[place].status == ScanStatus::kUnregistered) return std::nullopt;
  const ScanInput input(scan);
  const ScanDetail detail =
      options.profile == Profile::kPaper ? ScanDetail::kNormals : ScanDetail::kViewpointClues;  // the key of the sample
  PipelineResult result;
  result.poses = poses.scans;
  result.scans.resize(poses.scans.size());
  for (std::size_t i = 0; i < poses.scans.size(); ++i) {
    result.scans[i].file = poses.scans[i].file;
    result.scans[i].unit = poses.scans[i].unit;
    if (poses.scans[i].status == ScanStatus::kReference) result.reference = i;
  }
  result.scans[place] = summarize(
      sample_scan_once(steps, input, options.sampling, options.outliers, context.seed, context.num_threads, detail));
  result.scans[place].file = poses.scans[place].file;
  result.survey.has_frame = !poses.frame.empty();
  result.survey.defined_by = poses.frame;
  result.survey.crs = poses.crs;
  const Unfinished unfinished(folder, place);
  const fs::path file = write_registered_scan(unfinished.path(), input, place, result, clouds, context);
  std::error_code error;
  fs::create_directories((folder / file).parent_path(), error);
  fs::rename(unfinished.path() / file, folder / file, error);
  if (error) throw OutputError(folder / file, "cannot be written: " + error.message(), "check the folder's rights");
  return folder / file;
}

}  // namespace tcm_icp
