#pragma once
// The columns of a merged cloud: the union of what the scans hold.

#include <cstddef>
#include <vector>

#include "tcm_icp/io/registered_cloud_writer.hpp"

namespace tcm_icp {

struct MergedColumns {
  std::vector<Attribute> columns;                   ///< in the order of their first scan
  std::vector<std::vector<std::size_t>> column_of;  ///< [scan][attribute] -> index into columns
  /// The first three columns are red green blue of the scans that have a colour. Otherwise the file may have a colour
  /// by scan beside these columns.
  bool has_own_colour = false;
  bool has_colour_by_scan = false;
};

/// True for nx, ny, nz, which turn with the scan.
bool is_normal_component(const std::string& name);

/// The smallest type that holds every finite value of both, exactly.
ScalarType widened(ScalarType a, ScalarType b);

/// Same name, same column, of a type that holds each scan's values; normals are floats at least. The names of the
/// merged cloud's own columns are given way to: "red" becomes "input_red".
/// @param one_scan  the file is for one scan alone: see RegisteredCloudOptions
MergedColumns merge_columns(const std::vector<std::vector<Attribute>>& scan_attributes, CloudColour colour,
                            bool one_scan);

}  // namespace tcm_icp
