#pragma once
// Lengths and squared distances that are equal but for rounding.

namespace tcm_icp {

/// Lengths or squared distances nearer to one another than this share count as equal. Scanners and file formats put
/// points on grids, so that equal distances are common; in another unit, or far from the origin, rounding would order
/// them anew. Coordinates of 5 million are rounded by 1e-9, a millionth of a spacing of a thousandth; distances that
/// differ by chance come so near to one another once in 1e5 points.
constexpr double kTieShare = 1e-6;

/// Whether a is less than b by more than rounding. Not for sorting: ties of ties are no ties.
inline bool clearly_less(double a, double b) { return a < (1 - kTieShare) * b; }

}  // namespace tcm_icp
