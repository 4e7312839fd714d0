#include "tcm_icp/registration/scan_pyramid.hpp"

#include <algorithm>
#include <cmath>

#include "core/tie.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/voxel_octaves.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

constexpr int kMaxHalvings = 40;     // 1e-12 of the diagonal
constexpr int kSteps = 16;           // between two of them
constexpr int kSortedHalvings = 19;  // at which one sort tells the counts; finer ones are of clouds with strays
constexpr double kCellVoxels = 5;    // of the index: distances that are asked of a level are up to that

// The least number in (below, enough] for which is_enough holds, which it does from there on. Asks for `guess` and its
// neighbours first.
template <typename IsEnough>
int first_enough(int below, int enough, int guess, IsEnough is_enough) {
  for (int asked = 0; enough - below > 1; ++asked) {
    if (asked > 1 || guess <= below || guess >= enough) guess = below + (enough - below) / 2;
    if (is_enough(guess)) {
      enough = guess--;
    } else {
      below = guess++;
    }
  }
  return enough;
}

// The edge so many sixteenths of an octave below `coarse_m`.
double edge_at(double coarse_m, int step) {
  double fine_m = coarse_m / 2;
  for (int below = 0, width = kSteps; width > 1;) {
    width /= 2;
    const double middle_m = std::sqrt(coarse_m * fine_m);
    if (step <= below + width) {
      fine_m = middle_m;
    } else {
      coarse_m = middle_m;
      below += width;
    }
  }
  return fine_m;
}

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
  const auto ratio = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(wanted); };

  // Voxels of a 2^n-th of the diagonal nest: one sort counts them at all these edges.
  const std::vector<std::size_t> counts =
      VoxelOctaves(points, (low + high) / 2, std::ldexp(diagonal, -kSortedHalvings)).counts();
  const auto count_at = [&](int halvings) {
    return halvings <= kSortedHalvings ? counts[kSortedHalvings - halvings]
                                       : count_voxels(points, std::ldexp(diagonal, -halvings), wanted);
  };
  int enough = 0;
  std::size_t count = count_at(0), count_below = 0;
  while (enough < kMaxHalvings && count < wanted) {
    count_below = count;
    count = count_at(++enough);
  }
  if (enough == 0) return diagonal;
  const double coarse_m = std::ldexp(diagonal, 1 - enough);
  int guess = kSteps / 2;
  if (count_below > 0) {
    const double octave = std::log2(ratio(count) / ratio(count_below));
    guess = static_cast<int>(std::ceil(-kSteps * std::log2(ratio(count_below)) / octave));
  }
  const int step = first_enough(0, kSteps, guess,
                                [&](int k) { return count_voxels(points, edge_at(coarse_m, k), wanted) >= wanted; });
  return edge_at(coarse_m, step);
}

}  // namespace tcm_icp
