// Binary PCD 0.7 with the names PCL knows: x y z, rgb packed, normal_x and so on.

#include <algorithm>
#include <cstring>
#include <limits>

#include "cloud_sink.hpp"
#include "largest_coordinate.hpp"
#include "little_endian.hpp"
#include "scalar.hpp"

namespace tcm_icp {
namespace {

char pcd_kind(ScalarType type) {
  if (is_floating(type)) return 'F';
  return type == ScalarType::kInt8 || type == ScalarType::kInt16 || type == ScalarType::kInt32 ? 'I' : 'U';
}

bool has_name(const std::vector<RecordColumn>& columns, const std::string& name) {
  return std::any_of(columns.begin(), columns.end(), [&](const RecordColumn& c) { return c.name == name; });
}

class PcdSink : public CloudSink {
 public:
  PcdSink(std::filesystem::path path, const RecordLayout& layout, bool as_doubles)
      : CloudSink(std::move(path)), layout_(layout), as_doubles_(as_doubles) {
    const ScalarType coordinate = as_doubles ? ScalarType::kFloat64 : ScalarType::kFloat32;
    for (const char* const axis : {"x", "y", "z"}) add_field(axis, pcd_kind(coordinate), scalar_size(coordinate));
    if (layout.has_scan) add_column(layout.columns[3]);
    if (layout.has_colour) add_field("rgb", 'F', 4);
    for (std::size_t i = layout.first_attribute(); i < layout.columns.size(); ++i) add_column(layout.columns[i]);
    const std::string start = "# .PCD v0.7 - Point Cloud Data file format\n# made by tcm-icp\nVERSION 0.7\nFIELDS" +
                              names_ + "\nSIZE" + sizes_ + "\nTYPE" + kinds_ + "\nCOUNT" + counts_ + '\n';
    count_position_ = start.size();
    put(start + counts(0) + "DATA binary\n");
  }

  void write(const std::byte* records, std::size_t count) override {
    points_.resize(count * point_size_);
    std::byte* to = points_.data();
    for (std::size_t i = 0; i < count; ++i) {
      const std::byte* const record = records + i * layout_.size;
      for (std::size_t axis = 0; axis < 3; ++axis) to = append_coordinate(record + 8 * axis, to);
      if (layout_.has_scan) to = append(record, layout_.columns[3], to);
      if (layout_.has_colour) to = append_colour(record, to);
      for (std::size_t k = layout_.first_attribute(); k < layout_.columns.size(); ++k) {
        to = append(record, layout_.columns[k], to);
      }
    }
    put(points_.data(), points_.size());
  }

 private:
  void add_field(const std::string& name, char kind, std::size_t size) {
    names_ += ' ' + name;
    sizes_ += ' ' + std::to_string(size);
    kinds_ += std::string(" ") + kind;
    counts_ += " 1";
    point_size_ += size;
  }

  /// Under the name PCL has for it, but not under one that it takes for something else.
  void add_column(const RecordColumn& column) {
    std::string name = column.name;
    if (name == "nx" || name == "ny" || name == "nz") {
      const std::string long_name = std::string("normal_") + name[1];
      if (!has_name(layout_.columns, long_name)) name = long_name;
    }
    if (name == "rgb" || name == "rgba" || name == "_") {
      do {
        name.insert(0, "input_");
      } while (has_name(layout_.columns, name));
    }
    add_field(name, pcd_kind(column.type), scalar_size(column.type));
  }

  std::byte* append_coordinate(const std::byte* from, std::byte* to) const {
    if (as_doubles_) {
      std::memcpy(to, from, sizeof(double));
      return to + sizeof(double);
    }
    const auto value = static_cast<float>(load<double>(from));
    std::memcpy(to, &value, sizeof value);
    return to + sizeof value;
  }

  static std::byte* append(const std::byte* record, const RecordColumn& column, std::byte* to) {
    std::memcpy(to, record + column.offset, scalar_size(column.type));
    return to + scalar_size(column.type);
  }

  /// One number of three bytes, blue first.
  std::byte* append_colour(const std::byte* record, std::byte* to) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const RecordColumn& column = layout_.columns[layout_.first_colour() + i];
      to[2 - i] = static_cast<std::byte>(colour_byte(record + column.offset, column.type));
    }
    to[3] = std::byte{0};
    return to + 4;
  }

  static std::string counts(std::uint64_t count) {
    return count_lines("#", "WIDTH", count) + "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n" + count_lines("#", "POINTS", count);
  }

  void complete(std::uint64_t num_points) override {
    go_to(count_position_);
    put(counts(num_points));
  }

  RecordLayout layout_;
  bool as_doubles_;
  std::string names_, sizes_, kinds_, counts_;
  std::size_t point_size_ = 0;  ///< [bytes]
  std::uint64_t count_position_ = 0;
  std::vector<std::byte> points_;  ///< of one block
};

}  // namespace

bool pcd_needs_doubles(const Eigen::AlignedBox3d& box, double largest_step) {
  if (box.isEmpty()) return false;
  return largest_coordinate(box) * std::numeric_limits<float>::epsilon() > largest_step;
}

std::unique_ptr<CloudSink> open_pcd(std::filesystem::path path, const RecordLayout& layout,
                                    const RegisteredCloudOptions& options) {
  return std::make_unique<PcdSink>(std::move(path), layout, pcd_needs_doubles(options.box, options.largest_step));
}

}  // namespace tcm_icp
