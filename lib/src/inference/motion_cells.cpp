#include "inference/motion_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tcm_icp {

MotionCells::MotionCells(const Eigen::Matrix3Xd& coordinates) : motions_(static_cast<std::size_t>(coordinates.cols())) {
  std::vector<Cell> of_motion;
  for (const auto& c : coordinates.colwise()) {
    of_motion.push_back(
        {std::llround(std::floor(c[0])), std::llround(std::floor(c[1])), std::llround(std::floor(c[2]))});
  }
  std::iota(motions_.begin(), motions_.end(), std::size_t{0});
  std::stable_sort(motions_.begin(), motions_.end(),
                   [&](std::size_t i, std::size_t j) { return of_motion[i] < of_motion[j]; });
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const Cell& cell = of_motion[motions_[k]];
    if (!cells_.empty() && cell == cells_.back()) continue;
    cells_.push_back(cell);
    begin_.push_back(k);
  }
  begin_.push_back(motions_.size());
}

std::vector<std::size_t> MotionCells::around(std::size_t cell) const {
  const Cell& middle = cells_[cell];
  std::vector<std::size_t> out;
  for (std::int64_t i = middle[0] - 1; i <= middle[0] + 1; ++i) {
    for (std::int64_t j = middle[1] - 1; j <= middle[1] + 1; ++j) {
      auto next = std::lower_bound(cells_.begin(), cells_.end(), Cell{i, j, middle[2] - 1});
      for (; next != cells_.end() && *next <= Cell{i, j, middle[2] + 1}; ++next) {
        out.push_back(static_cast<std::size_t>(next - cells_.begin()));
      }
    }
  }
  return out;
}

}  // namespace tcm_icp
