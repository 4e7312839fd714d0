#pragma once
// LAS files put together by hand.

#include <cstdint>
#include <string>

#include "io/binary_text.hpp"

namespace tcm_icp::test {

struct LasParts {
  int minor = 2, format = 0;
  std::uint16_t record_size = 20;
  std::uint64_t num_points = 0;
  std::string records;  ///< variable length, each with its header
  std::uint32_t num_records = 0;
  std::string points;
  std::string behind;  ///< what follows the points
};

/// Scale 0.01, 0.001, 0.5; offset 1000, -2000, 0.
inline std::string las_file(const LasParts& parts) {
  const std::size_t header_size = parts.minor == 4 ? 375 : parts.minor == 3 ? 235 : 227;
  std::string file = padded("LASF", header_size);
  put(file, 24, std::uint8_t{1});
  put(file, 25, static_cast<std::uint8_t>(parts.minor));
  put(file, 94, static_cast<std::uint16_t>(header_size));
  put(file, 96, static_cast<std::uint32_t>(header_size + parts.records.size()));
  put(file, 100, parts.num_records);
  put(file, 104, static_cast<std::uint8_t>(parts.format));
  put(file, 105, parts.record_size);
  if (parts.format < 6) put(file, 107, static_cast<std::uint32_t>(parts.num_points));
  file.replace(131, 24, joined(0.01, 0.001, 0.5));
  file.replace(155, 24, joined(1000.0, -2000.0, 0.0));
  if (parts.minor == 4) put(file, 247, parts.num_points);
  return file + parts.records + parts.points + parts.behind;
}

inline std::string las_record(const std::string& user, std::uint16_t id, const std::string& content) {
  return joined(std::uint16_t{0}) + padded(user, 16) + joined(id, static_cast<std::uint16_t>(content.size())) +
         padded("described", 32) + content;
}

/// One entry of the record that describes extra bytes.
inline std::string las_extra(const std::string& name, int type, int options, double scale = 0, double offset = 0) {
  std::string entry = joined(std::uint16_t{0}, static_cast<std::uint8_t>(type), static_cast<std::uint8_t>(options)) +
                      padded(name, 32) + std::string(4 + 24 * 3, '\0');
  entry += joined(scale) + std::string(16, '\0') + joined(offset) + std::string(16, '\0');
  return padded(entry, 192);
}

/// The coordinates of a point.
inline std::string las_xyz(std::int32_t x, std::int32_t y, std::int32_t z) { return joined(x, y, z); }

}  // namespace tcm_icp::test
