#include "report/scene_sample.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kDrawnByWanted = 3;  // so that cells have points to choose from

// SplitMix64: one number after the other gives well mixed bits, and scan lines leave no pattern.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

double uniform(std::uint64_t x) { return static_cast<double>(mixed(x) >> 11U) * 0x1p-53; }

std::uint64_t cell_key(const Eigen::Vector3f& p, double cell_m) {
  constexpr double kHalf = 1 << 20;
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const double at = std::clamp(std::floor(static_cast<double>(p[k]) / cell_m) + kHalf, 0.0, 2 * kHalf - 1);
    key = (key << 21U) | static_cast<std::uint64_t>(at);
  }
  return key;
}

// c of sum min(count, c) = wanted.
double points_of_cell(std::vector<std::size_t> counts, std::size_t wanted) {
  std::sort(counts.begin(), counts.end());
  auto left = static_cast<double>(wanted);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double each = left / static_cast<double>(counts.size() - k);
    if (static_cast<double>(counts[k]) >= each) return each;
    left -= static_cast<double>(counts[k]);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Eigen::Vector3f> even_over_cells(std::vector<Eigen::Vector3f> points, std::size_t wanted, double cell_m) {
  if (points.size() <= wanted) return points;
  std::vector<std::pair<std::uint64_t, std::size_t>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = {cell_key(points[i], cell_m), i};
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) counts.push_back(0);
    ++counts.back();
  }
  const double each = points_of_cell(counts, wanted);
  std::vector<Eigen::Vector3f> out;
  out.reserve(wanted + wanted / 16);
  for (std::size_t i = 0, cell = 0; cell < counts.size(); i += counts[cell++]) {
    for (std::size_t k = i; k < i + counts[cell]; ++k) {
      const std::size_t at = order[k].second;
      if (uniform(at) * static_cast<double>(counts[cell]) < each) out.push_back(points[at]);
    }
  }
  return out;
}

SceneSampler::SceneSampler(const std::vector<std::uint64_t>& num_points, std::size_t wanted)
    : share_(num_points.size()),
      seen_(num_points.size(), 0),
      limit_(num_points.size(), std::numeric_limits<std::uint64_t>::max()),
      points_(num_points.size()) {
  std::vector<std::size_t> counts;
  for (const std::uint64_t n : num_points) {
    if (n > 0) counts.push_back(static_cast<std::size_t>(n));
  }
  const double each = points_of_cell(counts, wanted);
  for (std::size_t i = 0; i < num_points.size(); ++i) {
    const auto n = static_cast<double>(num_points[i]);
    share_[i] = static_cast<std::size_t>(std::min(n, each));
    const double drawn = static_cast<double>(kDrawnByWanted * share_[i]);
    if (drawn < n) limit_[i] = static_cast<std::uint64_t>(drawn / n * 0x1p64);
    points_[i].reserve(static_cast<std::size_t>(std::min(n, 1.02 * drawn)));
  }
}

void SceneSampler::add(std::size_t scan, std::span<const Eigen::Vector3d> raw, const Eigen::Vector3d& origin) {
  if (share_[scan] == 0) return;
  std::uint64_t number = seen_[scan];
  for (const Eigen::Vector3d& p : raw) {
    if (mixed(number++) <= limit_[scan]) points_[scan].emplace_back((p - origin).cast<float>());
  }
  seen_[scan] = number;
}

double SceneSampler::extent_m() const {
  Eigen::AlignedBox3f box;
  for (const auto& of_scan : points_) {
    for (const auto& p : of_scan) box.extend(p);
  }
  return box.isEmpty() ? 0 : static_cast<double>(box.sizes().maxCoeff());
}

ScenePoints SceneSampler::take(const std::vector<double>& cell_m, int num_threads) {
  parallel_for(num_threads, points_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      points_[i] = even_over_cells(std::move(points_[i]), share_[i], cell_m[i]);
    }
  });
  return std::move(points_);
}

}  // namespace tcm_icp
