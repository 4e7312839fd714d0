#include "tcm_icp/io/registered_ply_writer.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "merged_columns.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kCountDigits = 20;  // of the largest 64-bit number

/// The count and the padding before it always have the same length, so that finish() can overwrite them in place.
std::string count_lines(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  return "comment " + std::string(1 + kCountDigits - digits.size(), '-') + "\nelement vertex " + digits + "\n";
}

/// A file name as a header comment may hold it: on one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = '?';
  }
  return text;
}

void put(double value, ScalarType type, std::byte* to) {
  store_scalar(value, type, to);
  if constexpr (std::endian::native == std::endian::big) {
    std::array<std::byte, sizeof(double)> native;
    std::memcpy(native.data(), to, scalar_size(type));
    copy_reversed(native.data(), scalar_size(type), to);
  }
}

}  // namespace

struct RegisteredPlyWriter::Impl {
  /// Where one of a scan's attributes is read from and goes to.
  struct Copy {
    ScalarType from_type, to_type;
    std::size_t from, to;  ///< [bytes] in the point's attributes, in the record
  };
  struct ScanLayout {
    std::vector<Copy> copies;  ///< but for the normal, where it is whole
    std::optional<std::array<Copy, 3>> normal;
    std::size_t stride = 0;
  };

  Impl(std::filesystem::path file, std::vector<std::vector<Attribute>> attributes, const std::string& reference)
      : path(std::move(file)), scan_attributes(std::move(attributes)), merged(merge_columns(scan_attributes)) {
    scan_type = scan_attributes.size() > 65536 ? ScalarType::kUInt32 : ScalarType::kUInt16;
    lay_out();
    stream.open(path, std::ios::binary | std::ios::trunc);
    if (!stream) throw OutputError(path, "cannot be written", "check that the folder is there and may be written to");
    write_header(reference);
  }

  void lay_out() {
    colour_offset = 3 * sizeof(double) + scalar_size(scan_type);
    std::size_t offset = colour_offset + 3;
    std::vector<std::size_t> column_offsets;
    for (const auto& column : merged.columns) {
      column_offsets.push_back(offset);
      offset += scalar_size(column.type);
    }
    record_size = offset;
    for (std::size_t scan = 0; scan < scan_attributes.size(); ++scan) {
      layouts.push_back(lay_out_scan(scan_attributes[scan], merged.column_of[scan], column_offsets));
    }
  }

  ScanLayout lay_out_scan(const std::vector<Attribute>& attributes, const std::vector<std::size_t>& columns,
                          const std::vector<std::size_t>& column_offsets) const {
    ScanLayout layout;
    std::array<std::optional<Copy>, 3> normal;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const Copy copy{attributes[i].type, merged.columns[columns[i]].type, layout.stride, column_offsets[columns[i]]};
      layout.stride += scalar_size(copy.from_type);
      if (is_normal_component(attributes[i].name)) {
        normal[static_cast<std::size_t>(attributes[i].name[1] - 'x')] = copy;
      } else {
        layout.copies.push_back(copy);
      }
    }
    if (normal[0] && normal[1] && normal[2]) {
      layout.normal = {*normal[0], *normal[1], *normal[2]};
    } else {  // nx alone is not a direction that could be turned
      for (const auto& copy : normal) {
        if (copy) layout.copies.push_back(*copy);
      }
    }
    return layout;
  }

  void write_header(const std::string& reference) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment made by tcm-icp\n";
    header += "comment frame: that of the scan " + one_line(reference) + "\n";
    header += "comment scan: index of the input file, from 0; red green blue: colour by scan\n";
    count_position = static_cast<std::streamoff>(header.size());
    header += count_lines(0) + "property double x\nproperty double y\nproperty double z\n";
    header += "property " + std::string(ply_type_name(scan_type)) + " scan\n";
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    for (const auto& column : merged.columns) {
      header += "property " + std::string(ply_type_name(column.type)) + " " + column.name + "\n";
    }
    header += "end_header\n";
    stream.write(header.data(), static_cast<std::streamsize>(header.size()));
    check_stream();
  }

  void check_stream() const {
    if (!stream) throw OutputError(path, "cannot be written", "check the free space on the disk");
  }

  void check_block(std::size_t scan_index, const PointBlock& block, const std::vector<Attribute>& attributes) const {
    if (scan_index >= layouts.size()) throw InvalidInput("scan " + std::to_string(scan_index) + " was not announced");
    if (attributes != scan_attributes[scan_index] ||
        block.attributes.size() != block.size() * layouts[scan_index].stride) {
      throw InvalidInput("the attributes of scan " + std::to_string(scan_index) + " are not those announced");
    }
  }

  double finite_or_zero(double value, ScalarType type) {
    // A double beyond the range of a float column (a rotated normal) would become infinite there.
    const bool stays_finite = std::isfinite(type == ScalarType::kFloat32 ? static_cast<float>(value) : value);
    if (!stays_finite) ++num_replaced;
    return stays_finite ? value : 0;
  }

  void fill_attributes(const ScanLayout& layout, const std::byte* from, const Eigen::Matrix3d& R, std::byte* record) {
    for (const Copy& copy : layout.copies) {
      put(finite_or_zero(load_scalar(from + copy.from, copy.from_type), copy.to_type), copy.to_type, record + copy.to);
    }
    if (!layout.normal) return;
    Eigen::Vector3d normal;
    for (std::size_t i = 0; i < 3; ++i) {
      const Copy& copy = (*layout.normal)[i];
      normal[static_cast<Eigen::Index>(i)] =
          finite_or_zero(load_scalar(from + copy.from, copy.from_type), copy.from_type);
    }
    normal = R * normal;
    for (std::size_t i = 0; i < 3; ++i) {
      const Copy& copy = (*layout.normal)[i];
      put(finite_or_zero(normal[static_cast<Eigen::Index>(i)], copy.to_type), copy.to_type, record + copy.to);
    }
  }

  void fill_record(std::size_t scan_index, const Eigen::Vector3d& point, std::byte* record) const {
    if (!point.allFinite()) throw InvalidInput("a point of scan " + std::to_string(scan_index) + " is not finite");
    for (int axis = 0; axis < 3; ++axis) put(point[axis], ScalarType::kFloat64, record + axis * sizeof(double));
    put(static_cast<double>(scan_index), scan_type, record + 3 * sizeof(double));
    const auto colour = scan_colour(scan_index);
    std::memcpy(record + colour_offset, colour.data(), colour.size());
  }

  std::filesystem::path path;
  std::vector<std::vector<Attribute>> scan_attributes;
  MergedColumns merged;
  ScalarType scan_type = ScalarType::kUInt16;
  std::size_t colour_offset = 0, record_size = 0;
  std::vector<ScanLayout> layouts;
  std::ofstream stream;
  std::streamoff count_position = 0;
  std::vector<std::byte> records;
  std::uint64_t num_points = 0, num_replaced = 0;
};

RegisteredPlyWriter::RegisteredPlyWriter(std::filesystem::path path,
                                         std::vector<std::vector<Attribute>> scan_attributes,
                                         const std::string& reference)
    : impl_(std::make_unique<Impl>(std::move(path), std::move(scan_attributes), reference)) {}
RegisteredPlyWriter::~RegisteredPlyWriter() = default;
RegisteredPlyWriter::RegisteredPlyWriter(RegisteredPlyWriter&&) noexcept = default;
RegisteredPlyWriter& RegisteredPlyWriter::operator=(RegisteredPlyWriter&&) noexcept = default;

std::uint64_t RegisteredPlyWriter::num_points() const { return impl_->num_points; }
std::uint64_t RegisteredPlyWriter::num_replaced() const { return impl_->num_replaced; }

void RegisteredPlyWriter::write(std::size_t scan_index, const PointBlock& block,
                                const std::vector<Attribute>& attributes, const Eigen::Isometry3d& T_reference_scan) {
  Impl& impl = *impl_;
  impl.check_block(scan_index, block, attributes);
  const auto& layout = impl.layouts[scan_index];
  const Eigen::Matrix3d R = T_reference_scan.linear();
  impl.records.assign(block.size() * impl.record_size, std::byte{});
  for (std::size_t i = 0; i < block.size(); ++i) {
    std::byte* const record = impl.records.data() + i * impl.record_size;
    // R p + t as it stands: at 5,000 km a double still resolves a nanometre, so shifting first would gain nothing.
    impl.fill_record(scan_index, T_reference_scan * block.points[i], record);
    impl.fill_attributes(layout, block.attributes.data() + i * layout.stride, R, record);
  }
  impl.stream.write(reinterpret_cast<const char*>(impl.records.data()),
                    static_cast<std::streamsize>(impl.records.size()));
  impl.check_stream();
  impl.num_points += block.size();
}

void RegisteredPlyWriter::finish() {
  impl_->stream.flush();
  impl_->check_stream();
  impl_->stream.seekp(impl_->count_position);
  const std::string lines = count_lines(impl_->num_points);
  impl_->stream.write(lines.data(), static_cast<std::streamsize>(lines.size()));
  impl_->stream.close();  // fails where the last bytes do not find room
  impl_->check_stream();
}

}  // namespace tcm_icp
