#pragma once
// Which matches can hold under one rigid motion.

#include <Eigen/Core>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tcm_icp {

/// Matched points with unit normals (axes), one column a match. In voxels of their level: floats of metres would be
/// rounded otherwise in another unit (decision 0015).
struct MatchedPoints {
  Eigen::Matrix3Xf target, source, target_normal, source_normal;
  Eigen::Index size() const { return target.cols(); }
};

/// Undirected graph over matches, one row of bits each.
class CompatibilityGraph {
 public:
  /// Joins two matches where the distance between the points is the same in both scans within `tolerance`, is at
  /// least `min_length`, and the angle between the normals is the same within `normal_tolerance` (of its cosine).
  CompatibilityGraph(const MatchedPoints& matches, float tolerance, float min_length, float normal_tolerance);

  std::size_t size() const { return size_; }
  const std::uint64_t* row(std::size_t i) const { return bits_.data() + i * words_; }
  bool joined(std::size_t i, std::size_t j) const { return (row(i)[j / 64] >> (j % 64) & 1U) != 0; }

  /// Matches joined with both: the second-order measure of SC2-PCR (Chen et al., 2022).
  int num_common(std::size_t i, std::size_t j) const;

  /// Calls visit(j) for all j joined with i, ascending.
  template <typename Visit>
  void for_each_neighbor(std::size_t i, Visit visit) const {
    for (std::size_t w = 0; w < words_; ++w) {
      for (std::uint64_t left = row(i)[w]; left != 0; left &= left - 1) {
        visit(64 * w + static_cast<std::size_t>(std::countr_zero(left)));
      }
    }
  }

 private:
  // excess: of all matches and what fills their last word; below 0 at those after i that are joined with it.
  void join_those_after(std::size_t i, const float* excess);

  std::size_t size_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace tcm_icp
