#pragma once
// The range of an attribute, of a stream of points.

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// Least and most of the finite values of the attribute of a name.
class ValueRange {
 public:
  explicit ValueRange(std::string name) : name_(std::move(name)) {}

  /// Nothing happens where the scan does not have the attribute.
  void add(const PointBlock& block, const std::vector<Attribute>& attributes);

  double least() const { return least_; }  ///< infinity where there was none
  double most() const { return most_; }    ///< -infinity where there was none

 private:
  std::string name_;
  double least_ = std::numeric_limits<double>::infinity(), most_ = -std::numeric_limits<double>::infinity();
};

/// What is to become 0 and 65535 of the intensities of LAS: 0 and 1 where they are shares, 0 and 65535 where they are
/// numbers up to there, and else what they reach.
std::pair<double, double> las_intensity_range(const ValueRange& intensity);

}  // namespace tcm_icp
