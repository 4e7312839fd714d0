#include "merged_record.hpp"

#include <cmath>
#include <cstring>

#include "merged_columns.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp {

MergedRecord::MergedRecord(const std::vector<std::vector<Attribute>>& scan_attributes, CloudColour colour,
                           bool one_scan) {
  const MergedColumns merged = merge_columns(scan_attributes, colour, one_scan);
  for (const char* const axis : {"x", "y", "z"}) add_column(axis, ScalarType::kFloat64);
  layout_.has_scan = !one_scan;
  if (layout_.has_scan) add_column("scan", scan_attributes.size() > 65536 ? ScalarType::kUInt32 : ScalarType::kUInt16);
  layout_.colour_is_by_scan = merged.has_colour_by_scan;
  layout_.has_colour = merged.has_colour_by_scan || merged.has_own_colour;
  if (merged.has_colour_by_scan) {
    for (const char* const name : {"red", "green", "blue"}) add_column(name, ScalarType::kUInt8);
  }
  first_column_ = layout_.columns.size();
  for (const auto& column : merged.columns) add_column(column.name, column.type);
  for (std::size_t scan = 0; scan < scan_attributes.size(); ++scan) {
    layouts_.push_back(lay_out_scan(scan_attributes[scan], merged.column_of[scan]));
  }
}

void MergedRecord::add_column(const std::string& name, ScalarType type) {
  layout_.columns.push_back({name, type, layout_.size});
  layout_.size += scalar_size(type);
}

MergedRecord::ScanLayout MergedRecord::lay_out_scan(const std::vector<Attribute>& attributes,
                                                    const std::vector<std::size_t>& columns) const {
  ScanLayout layout;
  std::array<std::optional<Copy>, 3> normal;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const RecordColumn& column = layout_.columns[first_column_ + columns[i]];
    Copy copy{attributes[i].type, column.type, layout.stride, column.offset};
    const bool is_own_colour = layout_.has_colour && !layout_.colour_is_by_scan && columns[i] < 3;
    if (is_own_colour && copy.from_type != copy.to_type) copy.factor = 257;  // 255 becomes 65535
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
    store_scalar(moved[static_cast<Eigen::Index>(axis)], ScalarType::kFloat64, record + axis * sizeof(double));
  }
  const auto& columns = layout_.columns;
  if (layout_.has_scan) store_scalar(static_cast<double>(scan), columns[3].type, record + columns[3].offset);
  if (layout_.colour_is_by_scan) {
    const auto colour = scan_colour(scan);
    std::memcpy(record + columns[layout_.first_colour()].offset, colour.data(), colour.size());
  }

  const auto value_of = [&](const Copy& copy) {
    return finite_or_zero(load_scalar(attributes + copy.from, copy.from_type), copy.from_type);
  };
  const ScanLayout& layout = layouts_[scan];
  for (const Copy& copy : layout.copies) store_scalar(copy.factor * value_of(copy), copy.to_type, record + copy.to);
  if (!layout.normal) return;
  const auto& [nx, ny, nz] = *layout.normal;
  const Eigen::Vector3d normal = T_reference_scan.linear() * Eigen::Vector3d(value_of(nx), value_of(ny), value_of(nz));
  store_scalar(finite_or_zero(normal.x(), nx.to_type), nx.to_type, record + nx.to);
  store_scalar(finite_or_zero(normal.y(), ny.to_type), ny.to_type, record + ny.to);
  store_scalar(finite_or_zero(normal.z(), nz.to_type), nz.to_type, record + nz.to);
}

}  // namespace tcm_icp
