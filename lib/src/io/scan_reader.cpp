#include "tcm_icp/io/scan_reader.hpp"

#include <string>
#include <utility>

#include "open_scan.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
struct ScanReader::Impl {
  Impl(std::filesystem::path scan_path, std::unique_ptr<ScanSource> scan_source, ReadAttributes read_attributes,
       LengthUnit unit)
      : path(std::move(scan_path)),
        source(std::move(scan_source)),
        attributes(read_attributes == ReadAttributes::kYes ? source->attributes() : std::vector<Attribute>{}),
        stride(tcm_icp::attribute_stride(attributes)),
        metres_per_unit(metres_in(unit)) {}

  std::filesystem::path path;
  std::unique_ptr<ScanSource> source;
  std::vector<Attribute> attributes;
  std::size_t stride;
  double metres_per_unit;
  std::uint64_t num_points = 0, num_dropped = 0;
};

ScanReader::ScanReader(const std::filesystem::path& path, ReadAttributes read_attributes)
    : ScanReader(ScanInput(path), read_attributes) {}

ScanReader::ScanReader(const ScanInput& scan, ReadAttributes read_attributes) {
  auto source = scan.is_file() ? open_scan(scan.path, read_attributes) : scan.open();
  if (!source) throw InvalidInput(scan.path.string() + ": its opener gave no source");
  const LengthUnit unit = scan.is_file() ? parse_scan_path(scan.path).unit : LengthUnit::kMetre;
  impl_ = std::make_unique<Impl>(scan.path, std::move(source), read_attributes, unit);
}

ScanReader::~ScanReader() = default;
ScanReader::ScanReader(ScanReader&&) noexcept = default;
ScanReader& ScanReader::operator=(ScanReader&&) noexcept = default;

const std::vector<Attribute>& ScanReader::attributes() const { return impl_->attributes; }
std::size_t ScanReader::attribute_stride() const { return impl_->stride; }
std::uint64_t ScanReader::num_points() const { return impl_->num_points; }
std::uint64_t ScanReader::num_dropped() const { return impl_->num_dropped; }

std::optional<Eigen::Isometry3d> ScanReader::header_pose() const {
  const auto matrix = impl_->source->header_pose();
  if (!matrix) return std::nullopt;
  constexpr double kRigidOnReading = 1e-3;  // matrices written with few digits pass, a scale or a mirror image does not
  if (!is_rigid(*matrix, kRigidOnReading)) {
    throw InputError(impl_->path, "header", "the scan's transformation is not a rigid motion",
                     "leave out --init headers, or export the scan without scale");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = project_onto_so3(matrix->topLeftCorner<3, 3>());
  pose.translation() = impl_->metres_per_unit * matrix->topRightCorner<3, 1>();
  return pose;
}

std::string ScanReader::coordinate_system() const { return impl_->source->coordinate_system(); }

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
    block.points.push_back(impl_->metres_per_unit * point);  // times 1 keeps every bit
  }
  block.attributes.resize(block.size() * stride);
  impl_->num_points += block.size();
  return block.size() > 0;
}

}  // namespace tcm_icp
