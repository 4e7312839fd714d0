#pragma once
// What clouds a result has, and in which format.

#include <string>

namespace tcm_icp {

/// File formats of written clouds.
enum class CloudFormat {
  kPly,   ///< PLY, binary
  kLas,   ///< LAS 1.4 with extra bytes
  kPcd,   ///< PCD, binary
  kText,  ///< a point a line
  kE57,   ///< E57: each scan in its own frame, with its pose
  kPtx,   ///< PTX: the same, as text
};

/// Where the colours of written clouds come from.
enum class CloudColour {
  kKeep,  ///< the input's own, where any scan has one (red green blue, all uchar or all ushort); else as kScan
  kScan,  ///< one for each scan
};

/// What write_registration() writes of the clouds.
struct OutputOptions {
  CloudFormat format = CloudFormat::kPly;   ///< of the merged cloud and of single scans
  CloudColour colour = CloudColour::kKeep;  ///< of the same
  bool each = false;                        ///< every registered scan in a file of its own, too
  double voxel_m = 0;                       ///< [m] >= 0; the merged cloud has one point a cube of this edge; 0: all
  /// LAS, E57: well-known text of the survey frame's coordinate system where its name is a code the library does not
  /// know; empty: not known.
  std::string crs_text = {};
  /// registered.EXT is written. Without it and without `each` no point is read again: there are no pictures either.
  bool merged = true;

  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

}  // namespace tcm_icp
