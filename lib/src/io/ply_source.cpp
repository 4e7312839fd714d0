#include "ply_source.hpp"

#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "fields.hpp"
#include "remedies.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

bool is_swapped(PlyFormat format) {
  return (format == PlyFormat::kBinaryBigEndian) == (std::endian::native == std::endian::little);
}

void copy_value(const std::byte* from, ScalarType type, bool swapped, std::byte* to) {
  if (swapped) {
    copy_reversed(from, scalar_size(type), to);
  } else {
    std::memcpy(to, from, scalar_size(type));
  }
}

double load_value(const std::byte* from, ScalarType type, bool swapped) {
  if (!swapped) return load_scalar(from, type);
  std::byte native[sizeof(double)];
  copy_reversed(from, scalar_size(type), native);
  return load_scalar(native, type);
}

}  // namespace

PlySource::PlySource(InputBuffer input) : input_(std::move(input)), header_(read_ply_header(input_)) {
  lay_out_fields();
  for (std::size_t i = 0; i < header_.vertex; ++i) skip_element(header_.elements[i]);
  num_read_ = 0;
}

void PlySource::lay_out_fields() {
  std::size_t record_offset = 0, attribute_offset = 0;
  for (const auto& property : header_.elements[header_.vertex].properties) {
    if (property.list_count) continue;
    const bool is_axis = property.name == "x" || property.name == "y" || property.name == "z";
    fields_.push_back({property.type, record_offset, is_axis ? property.name[0] - 'x' : -1, attribute_offset});
    record_offset += scalar_size(property.type);
    if (is_axis) continue;
    attributes_.push_back({property.name, property.type});
    attribute_offset += scalar_size(property.type);
  }
  record_size_ = record_offset;
}

void PlySource::fail_truncated(const PlyElement& element) const {
  const bool ascii = header_.format == PlyFormat::kAscii;
  throw InputError(input_.path(), ascii ? input_.line_place() : input_.byte_place(),
                   "ends after " + std::to_string(num_read_) + " of " + std::to_string(element.count) + " '" +
                       element.name + "' records",
                   kDamaged);
}

void PlySource::skip_element(const PlyElement& element) {
  const std::size_t stride = element.scalar_stride();
  num_read_ = 0;
  if (header_.format != PlyFormat::kAscii && !element.has_list()) {
    if (stride == 0) return;
    // More bytes than a file can have: it is truncated, and the product would wrap.
    if (element.count > std::numeric_limits<std::uint64_t>::max() / stride) fail_truncated(element);
    const std::uint64_t begin = input_.offset();
    if (!input_.skip(element.count * stride)) {
      num_read_ = (input_.offset() - begin) / stride;
      fail_truncated(element);
    }
    return;
  }
  for (; num_read_ < element.count; ++num_read_) {
    if (header_.format == PlyFormat::kAscii) {
      next_ascii_fields(element);
    } else if (!gather_record(element)) {
      fail_truncated(element);
    }
  }
}

bool PlySource::next(Eigen::Vector3d& point, std::byte* attributes) {
  if (num_read_ == header_.elements[header_.vertex].count) return false;
  if (header_.format == PlyFormat::kAscii) {
    read_ascii(point, attributes);
  } else {
    read_binary(point, attributes);
  }
  ++num_read_;
  return true;
}

bool PlySource::skip_list(const PlyProperty& property) {
  const std::size_t count_size = scalar_size(*property.list_count);
  const std::byte* const bytes = input_.peek(count_size);
  if (!bytes) return false;
  const double count = load_value(bytes, *property.list_count, is_swapped(header_.format));
  if (count < 0) throw InputError(input_.path(), input_.byte_place(), "a list has a negative length", kDamaged);
  input_.consume(count_size);
  return input_.skip(static_cast<std::uint64_t>(count) * scalar_size(property.type));
}

bool PlySource::gather_record(const PlyElement& element) {
  record_.resize(element.scalar_stride());
  std::size_t offset = 0;
  for (const auto& property : element.properties) {
    if (property.list_count) {
      if (!skip_list(property)) return false;
      continue;
    }
    const std::size_t size = scalar_size(property.type);
    const std::byte* const bytes = input_.peek(size);
    if (!bytes) return false;
    std::memcpy(record_.data() + offset, bytes, size);
    input_.consume(size);
    offset += size;
  }
  return true;
}

const std::byte* PlySource::next_binary_record(const PlyElement& element) {
  if (element.has_list()) return gather_record(element) ? record_.data() : nullptr;
  // A record is shorter than its header, which has at most kMaxLine bytes.
  const std::byte* const bytes = input_.peek(record_size_);
  if (bytes) input_.consume(record_size_);
  return bytes;
}

void PlySource::read_binary(Eigen::Vector3d& point, std::byte* attributes) {
  const PlyElement& vertex = header_.elements[header_.vertex];
  const std::byte* const record = next_binary_record(vertex);
  if (!record) fail_truncated(vertex);
  const bool swapped = is_swapped(header_.format);
  for (const Field& field : fields_) {
    const std::byte* const bytes = record + field.record_offset;
    if (field.axis >= 0) {
      point[field.axis] = load_value(bytes, field.type, swapped);
    } else if (attributes) {
      copy_value(bytes, field.type, swapped, attributes + field.attribute_offset);
    }
  }
}

void PlySource::next_ascii_fields(const PlyElement& element) {
  std::string_view line;
  do {
    if (!input_.next_line(line)) fail_truncated(element);
    split_fields(line, ' ', tokens_);
  } while (tokens_.empty() && !element.properties.empty());
  scalars_.clear();
  std::size_t at = 0;
  for (const auto& property : element.properties) {
    if (at >= tokens_.size()) {
      at = tokens_.size() + 1;  // too few
      break;
    }
    if (!property.list_count) {
      scalars_.push_back(tokens_[at++]);
      continue;
    }
    const double count = parse(tokens_[at]);
    if (!fits(count, ScalarType::kUInt32)) fail_line(quoted(tokens_[at]) + " is not the length of a list");
    at += 1 + static_cast<std::size_t>(count);
  }
  if (at != tokens_.size()) {
    fail_line("holds " + std::to_string(tokens_.size()) + " values, which is not what the header says of '" +
              element.name + "'");
  }
}

void PlySource::fail_line(const std::string& problem) const {
  throw InputError(input_.path(), input_.line_place(), problem, kDamaged);
}

double PlySource::parse(std::string_view token) const {
  const auto value = parse_number(token);
  if (!value) fail_line(quoted(token) + " is not a number");
  return *value;
}

void PlySource::read_ascii(Eigen::Vector3d& point, std::byte* attributes) {
  next_ascii_fields(header_.elements[header_.vertex]);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const double value = parse(scalars_[i]);
    // Coordinates stay as they are written, even where the header calls them float.
    if (fields_[i].axis >= 0) {
      point[fields_[i].axis] = value;
      continue;
    }
    if (!fits(value, fields_[i].type)) {
      fail_line(quoted(scalars_[i]) + " is not a value of the type " + std::string(ply_type_name(fields_[i].type)));
    }
    if (attributes) store_scalar(value, fields_[i].type, attributes + fields_[i].attribute_offset);
  }
}

}  // namespace tcm_icp
