#include "merged_record.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include "merged_columns.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp {
namespace {

void put(double value, ScalarType type, std::byte* to) {
  store_scalar(value, type, to);
  if constexpr (std::endian::native == std::endian::big) {
    std::array<std::byte, sizeof(double)> native;
    std::memcpy(native.data(), to, scalar_size(type));
    copy_reversed(native.data(), scalar_size(type), to);
  }
}

}  // namespace

MergedRecord::MergedRecord(const std::vector<std::vector<Attribute>>& scan_attributes)
    : scan_type_(scan_attributes.size() > 65536 ? ScalarType::kUInt32 : ScalarType::kUInt16) {
  MergedColumns merged = merge_columns(scan_attributes);
  columns_ = std::move(merged.columns);
  colour_offset_ = 3 * sizeof(double) + scalar_size(scan_type_);
  size_ = colour_offset_ + 3;
  std::vector<std::size_t> column_offsets;
  for (const auto& column : columns_) {
    column_offsets.push_back(size_);
    size_ += scalar_size(column.type);
  }
  for (std::size_t scan = 0; scan < scan_attributes.size(); ++scan) {
    layouts_.push_back(lay_out_scan(scan_attributes[scan], merged.column_of[scan], column_offsets));
  }
}

MergedRecord::ScanLayout MergedRecord::lay_out_scan(const std::vector<Attribute>& attributes,
                                                    const std::vector<std::size_t>& columns,
                                                    const std::vector<std::size_t>& column_offsets) const {
  ScanLayout layout;
  std::array<std::optional<Copy>, 3> normal;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const Copy copy{attributes[i].type, columns_[columns[i]].type, layout.stride, column_offsets[columns[i]]};
    layout.stride += scalar_size(copy.from_type);
    if (is_normal_component(attributes[i].name)) {
      normal[static_cast<std::size_t>(attributes[i].name[1] - 'x')] = copy;
    } else {
      layout.copies.push_back(copy);
    }
  }
  if (normal[0] && normal[1] && normal[2]) {
    layout.normal = {*normal[0], *normal[1], *normal[2]};
    return layout;
  }
  for (const auto& copy : normal) {  // nx alone is not a direction that could be turned
    if (copy) layout.copies.push_back(*copy);
  }
  return layout;
}

std::string MergedRecord::header_properties() const {
  std::string lines = "property double x\nproperty double y\nproperty double z\n";
  lines += "property " + std::string(ply_type_name(scan_type_)) + " scan\n";
  lines += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (const auto& column : columns_) {
    lines += "property " + std::string(ply_type_name(column.type)) + " " + column.name + "\n";
  }
  return lines;
}

double MergedRecord::finite_or_zero(double value, ScalarType type) {
  // A value beyond the range of a float column (a rotated normal) would become infinite there.
  if (std::isfinite(type == ScalarType::kFloat32 ? static_cast<float>(value) : value)) return value;
  ++num_replaced_;
  return 0;
}

void MergedRecord::fill(std::size_t scan, const Eigen::Vector3d& point, const std::byte* attributes,
                        const Eigen::Isometry3d& T_reference_scan, std::byte* record) {
  // R p + t as it stands: at 5,000 km a double still resolves a nanometre, so shifting first would gain nothing.
  const Eigen::Vector3d moved = T_reference_scan * point;
  if (!moved.allFinite()) throw InvalidInput("a point of scan " + std::to_string(scan) + " is not finite once moved");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(moved[static_cast<Eigen::Index>(axis)], ScalarType::kFloat64, record + axis * sizeof(double));
  }
  put(static_cast<double>(scan), scan_type_, record + 3 * sizeof(double));
  const auto colour = scan_colour(scan);
  std::memcpy(record + colour_offset_, colour.data(), colour.size());

  const auto value_of = [&](const Copy& copy) {
    return finite_or_zero(load_scalar(attributes + copy.from, copy.from_type), copy.from_type);
  };
  const ScanLayout& layout = layouts_[scan];
  for (const Copy& copy : layout.copies) put(value_of(copy), copy.to_type, record + copy.to);
  if (!layout.normal) return;
  const auto& [nx, ny, nz] = *layout.normal;
  const Eigen::Vector3d normal = T_reference_scan.linear() * Eigen::Vector3d(value_of(nx), value_of(ny), value_of(nz));
  put(finite_or_zero(normal.x(), nx.to_type), nx.to_type, record + nx.to);
  put(finite_or_zero(normal.y(), ny.to_type), ny.to_type, record + ny.to);
  put(finite_or_zero(normal.z(), nz.to_type), nz.to_type, record + nz.to);
}

}  // namespace tcm_icp
