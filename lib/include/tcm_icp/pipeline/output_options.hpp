#pragma once
// What clouds a result has, and in which format.

#include "tcm_icp/io/registered_cloud_writer.hpp"

namespace tcm_icp {

struct OutputOptions {
  CloudFormat format = CloudFormat::kPly;   ///< of the merged cloud and of single scans
  CloudColour colour = CloudColour::kKeep;  ///< of the same
  bool each = false;                        ///< every registered scan in a file of its own, too
  double voxel_m = 0;                       ///< [m] >= 0; the merged cloud has one point a cube of this edge; 0: all

  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

}  // namespace tcm_icp
