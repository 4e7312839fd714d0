#pragma once
// The header of a PCD file.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "input_buffer.hpp"

namespace tcm_icp {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

struct PcdField {
  std::string name;
  char kind = 'F';         ///< F float, I signed, U unsigned
  std::size_t size = 4;    ///< [bytes] 1, 2, 4 or 8
  std::size_t count = 1;   ///< numbers a point; 0 does not occur
  std::size_t offset = 0;  ///< [bytes] in a point
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t point_size = 0;  ///< [bytes] in binary data
  std::uint64_t num_points = 0;
  PcdData data = PcdData::kAscii;
};

/// Reads through the line "DATA ..."; the next byte of `input` is the first of the data.
/// @throws InputError  with "header line N" for what is not understood, not there, or does not agree
PcdHeader read_pcd_header(InputBuffer& input);

}  // namespace tcm_icp
