#pragma once
// What the XML part of an E57 file says of its scans.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "e57_pages.hpp"

namespace tcm_icp {

/// One column of a scan's points, in the order of their byte streams.
struct E57Field {
  enum class Kind { kFloat32, kFloat64, kInteger, kScaled, kOther };

  std::string name;  ///< "cartesianX"
  Kind kind = Kind::kOther;
  std::int64_t minimum = 0;     ///< of the integers
  std::uint64_t range = 0;      ///< largest integer less `minimum`
  double scale = 1, shift = 0;  ///< kScaled: value = scale * integer + shift

  unsigned bits() const;  ///< of one value; 0 where there is only one
};

struct E57Scan {
  std::uint64_t num_points = 0;
  std::uint64_t points_offset = 0;  ///< [bytes] physical, of the section that holds them
  std::vector<E57Field> fields;
  std::optional<Eigen::Matrix4d> T_file_scan;  ///< where the file says it
  std::string coordinate_system;               ///< of the file
  bool is_packed = false;                      ///< by another codec than the standard's own
};

/// @throws InputError  if it is no XML, or not what E57 has there
std::vector<E57Scan> read_e57_scans(E57Pages& pages);

}  // namespace tcm_icp
