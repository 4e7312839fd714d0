#include "open_scan.hpp"

#include <string>
#include <utility>

#include "las_source.hpp"
#include "pcd_source.hpp"
#include "ply_source.hpp"
#include "ptx_source.hpp"
#include "scan_format.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "text_clouds.hpp"
#include "text_source.hpp"

namespace tcm_icp {
namespace {

/// Which of `count` scans, from 0, is meant. @throws InputError  if none is
std::size_t index_of(const ScanPath& scan, std::size_t count) {
  const std::string name = scan.file.filename().string();
  if (scan.number == 0 && count > 1) {
    throw InputError(scan.file, "", "holds " + std::to_string(count) + " scans", "name one of them, as " + name + "#1");
  }
  if (scan.number > count) {
    throw InputError(scan.file, "",
                     "has no scan " + std::to_string(scan.number) + ": it holds " + std::to_string(count),
                     "name one of them, as " + name + "#1");
  }
  return scan.number == 0 ? 0 : scan.number - 1;
}

bool has_clouds(ScanFormat format) { return format == ScanFormat::kPtx || format == ScanFormat::kText; }

}  // namespace

std::unique_ptr<ScanSource> open_scan(const std::filesystem::path& path, ReadAttributes) {
  const ScanPath scan = parse_scan_path(path);
  InputBuffer input(scan.file);
  const ScanFormat format = format_of(input);
  CloudIs cloud = CloudIs::kAll;
  if (scan.number > 0 && has_clouds(format)) {
    cloud = CloudIs::kOneOfSeveral;
    const auto starts = find_clouds(scan.file, format);
    const CloudStart start = starts[index_of(scan, starts.size())];
    input.skip_to(start.offset, start.lines_before);
  } else if (!has_clouds(format)) {
    index_of(scan, 1);
  }
  switch (format) {
    case ScanFormat::kPly:
      return std::make_unique<PlySource>(std::move(input));
    case ScanFormat::kLas:
      return std::make_unique<LasSource>(std::move(input));
    case ScanFormat::kPcd:
      return std::make_unique<PcdSource>(std::move(input));
    case ScanFormat::kPtx:
      return std::make_unique<PtxSource>(std::move(input), cloud);
    default:
      return std::make_unique<TextSource>(std::move(input), cloud);
  }
}

std::size_t count_scans(const std::filesystem::path& file) {
  ScanFormat format;
  {
    InputBuffer input(file);
    format = format_of(input);
  }
  return has_clouds(format) ? find_clouds(file, format).size() : 1;
}

}  // namespace tcm_icp
