#include "pipeline/kept_set.hpp"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>

#include "scans/scan_steps.hpp"
#include "steps/step_key.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

constexpr double kMostOff = 1.1;
constexpr const char* kHead = "tcm-icp set 1";

struct SetFile {
  std::string options;  ///< digest of what the resolutions depend on beside the scans
  Resolutions resolutions;
  std::string base = "-";  ///< name of the file of the set they are kept from
  std::vector<std::string> scans;
};

std::optional<SetFile> read_set(const fs::path& path) {
  std::ifstream in(path);
  std::string head, word;
  SetFile set;
  std::size_t num_scans = 0;
  if (!std::getline(in, head) || head != kHead) return std::nullopt;
  if (!(in >> set.options >> set.resolutions.coarse_m >> set.resolutions.fine_m >> set.base >> num_scans)) {
    return std::nullopt;
  }
  while (in >> word) set.scans.push_back(word);
  if (set.scans.size() != num_scans) return std::nullopt;
  return set;
}

void write_set(const StepStore& store, const fs::path& path, const SetFile& set) {
  std::ostringstream out;
  out << kHead << '\n'
      << set.options << '\n'
      << std::setprecision(std::numeric_limits<double>::max_digits10) << set.resolutions.coarse_m << ' '
      << set.resolutions.fine_m << '\n'
      << set.base << '\n'
      << set.scans.size() << '\n';
  for (const auto& scan : set.scans) out << scan << '\n';
  write_whole(path, out.str(), store.folder() / "unfinished");
}

bool near(double a, double b) { return a <= kMostOff * b && b <= kMostOff * a; }

}  // namespace

KeptSet keep_resolutions(const StepStore& store, const std::vector<SampledScan>& scans, const SamplingOptions& options,
                         const Resolutions& own) {
  const fs::path folder = store.folder() / "sets";
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  SetFile set;
  set.options = step_key("sets", options.coarse_voxels, options.fine_voxels).digest;
  set.resolutions = own;
  for (const auto& scan : scans) set.scans.push_back(scan.digest);
  const fs::path path = folder / step_key("sets", set.options, set.scans).digest;
  const auto with_base = [&](const SetFile& file) {
    const auto base = file.base == "-" ? std::nullopt : read_set(folder / file.base);
    return KeptSet{file.resolutions, base ? base->scans : std::vector<std::string>()};
  };
  if (const auto known = read_set(path)) return with_base(*known);

  std::vector<std::string> sorted = set.scans;
  std::sort(sorted.begin(), sorted.end());
  std::size_t most = 0;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    std::optional<SetFile> other = read_set(entry.path());
    if (!other || other->options != set.options) continue;
    std::sort(other->scans.begin(), other->scans.end());
    const bool is_part = std::includes(sorted.begin(), sorted.end(), other->scans.begin(), other->scans.end());
    const std::string name = entry.path().filename().string();
    const std::size_t size = other->scans.size();
    if (!is_part || size < most || (size == most && name > set.base)) continue;
    if (!near(other->resolutions.coarse_m, own.coarse_m) || !near(other->resolutions.fine_m, own.fine_m)) continue;
    most = size;
    set.base = name;
    set.resolutions = other->resolutions;
  }
  write_set(store, path, set);
  return with_base(set);
}

std::vector<std::string> prepared_digests(const std::vector<std::string>& samples, const Resolutions& resolutions,
                                          const SampleSizes& sizes, std::uint64_t seed) {
  std::vector<std::string> out;
  for (const auto& sample : samples) out.push_back(prepared_digest(sample, resolutions, sizes, seed));
  return out;
}

}  // namespace tcm_icp
