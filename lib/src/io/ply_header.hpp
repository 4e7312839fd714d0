#pragma once
// The header of a PLY file.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "input_buffer.hpp"
#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

enum class PlyFormat { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;  ///< of the value, or of each list entry
  std::optional<ScalarType> list_count;    ///< set for a list: the type its number of entries is written in
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_list() const;
  std::size_t scalar_stride() const;  ///< [bytes] of a binary record without its lists
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;  ///< in file order; one of them is "vertex", with x, y and z
  std::size_t vertex = 0;            ///< its index
};

/// Reads through "end_header"; the next byte of `input` is the first of the data.
/// @throws InputError  with "header line N" for what is not understood, not there, or there twice
PlyHeader read_ply_header(InputBuffer& input);

}  // namespace tcm_icp
