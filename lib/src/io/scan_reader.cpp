#include "tcm_icp/io/scan_reader.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>
#include <utility>

#include "ply_source.hpp"
#include "tcm_icp/core/error.hpp"
#include "text_source.hpp"

namespace tcm_icp {
namespace {

std::unique_ptr<ScanSource> open_source(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".ply") return std::make_unique<PlySource>(path);
  for (const char* const text : {".xyz", ".txt", ".asc", ".pts", ".csv"}) {
    if (extension == text) return std::make_unique<TextSource>(path);
  }
  std::error_code unreachable;  // then it is not known to be a folder, and the extension is what there is to say
  if (std::filesystem::is_directory(path, unreachable))
    throw InputError(path, "", "is a folder", "name the files in it");
  throw InputError(path, "", "has the unknown extension '" + extension + "'",
                   "scans are read from .ply, .xyz, .txt, .asc, .pts and .csv; convert it to one of them");
}

}  // namespace

struct ScanReader::Impl {
  Impl(const std::filesystem::path& path, ReadAttributes read_attributes)
      : source(open_source(path)),
        attributes(read_attributes == ReadAttributes::kYes ? source->attributes() : std::vector<Attribute>{}),
        stride(tcm_icp::attribute_stride(attributes)) {}

  std::unique_ptr<ScanSource> source;
  std::vector<Attribute> attributes;
  std::size_t stride;
  std::uint64_t num_points = 0, num_dropped = 0;
};

ScanReader::ScanReader(const std::filesystem::path& path, ReadAttributes read_attributes)
    : impl_(std::make_unique<Impl>(path, read_attributes)) {}
ScanReader::~ScanReader() = default;
ScanReader::ScanReader(ScanReader&&) noexcept = default;
ScanReader& ScanReader::operator=(ScanReader&&) noexcept = default;

const std::vector<Attribute>& ScanReader::attributes() const { return impl_->attributes; }
std::size_t ScanReader::attribute_stride() const { return impl_->stride; }
std::uint64_t ScanReader::num_points() const { return impl_->num_points; }
std::uint64_t ScanReader::num_dropped() const { return impl_->num_dropped; }

bool ScanReader::read(PointBlock& block, std::size_t max_points) {
  if (max_points == 0) throw InvalidOptions("max_points = 0: a block holds at least one point");
  const std::size_t stride = impl_->stride;
  block.points.clear();
  block.attributes.clear();
  Eigen::Vector3d point;
  while (block.size() < max_points) {
    // One record ahead, so that the source writes in place; grown step by step, since max_points may be any number.
    block.attributes.resize((block.size() + 1) * stride);
    std::byte* const attributes = stride > 0 ? block.attributes.data() + block.size() * stride : nullptr;
    if (!impl_->source->next(point, attributes)) break;
    if (!point.allFinite()) {
      ++impl_->num_dropped;
      continue;
    }
    block.points.push_back(point);
  }
  block.attributes.resize(block.size() * stride);
  impl_->num_points += block.size();
  return block.size() > 0;
}

}  // namespace tcm_icp
