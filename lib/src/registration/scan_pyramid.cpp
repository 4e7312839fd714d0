#include "tcm_icp/registration/scan_pyramid.hpp"

#include <algorithm>
#include <cmath>

#include "core/tie.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

constexpr int kSearchedHalvings = 4;  // beyond the first size that may be enough: scans are surfaces, not solids
constexpr int kMaxHalvings = 40;      // 1e-12 of the diagonal
constexpr double kCellVoxels = 5;     // of the index: distances that are asked of a level are up to that

}  // namespace

PyramidLevel::PyramidLevel(double voxel_m, Cloud of)
    : voxel_size_m(voxel_m), cloud(std::move(of)), index(cloud.points, kCellVoxels * voxel_m) {}

ScanPyramid::ScanPyramid(const Cloud& cloud, double finest_voxel_m, std::size_t num_levels) {
  double voxel = finest_voxel_m;
  levels_.reserve(num_levels);
  for (std::size_t i = 0; i < num_levels; ++i, voxel *= 2) {
    levels_.emplace_back(voxel, voxel_downsample(i == 0 ? cloud : levels_.back().cloud, voxel));
  }
}

const PyramidLevel& ScanPyramid::level_for(double size_m) const {
  std::size_t i = 0;
  // Gates are round multiples of the finest voxel, so that sizes and levels are often equal but for rounding.
  while (i + 1 < levels_.size() && !clearly_less(size_m, levels_[i + 1].voxel_size_m)) ++i;
  return levels_[i];
}

double voxel_size_for(const Points& points, std::size_t num_voxels) {
  if (points.empty()) throw InvalidInput("a cloud without points has no voxel size");
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const auto& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double diagonal = (high - low).norm();
  if (!(diagonal > 0)) throw InvalidInput("all points of a cloud are equal: no voxel size can be derived");
  const std::size_t wanted = std::min(num_voxels, points.size() / 2);
  const auto enough = [&](double size) { return count_voxels(points, size, wanted) >= wanted; };
  // Voxels of a 2^n-th of the diagonal: at most 2^n + 1 of them an axis, so the first sizes cannot be enough.
  int least = 0;
  for (double most = 2; most * most * most < static_cast<double>(wanted); most = 2 * most - 1) ++least;
  // A count ends where it is enough: those of small voxels soon, those of large ones after all points. Such voxels
  // nest, so that the answer does not depend on where the search begins.
  int halvings = least + kSearchedHalvings;
  if (enough(std::ldexp(diagonal, -halvings))) {
    while (halvings > least && enough(std::ldexp(diagonal, 1 - halvings))) --halvings;
  } else {
    do {
      ++halvings;
    } while (halvings < kMaxHalvings && !enough(std::ldexp(diagonal, -halvings)));
  }
  double fine = std::ldexp(diagonal, -halvings), coarse = halvings > 0 ? 2 * fine : fine;
  for (int i = 0; i < 4; ++i) {
    const double middle = std::sqrt(coarse * fine);
    (enough(middle) ? fine : coarse) = middle;
  }
  return fine;
}

}  // namespace tcm_icp
