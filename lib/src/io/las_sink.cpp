// LAS 1.4, point format 7 or 8 (ASPRS LAS 1.4 R15): what the format has fields for goes there, all else is extra bytes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string_view>

#include "cloud_sink.hpp"
#include "las_header.hpp"
#include "las_scale.hpp"
#include "little_endian.hpp"
#include "number_text.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"
#include "well_known_text.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kHeaderSize = 375, kRecordHeader = 54, kMostExtras = 65535 / kLasExtraEntry;
constexpr std::uint16_t kExtraBytes = 4, kWellKnownText = 2112;           // by which records are called
constexpr std::size_t kIntensityAt = 12, kSourceAt = 20, kColourAt = 30;  // in a point
constexpr const char* kRemedy = "use --format ply";

enum class Rule { kCopy, kBits, kAngle, kColourByte, kScan, kIntensity };

/// A field of a point, and the column that fits it.
struct LasField {
  std::string_view name;
  ScalarType type;
  Rule rule;
  std::size_t to;  ///< [bytes]
  unsigned mask = 0, shift = 0;
};

constexpr std::array<LasField, 13> kFields{{{"intensity", ScalarType::kUInt16, Rule::kCopy, kIntensityAt},
                                            {"return_number", ScalarType::kUInt8, Rule::kBits, 14, 15, 0},
                                            {"number_of_returns", ScalarType::kUInt8, Rule::kBits, 14, 15, 4},
                                            {"classification_flags", ScalarType::kUInt8, Rule::kBits, 15, 15, 0},
                                            {"scanner_channel", ScalarType::kUInt8, Rule::kBits, 15, 3, 4},
                                            {"scan_direction_flag", ScalarType::kUInt8, Rule::kBits, 15, 1, 6},
                                            {"edge_of_flight_line", ScalarType::kUInt8, Rule::kBits, 15, 1, 7},
                                            {"classification", ScalarType::kUInt8, Rule::kCopy, 16},
                                            {"user_data", ScalarType::kUInt8, Rule::kCopy, 17},
                                            {"scan_angle", ScalarType::kFloat32, Rule::kAngle, 18},
                                            {"point_source_id", ScalarType::kUInt16, Rule::kCopy, kSourceAt},
                                            {"gps_time", ScalarType::kFloat64, Rule::kCopy, 22},
                                            {"nir", ScalarType::kUInt16, Rule::kCopy, 36}}};

/// Names that readers give to fields, so that extra bytes must not have them.
bool is_field_name(std::string_view name) {
  static const std::set<std::string_view> kOthers{"X", "Y", "Z", "red", "green", "blue"};
  return kOthers.contains(name) ||
         std::any_of(kFields.begin(), kFields.end(), [&](const LasField& field) { return field.name == name; });
}

/// The number by which the description of extra bytes calls a type.
std::uint8_t extra_type(ScalarType type) {
  constexpr std::array<std::uint8_t, 8> kTypes{2, 1, 4, 3, 6, 5, 9, 10};  // in the order of ScalarType
  return kTypes[static_cast<std::size_t>(type)];
}

class LasSink : public CloudSink {
 public:
  LasSink(std::filesystem::path path, const RecordLayout& layout, const RegisteredCloudOptions& options)
      : CloudSink(std::move(path)),
        layout_(layout),
        source_id_(options.point_source_id),
        least_intensity_(options.least_intensity),
        most_intensity_(options.most_intensity) {
    scale_ = choose_las_scale(options.box);
    if (scale_.step > options.largest_step && scale_.is_by_extent) {
      throw OutputError(this->path(),
                        "cannot hold coordinates that reach this far: its 32-bit integers would round them to " +
                            shortest_digits(scale_.step) + ", more than a millionth of a scan",
                        kRemedy);
    }
    lay_out();
    if (las_names_crs(options.crs)) {
      add_record("LASF_Projection", kWellKnownText, "well-known text", *well_known_text(options.crs) + '\0');
    }
    if (!extras_.empty()) add_record("LASF_Spec", kExtraBytes, "extra bytes", extra_bytes());
    put(header(0));
    put(records_);
  }

  void write(const std::byte* records, std::size_t count) override {
    points_.assign(count * point_size_, std::byte{});
    for (std::size_t i = 0; i < count; ++i) fill(records + i * layout_.size, points_.data() + i * point_size_);
    put(points_.data(), points_.size());
  }

 private:
  struct Copy {
    Rule rule;
    std::size_t from, to, size;
    unsigned mask, shift;
    std::string_view name;
  };

  void lay_out() {
    const auto& columns = layout_.columns;
    if (layout_.has_scan) copies_.push_back({Rule::kScan, columns[3].offset, kSourceAt, 0, 0, 0, "scan"});
    for (std::size_t i = layout_.first_colour(); i < layout_.first_attribute(); ++i) {
      const bool is_byte = columns[i].type == ScalarType::kUInt8;
      copies_.push_back({is_byte ? Rule::kColourByte : Rule::kCopy, columns[i].offset,
                         kColourAt + 2 * (i - layout_.first_colour()), 2, 0, 0, columns[i].name});
    }
    std::vector<RecordColumn> extras;
    for (std::size_t i = layout_.first_attribute(); i < columns.size(); ++i) {
      if (add_field(columns[i])) continue;
      extras.push_back(columns[i]);
      // To look at; the extra bytes keep what it is.
      if (columns[i].name == "intensity") add_scaled_intensity(columns[i]);
    }
    point_format_ = has_nir_ ? 8 : 7;
    point_size_ = las_point_size(point_format_);
    for (const auto& column : extras) {
      copies_.push_back({Rule::kCopy, column.offset, point_size_, scalar_size(column.type), 0, 0, ""});
      point_size_ += scalar_size(column.type);
      extras_.push_back({extra_name(column.name), column.type});
    }
    if (extras.size() > kMostExtras || point_size_ > std::numeric_limits<std::uint16_t>::max()) {
      throw OutputError(path(), "cannot hold " + std::to_string(extras.size()) + " more columns a point", kRemedy);
    }
  }

  bool add_field(const RecordColumn& column) {
    const auto at = std::find_if(kFields.begin(), kFields.end(), [&](const LasField& field) {
      return field.name == column.name && field.type == column.type;
    });
    if (at == kFields.end() || (layout_.has_scan && at->to == kSourceAt)) return false;
    has_nir_ = has_nir_ || at->name == "nir";
    has_returns_ = has_returns_ || at->to == 14;
    has_source_ = has_source_ || at->to == kSourceAt;
    copies_.push_back({at->rule, column.offset, at->to, scalar_size(column.type), at->mask, at->shift, at->name});
    return true;
  }

  void add_scaled_intensity(const RecordColumn& column) {
    intensity_type_ = column.type;
    copies_.push_back({Rule::kIntensity, column.offset, kIntensityAt, 2, 0, 0, column.name});
  }

  /// At most 32 bytes, as the format has it; not the name of a field or of other extra bytes.
  std::string extra_name(std::string name) const {
    constexpr std::size_t kLongest = 32;
    if (is_field_name(name)) name.insert(0, "input_");
    const auto is_taken = [&](const std::string& text) {
      return std::any_of(extras_.begin(), extras_.end(), [&](const Attribute& extra) { return extra.name == text; });
    };
    std::string unique = name.substr(0, kLongest);
    for (int k = 2; is_taken(unique); ++k) {
      const std::string ending = '_' + std::to_string(k);
      unique = name.substr(0, kLongest - ending.size()) + ending;
    }
    return unique;
  }

  [[noreturn]] void refuse(std::string_view name, double value) const {
    throw OutputError(path(), "has no room for the " + std::string(name) + " " + shortest_digits(value) + " of a point",
                      kRemedy);
  }

  void fill(const std::byte* record, std::byte* point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = load<double>(record + axis * sizeof(double));
      const double steps = std::round((value - scale_.offset[static_cast<Eigen::Index>(axis)]) / scale_.step);
      if (!(std::abs(steps) <= std::numeric_limits<std::int32_t>::max())) refuse("coordinate", value);
      const auto number = static_cast<std::int32_t>(steps);
      std::memcpy(point + 4 * axis, &number, sizeof number);
      least_[axis] = std::min(least_[axis], number);
      most_[axis] = std::max(most_[axis], number);
    }
    if (!has_source_) std::memcpy(point + kSourceAt, &source_id_, sizeof source_id_);
    if (!has_returns_) point[14] = std::byte{0x11};  // the first of one
    for (const Copy& copy : copies_) fill(copy, record + copy.from, point + copy.to);
    const unsigned return_number = std::to_integer<unsigned>(point[14]) & 15U;
    if (return_number > 0) ++by_return_[return_number - 1];
  }

  void fill(const Copy& copy, const std::byte* from, std::byte* to) const {
    switch (copy.rule) {
      case Rule::kCopy:
        std::memcpy(to, from, copy.size);
        break;
      case Rule::kBits: {
        const auto value = std::to_integer<unsigned>(*from);
        if ((value & ~copy.mask) != 0) refuse(copy.name, value);
        *to |= static_cast<std::byte>(value << copy.shift);
        break;
      }
      case Rule::kAngle: {
        const double degrees = load<float>(from), steps = std::round(degrees / 0.006);
        if (!(std::abs(steps) <= 32767)) refuse(copy.name, degrees);
        const auto number = static_cast<std::int16_t>(steps);
        std::memcpy(to, &number, sizeof number);
        break;
      }
      case Rule::kColourByte: {  // 255 becomes 65535, as the standard asks for
        const auto value = static_cast<std::uint16_t>(257 * std::to_integer<unsigned>(*from));
        std::memcpy(to, &value, sizeof value);
        break;
      }
      case Rule::kIntensity: {
        const double share =
            (load_scalar(from, intensity_type_) - least_intensity_) / (most_intensity_ - least_intensity_);
        const auto value = static_cast<std::uint16_t>(std::round(65535 * std::clamp(share, 0.0, 1.0)));
        std::memcpy(to, &value, sizeof value);
        break;
      }
      case Rule::kScan: {
        const double number = load_scalar(from, layout_.columns[3].type) + 1;  // 0 means "this file" in LAS
        if (number > 65535) refuse("scan number", number);
        const auto id = static_cast<std::uint16_t>(number);
        std::memcpy(to, &id, sizeof id);
        break;
      }
    }
  }

  std::string header(std::uint64_t num_points) const {
    std::string bytes(kHeaderSize, '\0');
    const auto set = [&](std::size_t at, const auto& value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
    bytes.replace(0, 4, "LASF");
    set(6, std::uint16_t{16});  // coordinate systems are given as well-known text, as formats from 6 on ask for
    set(24, std::uint8_t{1});
    set(25, std::uint8_t{4});
    bytes.replace(26, 14, "TRANSFORMATION");
    bytes.replace(58, 7, "tcm-icp");
    set(94, static_cast<std::uint16_t>(kHeaderSize));
    set(96, static_cast<std::uint32_t>(kHeaderSize + records_.size()));
    set(100, num_records_);
    set(104, static_cast<std::uint8_t>(point_format_));
    set(105, static_cast<std::uint16_t>(point_size_));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double offset = scale_.offset[static_cast<Eigen::Index>(axis)];
      set(131 + 8 * axis, scale_.step);
      set(155 + 8 * axis, offset);
      if (num_points == 0) continue;
      set(179 + 16 * axis, scale_.step * most_[axis] + offset);
      set(187 + 16 * axis, scale_.step * least_[axis] + offset);
    }
    set(247, num_points);  // the 32-bit counts of older versions stay 0
    set(255, by_return_);
    return bytes;
  }

  /// A variable length record. @pre the content has at most 65,535 bytes
  void add_record(std::string_view user, std::uint16_t id, std::string_view what, const std::string& content) {
    std::string head(kRecordHeader, '\0');
    std::copy(user.begin(), user.end(), head.begin() + 2);
    const auto length = static_cast<std::uint16_t>(content.size());
    std::memcpy(head.data() + 18, &id, sizeof id);
    std::memcpy(head.data() + 20, &length, sizeof length);
    std::copy(what.begin(), what.end(), head.begin() + 22);
    records_ += head + content;
    ++num_records_;
  }

  /// What the bytes behind each point are.
  std::string extra_bytes() const {
    std::string record;
    for (const Attribute& extra : extras_) {
      std::string entry(kLasExtraEntry, '\0');
      entry[2] = static_cast<char>(extra_type(extra.type));
      std::memcpy(entry.data() + 4, extra.name.data(), extra.name.size());
      record += entry;
    }
    return record;
  }

  void complete(std::uint64_t num_points) override {
    go_to(0);
    put(header(num_points));
  }

  RecordLayout layout_;
  std::uint16_t source_id_;
  double least_intensity_, most_intensity_;
  ScalarType intensity_type_ = ScalarType::kUInt16;
  LasScale scale_;
  std::vector<Copy> copies_;
  std::vector<Attribute> extras_;
  std::string records_;  ///< between header and points
  std::uint32_t num_records_ = 0;
  int point_format_ = 7;
  std::size_t point_size_ = 0;  ///< [bytes]
  bool has_nir_ = false, has_returns_ = false, has_source_ = false;
  std::array<std::int32_t, 3> least_{INT32_MAX, INT32_MAX, INT32_MAX}, most_{INT32_MIN, INT32_MIN, INT32_MIN};
  std::array<std::uint64_t, 15> by_return_{};
  std::vector<std::byte> points_;  ///< of one block
};

}  // namespace

bool las_names_crs(const std::string& crs) {
  const auto text = well_known_text(crs);
  return text && text->size() < std::numeric_limits<std::uint16_t>::max();
}

std::unique_ptr<CloudSink> open_las(std::filesystem::path path, const RecordLayout& layout,
                                    const RegisteredCloudOptions& options) {
  return std::make_unique<LasSink>(std::move(path), layout, options);
}

}  // namespace tcm_icp
