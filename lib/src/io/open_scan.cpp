#include "open_scan.hpp"

#include <string>
#include <utility>
#include <vector>

#include "bin_source.hpp"
#include "e57_source.hpp"
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

/// @throws InputError  if there is none
std::pair<E57Pages, std::vector<E57Scan>> e57_scans(const std::filesystem::path& file) {
  E57Pages pages(file);
  std::vector<E57Scan> scans = read_e57_scans(pages);
  if (scans.empty()) throw InputError(file, "XML part", "holds no scan", "leave the file out");
  return {std::move(pages), std::move(scans)};
}

std::unique_ptr<ScanSource> open_e57(const ScanPath& scan, ReadAttributes read_attributes) {
  auto [pages, scans] = e57_scans(scan.file);
  E57Scan chosen = std::move(scans[index_of(scan, scans.size())]);
  return std::make_unique<E57Source>(std::move(pages), std::move(chosen), read_attributes);
}

bool has_clouds(ScanFormat format) { return format == ScanFormat::kPtx || format == ScanFormat::kText; }

}  // namespace

std::unique_ptr<ScanSource> open_scan(const std::filesystem::path& path, ReadAttributes read_attributes) {
  const ScanPath scan = parse_scan_path(path);
  InputBuffer input(scan.file);
  if (scan.bin != BinLayout::kNone) return std::make_unique<BinSource>(std::move(input), scan.bin);
  const ScanFormat format = format_of(input);
  if (format == ScanFormat::kE57) return open_e57(scan, read_attributes);
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
  if (format == ScanFormat::kE57) return e57_scans(file).second.size();
  return has_clouds(format) ? find_clouds(file, format).size() : 1;
}

}  // namespace tcm_icp
