#include "tcm_icp/registration/normal_space_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tcm_icp/core/place_sampling.hpp"

namespace tcm_icp {
namespace {

constexpr int kCellsPerAxis = 4;
constexpr std::size_t kNumBins = 3 * kCellsPerAxis * kCellsPerAxis;

// The face of a cube the normal's line leaves through, and the cell on it.
std::size_t direction_bin(const Eigen::Vector3d& n) {
  Eigen::Index axis;
  n.cwiseAbs().maxCoeff(&axis);
  const double u = n[(axis + 1) % 3] / n[axis], v = n[(axis + 2) % 3] / n[axis];  // -1..1, the same for n and -n
  const auto cell = [](double x) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>((x + 1) / 2 * kCellsPerAxis), 0, kCellsPerAxis - 1));
  };
  return (static_cast<std::size_t>(axis) * kCellsPerAxis + cell(u)) * kCellsPerAxis + cell(v);
}

}  // namespace

std::vector<std::size_t> normal_space_sample(const Cloud& cloud, std::size_t count,
                                             std::span<const std::uint64_t> priorities) {
  std::array<std::vector<std::size_t>, kNumBins> bins;
  std::size_t num_candidates = 0;
  for (std::size_t i = 0; i < cloud.normals.size(); ++i) {
    if (cloud.normals[i].isZero()) continue;
    bins[direction_bin(cloud.normals[i])].push_back(i);
    ++num_candidates;
  }
  double total = 0;
  for (const auto& bin : bins) total += std::sqrt(static_cast<double>(bin.size()));
  std::vector<std::size_t> out;
  if (num_candidates <= count) {
    for (const auto& bin : bins) out.insert(out.end(), bin.begin(), bin.end());
  } else {
    // What small directions leave over goes to the large ones, which are visited last.
    std::array<std::size_t, kNumBins> order{};
    for (std::size_t b = 0; b < kNumBins; ++b) order[b] = b;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return bins[a].size() < bins[b].size(); });
    double left = static_cast<double>(count);
    for (const std::size_t b : order) {
      const double root = std::sqrt(static_cast<double>(bins[b].size()));
      if (root == 0) continue;
      const auto quota = static_cast<std::size_t>(std::lround(left * root / total));
      const auto chosen = least_priorities(std::move(bins[b]), priorities, quota);
      out.insert(out.end(), chosen.begin(), chosen.end());
      left -= static_cast<double>(chosen.size());
      total -= root;
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace tcm_icp
