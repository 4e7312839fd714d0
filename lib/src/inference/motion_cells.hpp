#pragma once
// Motions by cells, of which only neighbours hold motions that may agree.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tcm_icp {

class MotionCells {
 public:
  /// @param coordinates  of each motion, finite; motions that agree differ by at most 1 in each
  explicit MotionCells(const Eigen::Matrix3Xd& coordinates);

  std::size_t size() const { return cells_.size(); }
  /// The motions of a cell, ascending.
  std::span<const std::size_t> motions(std::size_t cell) const {
    return std::span(motions_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
  }
  /// The cell and those beside it that hold motions. Cost: nine searches among the cells.
  std::vector<std::size_t> around(std::size_t cell) const;

 private:
  using Cell = std::array<std::int64_t, 3>;

  std::vector<Cell> cells_;         // ascending
  std::vector<std::size_t> begin_;  // of each cell among the motions, and their number
  std::vector<std::size_t> motions_;
};

}  // namespace tcm_icp
