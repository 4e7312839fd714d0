#include "las_source.hpp"

#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "attribute_names.hpp"
#include "little_endian.hpp"
#include "remedies.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

// The types of extra bytes, from 1; 64-bit integers have no type of ours and become doubles.
constexpr std::array<ScalarType, 11> kExtraTypes{ScalarType::kUInt8,   ScalarType::kUInt8,   ScalarType::kInt8,
                                                 ScalarType::kUInt16,  ScalarType::kInt16,   ScalarType::kUInt32,
                                                 ScalarType::kInt32,   ScalarType::kFloat64, ScalarType::kFloat64,
                                                 ScalarType::kFloat32, ScalarType::kFloat64};
constexpr int kUInt64 = 7, kInt64 = 8;

double extra_value(const LasExtra& extra, const std::byte* record) {
  const std::byte* const bytes = record + extra.offset;
  double value = 0;
  if (extra.type == kUInt64) {
    value = static_cast<double>(load<std::uint64_t>(bytes));
  } else if (extra.type == kInt64) {
    value = static_cast<double>(load<std::int64_t>(bytes));
  } else {
    value = load_scalar(bytes, kExtraTypes[static_cast<std::size_t>(extra.type)]);
  }
  return extra.scale * value + extra.shift;
}

}  // namespace

LasSource::LasSource(InputBuffer input) : input_(std::move(input)), header_(read_las_header(input_)) { lay_out(); }

void LasSource::add(const char* name, ScalarType type, Rule rule, std::size_t from, unsigned mask, unsigned shift) {
  attributes_.push_back({name, type});
  fields_.push_back({rule, from, stride_, scalar_size(type), mask, shift, 0});
  stride_ += scalar_size(type);
}

void LasSource::lay_out() {
  const int format = header_.point_format;
  const bool is_new = format >= 6;
  const auto flags = [this](const char* name, std::size_t from, unsigned mask, unsigned shift) {
    add(name, ScalarType::kUInt8, Rule::kBits, from, mask, shift);
  };
  add("intensity", ScalarType::kUInt16, Rule::kCopy, 12);
  flags("return_number", 14, is_new ? 15 : 7, 0);
  flags("number_of_returns", 14, is_new ? 15 : 7, is_new ? 4 : 3);
  if (is_new) flags("scanner_channel", 15, 3, 4);
  flags("scan_direction_flag", is_new ? 15 : 14, 1, 6);
  flags("edge_of_flight_line", is_new ? 15 : 14, 1, 7);
  flags("classification", is_new ? 16 : 15, is_new ? 255 : 31, 0);
  flags("classification_flags", 15, is_new ? 15 : 7, is_new ? 0 : 5);
  if (is_new) {
    add("user_data", ScalarType::kUInt8, Rule::kCopy, 17);
    add("scan_angle", ScalarType::kFloat32, Rule::kAngle006, 18);
    add("point_source_id", ScalarType::kUInt16, Rule::kCopy, 20);
    add("gps_time", ScalarType::kFloat64, Rule::kCopy, 22);
  } else {
    add("scan_angle", ScalarType::kFloat32, Rule::kAngle, 16);
    add("user_data", ScalarType::kUInt8, Rule::kCopy, 17);
    add("point_source_id", ScalarType::kUInt16, Rule::kCopy, 18);
    if (format == 1 || format >= 3) add("gps_time", ScalarType::kFloat64, Rule::kCopy, 20);
  }
  // By format: where the colour stands; 0 for none. Wave packets (4, 5, 9, 10) are no attributes of a point.
  constexpr std::array<std::size_t, 11> kColour{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  if (const std::size_t at = kColour[static_cast<std::size_t>(format)]; at != 0) {
    add("red", ScalarType::kUInt16, Rule::kCopy, at);
    add("green", ScalarType::kUInt16, Rule::kCopy, at + 2);
    add("blue", ScalarType::kUInt16, Rule::kCopy, at + 4);
    if (format == 8 || format == 10) add("nir", ScalarType::kUInt16, Rule::kCopy, at + 6);
  }
  add_extras();
}

void LasSource::add_extras() {
  for (std::size_t i = 0; i < header_.extras.size(); ++i) {
    const LasExtra& extra = header_.extras[i];
    const ScalarType type = extra.is_scaled ? ScalarType::kFloat64 : kExtraTypes[static_cast<std::size_t>(extra.type)];
    const bool as_it_is = !extra.is_scaled && extra.type != kUInt64 && extra.type != kInt64;
    add(unique_name(attribute_name(extra.name), "extra_" + std::to_string(i + 1), attributes_).c_str(), type,
        as_it_is ? Rule::kCopy : Rule::kExtra, extra.offset);
    fields_.back().index = i;
  }
}

void LasSource::fill(const std::byte* record, std::byte* attributes) const {
  for (const Field& field : fields_) {
    std::byte* const to = attributes + field.to;
    const std::byte* const from = record + field.from;
    switch (field.rule) {
      case Rule::kCopy:
        std::memcpy(to, from, field.size);
        break;
      case Rule::kBits:
        *to = static_cast<std::byte>((std::to_integer<unsigned>(*from) >> field.shift) & field.mask);
        break;
      case Rule::kAngle:
        store_scalar(load<std::int8_t>(from), ScalarType::kFloat32, to);
        break;
      case Rule::kAngle006:
        store_scalar(0.006 * load<std::int16_t>(from), ScalarType::kFloat32, to);
        break;
      case Rule::kExtra:
        store_scalar(extra_value(header_.extras[field.index], record), ScalarType::kFloat64, to);
        break;
    }
  }
}

bool LasSource::next(Eigen::Vector3d& point, std::byte* attributes) {
  if (num_read_ == header_.num_points) return false;
  const std::byte* const record = input_.peek(header_.record_size);
  if (!record) {
    throw InputError(
        input_.path(), input_.byte_place(),
        "ends after " + std::to_string(num_read_) + " of " + std::to_string(header_.num_points) + " points", kDamaged);
  }
  for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
    point[axis] = header_.scale[axis] * load<std::int32_t>(record + 4 * axis) + header_.offset[axis];
  }
  if (attributes) fill(record, attributes);
  input_.consume(header_.record_size);
  ++num_read_;
  return true;
}

}  // namespace tcm_icp
