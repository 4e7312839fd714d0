#include "pcd_source.hpp"

#include <bit>
#include <string>
#include <utility>

#include "attribute_names.hpp"
#include "fields.hpp"
#include "little_endian.hpp"
#include "remedies.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

/// The type of ours; 64-bit integers have none and become doubles.
ScalarType type_of(char kind, std::size_t size) {
  if (kind == 'F') return size == 4 ? ScalarType::kFloat32 : ScalarType::kFloat64;
  if (size == 8) return ScalarType::kFloat64;
  if (size == 4) return kind == 'I' ? ScalarType::kInt32 : ScalarType::kUInt32;
  if (size == 2) return kind == 'I' ? ScalarType::kInt16 : ScalarType::kUInt16;
  return kind == 'I' ? ScalarType::kInt8 : ScalarType::kUInt8;
}

int axis_of(std::string_view name) {
  if (name.size() != 1) return -1;
  const std::size_t at = std::string_view("xyzXYZ").find(name[0]);
  return at == std::string_view::npos ? -1 : static_cast<int>(at % 3);
}

bool is_packed_colour(const PcdField& field) {
  return (field.name == "rgb" || field.name == "rgba") && field.size == 4 && field.count == 1;
}

}  // namespace

PcdSource::PcdSource(InputBuffer input) : input_(std::move(input)), header_(read_pcd_header(input_)) {
  lay_out();
  if (header_.data == PcdData::kAscii) return;
  record_.resize(header_.point_size);
  if (header_.data == PcdData::kBinaryCompressed) {
    open_compressed();
  } else {
    check_room();
  }
}

void PcdSource::check_room() const {
  if (!input_.size()) return;
  const std::uint64_t room = (*input_.size() - input_.offset()) / header_.point_size;
  if (header_.num_points > room) {
    throw InputError(
        input_.path(), "header",
        "promises " + std::to_string(header_.num_points) + " points, but the file has room for " + std::to_string(room),
        kDamaged);
  }
}

void PcdSource::lay_out() {
  bool has_axis[3] = {};
  std::size_t word = 0;
  for (const PcdField& field : header_.fields) {
    const int axis = field.count == 1 ? axis_of(field.name) : -1;
    if (axis >= 0 && !std::exchange(has_axis[axis], true)) {
      columns_.push_back({field.kind, field.size, field.offset, 0, word, axis, -1});
    } else if (is_packed_colour(field)) {
      add_colour(field, word);
    } else if (field.name != "_") {  // padding
      add_numbers(field, word);
    }
    word += field.count;
  }
  num_words_ = word;
  if (!has_axis[0] || !has_axis[1] || !has_axis[2]) {
    throw InputError(input_.path(), "header", "has no fields x, y and z", "write the file with coordinates");
  }
}

void PcdSource::add_numbers(const PcdField& field, std::size_t word) {
  const ScalarType type = type_of(field.kind, field.size);
  std::string name = attribute_name(field.name);
  if (name.starts_with("normal_")) name.erase(1, 6);  // PCL's word for nx ny nz
  for (std::size_t i = 0; i < field.count; ++i) {
    const std::string numbered = field.count > 1 ? name + "_" + std::to_string(i) : name;
    attributes_.push_back({unique_name(numbered, "field_" + std::to_string(word + i + 1), attributes_), type});
    columns_.push_back({field.kind, field.size, field.offset + i * field.size, stride_, word + i});
    stride_ += scalar_size(type);
  }
}

void PcdSource::add_colour(const PcdField& field, std::size_t word) {
  constexpr const char* kNames[] = {"red", "green", "blue", "alpha"};
  for (int channel = 0; channel < (field.name == "rgba" ? 4 : 3); ++channel) {
    attributes_.push_back({unique_name(kNames[channel], "colour", attributes_), ScalarType::kUInt8});
    columns_.push_back({field.kind, field.size, field.offset, stride_, word, -1, channel});
    ++stride_;
  }
}

// The fields stand one behind the other, packed together. One pass finds where each begins; from there each is
// unpacked on its own, so that a point can be put together without holding the file.
void PcdSource::open_compressed() {
  if (header_.num_points == 0) return;  // some write no sizes then
  const std::byte* const sizes = input_.peek(8);
  if (!sizes) fail_truncated();
  const std::uint64_t packed = load<std::uint32_t>(sizes), unpacked = load<std::uint32_t>(sizes + 4);
  input_.consume(8);
  if (header_.num_points > unpacked / header_.point_size || unpacked != header_.num_points * header_.point_size) {
    throw InputError(input_.path(), input_.byte_place(),
                     "unpacks to " + std::to_string(unpacked) + " bytes, which are not " +
                         std::to_string(header_.num_points) + " points of " + std::to_string(header_.point_size),
                     kDamaged);
  }
  LzfState start;
  start.input_offset = input_.offset();
  start.input_end = input_.offset() + packed;
  LzfStream stream(input_.path(), start);
  for (const PcdField& field : header_.fields) {
    streams_.emplace_back(input_.path(), stream.state());
    const std::uint64_t bytes = header_.num_points * field.size * field.count;
    if (!stream.read(nullptr, bytes)) fail_truncated();
  }
}

void PcdSource::fail_truncated() const {
  throw InputError(input_.path(), header_.data == PcdData::kAscii ? input_.line_place() : input_.byte_place(),
                   "ends after " + std::to_string(num_read_) + " of " + std::to_string(header_.num_points) + " points",
                   kDamaged);
}

void PcdSource::fail_line(const std::string& problem) const {
  throw InputError(input_.path(), input_.line_place(), problem, kDamaged);
}

void PcdSource::read_ascii() {
  std::string_view line;
  do {
    if (!input_.next_line(line)) fail_truncated();
    line = trimmed(line);
  } while (line.empty());
  if (num_read_ == 0 && line.find(',') != std::string_view::npos) delimiter_ = ',';
  split_fields(line, delimiter_, words_);
  if (words_.size() != num_words_) {
    fail_line("has " + std::to_string(words_.size()) + " numbers, but a point has " + std::to_string(num_words_));
  }
}

const std::byte* PcdSource::next_binary() {
  const std::byte* const bytes = input_.peek(header_.point_size);
  if (!bytes) fail_truncated();
  input_.consume(header_.point_size);
  return bytes;
}

const std::byte* PcdSource::next_compressed(bool with_attributes) {
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const PcdField& field = header_.fields[i];
    if (!with_attributes && axis_of(field.name) < 0) continue;
    if (!streams_[i].read(record_.data() + field.offset, field.size * field.count)) fail_truncated();
  }
  return record_.data();
}

double PcdSource::value_of(const Column& column, const std::byte* record) const {
  const std::byte* const bytes = record + column.from;
  if (column.channel >= 0) {
    const auto packed = load<std::uint32_t>(bytes);  // alpha red green blue, from the highest byte
    return (packed >> (column.channel == 3 ? 24U : 16U - 8U * static_cast<unsigned>(column.channel))) & 255U;
  }
  if (column.size == 8 && column.kind == 'I') return static_cast<double>(load<std::int64_t>(bytes));
  if (column.size == 8 && column.kind == 'U') return static_cast<double>(load<std::uint64_t>(bytes));
  return load_scalar(bytes, type_of(column.kind, column.size));
}

double PcdSource::word_value(const Column& column) const {
  const std::string_view word = words_[column.word];
  const auto value = parse_number(word);
  if (!value) fail_line(quoted(word) + " is not a number");
  if (column.channel >= 0) {
    std::uint32_t packed = 0;
    if (column.kind == 'F') {
      packed = std::bit_cast<std::uint32_t>(static_cast<float>(*value));  // the bits of a colour, read as a float
    } else if (fits(*value, ScalarType::kUInt32)) {
      packed = static_cast<std::uint32_t>(*value);
    } else if (fits(*value, ScalarType::kInt32)) {
      packed = static_cast<std::uint32_t>(static_cast<std::int32_t>(*value));
    } else {
      fail_line(quoted(word) + " is not a packed colour");
    }
    return (packed >> (column.channel == 3 ? 24U : 16U - 8U * static_cast<unsigned>(column.channel))) & 255U;
  }
  if (column.axis < 0 && !fits(*value, type_of(column.kind, column.size))) {
    fail_line(quoted(word) + " is not a value of its field's type");
  }
  return *value;
}

bool PcdSource::next(Eigen::Vector3d& point, std::byte* attributes) {
  if (num_read_ == header_.num_points) return false;
  const std::byte* record = nullptr;
  if (header_.data == PcdData::kAscii) {
    read_ascii();
  } else {
    record = header_.data == PcdData::kBinary ? next_binary() : next_compressed(attributes != nullptr);
  }
  for (const Column& column : columns_) {
    if (record && !attributes && column.axis < 0) continue;
    const double value = record ? value_of(column, record) : word_value(column);
    if (column.axis >= 0) {
      point[column.axis] = value;
    } else if (attributes) {
      const ScalarType type = column.channel >= 0 ? ScalarType::kUInt8 : type_of(column.kind, column.size);
      store_scalar(value, type, attributes + column.to);
    }
  }
  ++num_read_;
  return true;
}

}  // namespace tcm_icp
