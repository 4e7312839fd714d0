#pragma once
// What clouds a result has, and in which format.

#include <string>

#include "tcm_icp/io/registered_cloud_writer.hpp"

namespace tcm_icp {

struct OutputOptions {
  CloudFormat format = CloudFormat::kPly;   ///< of the merged cloud and of single scans
  CloudColour colour = CloudColour::kKeep;  ///< of the same
  bool each = false;                        ///< every registered scan in a file of its own, too
  double voxel_m = 0;                       ///< [m] >= 0; the merged cloud has one point a cube of this edge; 0: all
  /// LAS, E57: well-known text of the survey frame's coordinate system where its name is a code the library does not
  /// know; empty: not known.
  std::string crs_text = {};

  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

}  // namespace tcm_icp
