#include "las_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "largest_coordinate.hpp"

namespace tcm_icp {
namespace {

/// The least number >= `value` of the form 1, 2 or 5 times a power of ten.
double round_up(double value) {
  for (int exponent = static_cast<int>(std::floor(std::log10(value))) - 1;; ++exponent) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      // A negative power is divided by, so that 0.001 is the double nearest to it.
      const double rounded = exponent < 0 ? digit / std::pow(10.0, -exponent) : digit * std::pow(10.0, exponent);
      if (rounded >= value) return rounded;
    }
  }
}

}  // namespace

LasScale choose_las_scale(const Eigen::AlignedBox3d& box) {
  LasScale scale;
  if (box.isEmpty()) return scale;
  constexpr double kRoom = 4.2e9;  // of 2^32 numbers: offsets are rounded, and so are coordinates
  const double extent = box.sizes().maxCoeff();
  const double told_apart = std::max(largest_coordinate(box) * std::numeric_limits<double>::epsilon(), 1e-15);
  scale.is_by_extent = extent / kRoom > told_apart;
  scale.step = round_up(std::max(extent / kRoom, told_apart));
  // Multiples of some 2 % of the largest extent that has room: few digits, and all of the box within 2^31 of them.
  const double rounding = scale.step * 1e7;
  for (int axis = 0; axis < 3; ++axis) scale.offset[axis] = std::round(box.center()[axis] / rounding) * rounding;
  return scale;
}

}  // namespace tcm_icp
