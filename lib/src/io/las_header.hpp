#pragma once
// The header of a LAS file, 1.0 to 1.4, and what its variable length records say of the points.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "input_buffer.hpp"

namespace tcm_icp {

constexpr std::size_t kLasExtraEntry = 192;  // [bytes] that describe one of the extra numbers of points

/// One number of the bytes that a file has behind each point.
struct LasExtra {
  std::string name;
  int type = 0;            ///< 1..10 as the standard counts them: uchar, char, ushort, ... float, double
  std::size_t offset = 0;  ///< [bytes] in the record
  bool is_scaled = false;  ///< value = scale * number + shift
  double scale = 1, shift = 0;
};

struct LasHeader {
  int point_format = 0;         ///< 0..10
  std::size_t record_size = 0;  ///< [bytes]
  std::uint64_t num_points = 0;
  Eigen::Vector3d scale, offset;  ///< coordinates = scale * integers + offset
  std::vector<LasExtra> extras;
  std::string coordinate_system;  ///< "EPSG:26917" or well-known text; empty where no record names it
};

/// Bytes of a point without its extra bytes. @pre format is 0..10
std::size_t las_point_size(int format);

/// Reads up to the first point. Variable length records that do not fit before it are left alone: nothing in them is
/// needed for the coordinates.
/// @throws InputError  not LAS, compressed (LAZ, COPC), damaged, cut off
LasHeader read_las_header(InputBuffer& input);

}  // namespace tcm_icp
