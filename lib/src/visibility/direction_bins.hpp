#pragma once
// Bins of directions: the octahedral map of the sphere onto a square (Engelhardt and Dachsbacher, 2008). No
// trigonometry and no branches, so that compilers vectorise it.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tcm_icp {

class DirectionBins {
 public:
  /// About so many over the whole sphere. They differ by up to 2.3 times in width.
  explicit DirectionBins(std::size_t count)
      : edge_(std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count)))))) {}

  int edge() const { return edge_; }
  std::size_t size() const { return static_cast<std::size_t>(edge_) * static_cast<std::size_t>(edge_); }

  /// The bin of a direction of any length but zero.
  std::int32_t operator()(float x, float y, float z) const {
    const float scale = 1 / (std::abs(x) + std::abs(y) + std::abs(z) + 1e-30F);
    const float u = x * scale, v = y * scale;
    // The lower half is folded out over the edges of the upper.
    const float folded_u = std::copysign(1 - std::abs(v), u), folded_v = std::copysign(1 - std::abs(u), v);
    // Products in floats are exact here, and SSE2 has none of 32-bit integers.
    const auto edge = static_cast<float>(edge_);
    return static_cast<std::int32_t>(static_cast<float>(row(z < 0 ? folded_v : v)) * edge) + row(z < 0 ? folded_u : u);
  }

  std::size_t operator()(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3f d = direction.cast<float>();
    return static_cast<std::size_t>((*this)(d.x(), d.y(), d.z()));
  }

  double mean_solid_angle_sr() const { return 4 * EIGEN_PI / static_cast<double>(size()); }

  /// A bin and the eight about it.
  std::array<std::size_t, 9> around(std::size_t bin) const {
    const int row = static_cast<int>(bin) / edge_, column = static_cast<int>(bin) % edge_;
    std::array<std::size_t, 9> out;
    for (int k = 0; k < 9; ++k) out[static_cast<std::size_t>(k)] = wrapped(row + k / 3 - 1, column + k % 3 - 1);
    return out;
  }

  /// The bin at a row and a column at most one outside of the square: beyond its border the map goes on, turned round.
  std::size_t wrapped(int row, int column) const {
    const int last = edge_ - 1;
    if (row < 0 || row > last) column = last - column, row = std::clamp(row, 0, last);
    if (column < 0 || column > last) row = last - row, column = std::clamp(column, 0, last);
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(edge_) + static_cast<std::size_t>(column);
  }

 private:
  std::int32_t row(float w) const {
    const auto row = static_cast<std::int32_t>((w + 1) * (static_cast<float>(edge_) / 2));
    return row - (row >= edge_ ? 1 : 0);  // the border, and what rounding takes beyond it
  }

  int edge_;
};

/// Of range images: about one degree wide.
inline const DirectionBins kRangeImageBins(41'253);  // square degrees of a sphere

}  // namespace tcm_icp
