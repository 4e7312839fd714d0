#include "e57_points.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>

#include "e57_layout.hpp"
#include "little_endian.hpp"
#include "remedies.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kSlack = 16;  // [bytes] behind a column's, so that a value may be loaded as two words
// [bytes] of one column that wait for the others. Writers cut all columns at the same points, or nearly so.
constexpr std::size_t kMostWaiting = std::size_t{1} << 26U;

/// The `bits` <= 64 bits from bit `at` on, lowest first.
std::uint64_t bits_at(const std::byte* bytes, std::uint64_t at, unsigned bits) {
  const std::byte* const from = bytes + at / 8;
  const auto shift = static_cast<unsigned>(at % 8);
  std::uint64_t value = load<std::uint64_t>(from) >> shift;
  if (shift + bits > 64) value |= load<std::uint64_t>(from + 8) << (64 - shift);
  return bits == 64 ? value : value & ((std::uint64_t{1} << bits) - 1);
}

/// Integers of whole bytes: what most files have.
template <typename T>
void unpack_whole(const std::byte* from, double minimum, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = minimum + load<T>(from + sizeof(T) * i);
}

/// Whether the values of a column are whole bytes of which each number is allowed, and exact as doubles.
bool is_whole(const E57Field& field) {
  const unsigned bits = field.bits();
  constexpr std::int64_t kExact = std::int64_t{1} << 52U;
  return (bits == 8 || bits == 16 || bits == 32) && field.range == (std::uint64_t{1} << bits) - 1 &&
         field.minimum > -kExact && field.minimum < kExact;
}

}  // namespace

E57Points::E57Points(E57Pages& pages, const E57Scan& scan, const std::vector<std::size_t>& wanted)
    : pages_(pages), num_fields_(scan.fields.size()), column_of_(num_fields_, -1), num_points_(scan.num_points) {
  for (const std::size_t field : wanted) {
    column_of_[field] = static_cast<int>(columns_.size());
    columns_.push_back({&scan.fields[field], std::vector<std::byte>(kSlack), 0});
  }
  check_room(scan);
  values_.assign(wanted.size(), std::vector<double>(kBatch));
  if (num_points_ > 0 || scan.points_offset > 0) read_section(scan);  // some write none for no points
}

void E57Points::fail(const std::string& problem) const { throw InputError(pages_.path(), "points", problem, kDamaged); }

void E57Points::check_room(const E57Scan& scan) const {
  std::uint64_t bits = 0;
  for (const E57Field& field : scan.fields) bits += field.bits();
  const std::uint64_t room = 8 * pages_.logical_size() / std::max<std::uint64_t>(bits, 1);
  if (num_points_ > room) {
    fail("are " + std::to_string(num_points_) + " by the XML part, but the file has room for " + std::to_string(room));
  }
}

void E57Points::read_section(const E57Scan& scan) {
  const std::uint64_t begin = pages_.logical(scan.points_offset, "a scan's points");
  std::array<std::byte, kE57SectionHeader> header;
  pages_.seek(begin);
  pages_.read(header.data(), header.size());
  if (header[0] != std::byte{1}) {
    fail("the section at byte " + std::to_string(scan.points_offset) + " is none of points");
  }
  const auto length = load<std::uint64_t>(header.data() + 8);
  if (length > pages_.logical_size() - begin) fail("their section is longer than the file");
  end_ = begin + length;
  if (num_points_ == 0) return;
  next_packet_ = pages_.logical(load<std::uint64_t>(header.data() + 16), "the first packet of points");
}

/// Appends what the next packet has of each wanted column.
void E57Points::read_packet() {
  for (;;) {
    if (next_packet_ + kE57PacketHeader > end_) {
      fail("end after about " + std::to_string(num_read_) + " of " + std::to_string(num_points_));
    }
    std::array<std::byte, kE57PacketHeader> header;
    pages_.seek(next_packet_);
    pages_.read(header.data(), header.size());
    const std::size_t length = std::size_t{load<std::uint16_t>(header.data() + 2)} + 1;
    if (length < kE57PacketHeader || length > end_ - next_packet_) fail("a packet is longer than their section");
    next_packet_ += length;
    const auto type = std::to_integer<int>(header[0]);
    if (type == 0 || type == 2) continue;  // an index, or nothing
    if (type != 1) fail("a packet is of the unknown type " + std::to_string(type));
    if (load<std::uint16_t>(header.data() + 4) != num_fields_) fail("a packet has another number of columns");
    packet_.resize(length - kE57PacketHeader);
    pages_.read(packet_.data(), packet_.size());
    break;
  }
  std::size_t at = 2 * num_fields_;
  for (std::size_t field = 0; field < num_fields_; ++field) {
    if (at > packet_.size()) fail("a packet has less than it says");
    const std::size_t length = load<std::uint16_t>(packet_.data() + 2 * field);
    if (length > packet_.size() - at) fail("a packet has less than it says");
    if (column_of_[field] >= 0) {
      Column& column = columns_[static_cast<std::size_t>(column_of_[field])];
      const auto from = packet_.begin() + static_cast<std::ptrdiff_t>(at);
      column.bytes.insert(column.bytes.end() - kSlack, from, from + static_cast<std::ptrdiff_t>(length));
      if (column.bytes.size() > kMostWaiting) fail("columns stand so far apart that they cannot be read side by side");
    }
    at += length;
  }
}

/// Lets go of what has been taken.
void E57Points::compact(Column& column) {
  const auto taken = static_cast<std::ptrdiff_t>(column.bit / 8);
  column.bytes.erase(column.bytes.begin(), column.bytes.begin() + taken);
  column.bit %= 8;
}

void E57Points::unpack(Column& column, std::span<double> values) {
  const E57Field& field = *column.field;
  const unsigned bits = field.bits();
  const std::byte* const bytes = column.bytes.data();
  const std::byte* const from = bytes + column.bit / 8;  // floats begin at whole bytes
  switch (field.kind) {
    case E57Field::Kind::kFloat32:
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = load<float>(from + 4 * i);
      break;
    case E57Field::Kind::kFloat64:
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = load<double>(from + 8 * i);
      break;
    default:
      if (is_whole(field)) {
        const auto minimum = static_cast<double>(field.minimum);
        if (bits == 8) unpack_whole<std::uint8_t>(from, minimum, values);
        if (bits == 16) unpack_whole<std::uint16_t>(from, minimum, values);
        if (bits == 32) unpack_whole<std::uint32_t>(from, minimum, values);
      } else {
        for (std::size_t i = 0; i < values.size(); ++i) {
          const std::uint64_t raw = bits == 0 ? 0 : bits_at(bytes, column.bit + i * bits, bits);
          values[i] =
              raw > field.range
                  ? std::numeric_limits<double>::quiet_NaN()  // more than its column may hold: no value
                  : static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(field.minimum) + raw));
        }
      }
      if (field.kind == E57Field::Kind::kScaled) {
        for (double& value : values) value = field.scale * value + field.shift;
      }
  }
  column.bit += std::uint64_t{bits} * values.size();
}

void E57Points::read(std::size_t n) {
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    Column& column = columns_[k];
    const std::uint64_t needed = std::uint64_t{column.field->bits()} * n;
    while (column.bit + needed > 8 * std::uint64_t{column.bytes.size() - kSlack}) {
      for (Column& each : columns_) compact(each);
      read_packet();
    }
    unpack(column, std::span(values_[k]).first(n));
  }
  num_read_ += n;
}

}  // namespace tcm_icp
