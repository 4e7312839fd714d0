#include "tcm_icp/coarse/height_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "envelope.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr double kFootprintShare = 0.99;
constexpr double kWallNormal = 0.3;  // sine of 17 degrees: what leans more is no wall

// Weights of a Gaussian, cut off at three standard deviations; [0] is the middle.
std::vector<float> half_gaussian(double sigma) {
  std::vector<float> weights(static_cast<std::size_t>(std::ceil(3 * sigma)) + 1);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double x = static_cast<double>(i) / sigma;
    weights[i] = static_cast<float>(std::exp(-x * x / 2));
  }
  return weights;
}

// Where a row holds anything but zeros.
struct Extent {
  int first = 0, last = 0;
};

std::vector<Extent> extents_of_rows(const std::vector<float>& in, int size) {
  std::vector<Extent> out(static_cast<std::size_t>(size));
  for (int r = 0; r < size; ++r) {
    const float* row = in.data() + static_cast<std::ptrdiff_t>(r) * size;
    const auto filled = [](float value) { return value != 0; };
    const float* first = std::find_if(row, row + size, filled);
    if (first == row + size) continue;
    const float* last = std::find_if(std::reverse_iterator(row + size), std::reverse_iterator(first), filled).base();
    out[static_cast<std::size_t>(r)] = {static_cast<int>(first - row), static_cast<int>(last - row)};
  }
  return out;
}

// out += weight * in, shifted by `offset` rows. Zeros add nothing, and most of a map was not seen.
void add_rows(const std::vector<float>& in, const std::vector<Extent>& extents, int size, int offset, float weight,
              std::vector<float>& out) {
  const int first = std::max(0, -offset), last = std::min(size, size - offset);
  for (int r = first; r < last; ++r) {
    const Extent extent = extents[static_cast<std::size_t>(r + offset)];
    const float* from = in.data() + static_cast<std::ptrdiff_t>(r + offset) * size;
    float* to = out.data() + static_cast<std::ptrdiff_t>(r) * size;
    for (int c = extent.first; c < extent.last; ++c) to[c] += weight * from[c];
  }
}

std::vector<float> smooth_columns(const std::vector<float>& in, int size, const std::vector<float>& weights) {
  std::vector<float> out(in.size(), 0.0F);
  const std::vector<Extent> extents = extents_of_rows(in, size);
  for (int k = 0; k < static_cast<int>(weights.size()); ++k) {
    add_rows(in, extents, size, k, weights[static_cast<std::size_t>(k)], out);
    if (k > 0) add_rows(in, extents, size, -k, weights[static_cast<std::size_t>(k)], out);
  }
  return out;
}

// Where each row of `mask` has cells: elsewhere nobody asks for the sums.
std::vector<float> smooth_rows(const std::vector<float>& in, int size, const std::vector<float>& weights,
                               const std::vector<float>& mask) {
  std::vector<float> out(in.size(), 0.0F);
  const std::vector<Extent> asked = extents_of_rows(mask, size);
  for (int r = 0; r < size; ++r) {
    const float* from = in.data() + static_cast<std::ptrdiff_t>(r) * size;
    float* to = out.data() + static_cast<std::ptrdiff_t>(r) * size;
    const auto [first, last] = asked[static_cast<std::size_t>(r)];
    for (int k = 0; k < static_cast<int>(weights.size()); ++k) {
      const float weight = weights[static_cast<std::size_t>(k)];
      for (int c = first; c < std::min(last, size - k); ++c) to[c] += weight * from[c + k];
      if (k == 0) continue;
      for (int c = std::max(first, k); c < last; ++c) to[c] += weight * from[c - k];
    }
  }
  return out;
}

// Sums over the cells nearby, at the cells of the mask.
std::vector<float> smooth(const std::vector<float>& in, int size, const std::vector<float>& weights,
                          const std::vector<float>& mask) {
  return smooth_rows(smooth_columns(in, size, weights), size, weights, mask);
}

// Values less their mean over the seen cells nearby, clipped, of variance 1.
std::vector<float> find_detail(const std::vector<float>& values, const HeightMap& map, const std::vector<float>& seen,
                               const std::vector<float>& weights, float clip_sigma) {
  const auto sum = smooth(values, map.size, weights, map.mask);
  std::vector<float> detail(values.size(), 0.0F);
  double squares = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (map.mask[k] == 0) continue;
    detail[k] = values[k] - sum[k] / seen[k];
    squares += static_cast<double>(detail[k]) * detail[k];
  }
  const auto sigma = static_cast<float>(std::sqrt(squares / std::max(1, map.num_seen)));
  if (!(sigma > 0)) return detail;
  squares = 0;
  for (float& d : detail) {
    d = std::clamp(d / sigma, -clip_sigma, clip_sigma);
    squares += static_cast<double>(d) * d;
  }
  const auto scale = static_cast<float>(std::sqrt(map.num_seen / squares));
  for (float& d : detail) d *= scale;
  return detail;
}

// Unlike heights, whose reach depends on where the scanner stood, a wall is one from everywhere. Not where there is no
// normal: |n| is 0 or 1.
bool is_wall(const Eigen::Vector3d& normal) {
  return std::abs(normal.z()) < kWallNormal && normal.head<2>().squaredNorm() > 0.5;
}

// Long strips have a large radius and little area.
double equivalent_width_m(const Points& points, const Eigen::Isometry3d& T_map_scan) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  std::vector<Eigen::Vector2d> plan(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    plan[i] = (T_map_scan * points[i]).head<2>();
    covariance += plan[i] * plan[i].transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  double area_m2 = 1;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d direction = solver.eigenvectors().col(axis);
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = direction.dot(plan[i]);
    const double high_m = quantile(values, kFootprintShare);
    area_m2 *= high_m - quantile(values, 1 - kFootprintShare);
  }
  return std::sqrt(area_m2);
}

}  // namespace

void HeightMapOptions::validate() const {
  for (const auto& [name, value] :
       {std::pair("smoothing_cells", smoothing_cells), std::pair("clip_sigma", clip_sigma)}) {
    if (!(value > 0 && std::isfinite(value))) {
      throw InvalidOptions(std::string(name) + " is " + std::to_string(value) + "; it must be positive");
    }
  }
}

Footprint find_footprint(const Points& points, const Eigen::Vector3d& up) {
  const Eigen::Matrix3d R = levelling_rotation(up);
  Eigen::Vector3d middle;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d direction = R.row(axis);
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = direction.dot(points[i]);
    const double high = quantile(values, kFootprintShare);
    middle[axis] = (quantile(values, 1 - kFootprintShare) + high) / 2;
  }
  Footprint out;
  out.T_map_scan = Eigen::Translation3d(-middle) * Eigen::Isometry3d(R);
  for (std::size_t i = 0; i < points.size(); ++i) values[i] = (out.T_map_scan * points[i]).head<2>().norm();
  out.radius_m = quantile(values, kFootprintShare);
  out.width_m = equivalent_width_m(points, out.T_map_scan);
  return out;
}

HeightMap make_height_map(const Cloud& cloud, const Footprint& footprint, double cell_m,
                          const HeightMapOptions& options) {
  options.validate();
  if (!(cell_m > 0))
    throw InvalidOptions("the cell of a height map is " + std::to_string(cell_m) + "; it must be positive");
  HeightMap map;
  map.T_map_scan = footprint.T_map_scan;
  map.cell_m = cell_m;
  map.size = 2 * (static_cast<int>(footprint.radius_m / cell_m) + 1);
  const auto n = static_cast<std::size_t>(map.size);
  map.height.assign(n * n, 0.0F);
  map.mask.assign(n * n, 0.0F);
  const double half = map.size / 2 + 0.5;
  std::vector<float> walls(n * n, 0.0F), all(n * n, 0.0F);
  const Eigen::Matrix3d R_map_scan = map.T_map_scan.linear();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = map.T_map_scan * cloud.points[i];
    const double column = std::floor(p.x() / cell_m + half), row = std::floor(p.y() / cell_m + half);
    if (!(column >= 0 && column < map.size && row >= 0 && row < map.size)) continue;
    const std::size_t k = static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column);
    const auto h = static_cast<float>(p.z() / cell_m);
    if (map.mask[k] == 0 || h > map.height[k]) map.height[k] = h;
    map.mask[k] = 1;
    all[k] += 1;
    if (cloud.has_normals() && is_wall(R_map_scan * cloud.normals[i])) walls[k] += 1;
  }
  map.num_seen = static_cast<int>(std::count(map.mask.begin(), map.mask.end(), 1.0F));
  const auto weights = half_gaussian(options.smoothing_cells);
  const auto seen = smooth(map.mask, map.size, weights, map.mask);
  const auto clip_sigma = static_cast<float>(options.clip_sigma);
  map.detail = find_detail(map.height, map, seen, weights, clip_sigma);
  std::vector<float> structure(n * n);
  for (std::size_t k = 0; k < n * n; ++k) {
    if (map.mask[k] != 0) structure[k] = walls[k] / all[k];
  }
  map.structure = find_detail(structure, map, seen, weights, clip_sigma);
  return map;
}

}  // namespace tcm_icp
