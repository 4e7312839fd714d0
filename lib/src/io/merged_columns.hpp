#pragma once
// The columns of a merged cloud: the union of what the scans hold.

#include <cstddef>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

struct MergedColumns {
  std::vector<Attribute> columns;                   ///< in the order of their first scan
  std::vector<std::vector<std::size_t>> column_of;  ///< [scan][attribute] -> index into columns
};

/// True for nx, ny, nz, which turn with the scan.
bool is_normal_component(const std::string& name);

/// The smallest type that holds every finite value of both, exactly.
ScalarType widened(ScalarType a, ScalarType b);

/// Same name, same column, of a type that holds each scan's values; normals are floats at least. The names of the
/// merged cloud's own columns are given way to: "red" becomes "input_red".
MergedColumns merge_columns(const std::vector<std::vector<Attribute>>& scan_attributes);

}  // namespace tcm_icp
