#include "hidden_share.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tcm_icp/core/morton_code.hpp"

namespace tcm_icp {
namespace {

// What is clearly nearer: beyond noise and the slope of a surface across a bin.
constexpr float kGapOfScan = 0.005F, kGapOfRange = 0.02F;

constexpr float kCells = 1024;  // along an axis, so that a code has 30 bits

// Indices along Morton's curve, in the box of the points.
std::vector<std::uint32_t> z_order(const UnitCloud& cloud) {
  const std::size_t n = cloud.size();
  std::vector<std::uint32_t> code(n, 0);
  std::uint32_t axis = 0;
  for (const auto* values : {&cloud.x, &cloud.y, &cloud.z}) {
    if (n == 0) break;
    const auto [low, high] = std::minmax_element(values->begin(), values->end());
    const float scale = *high > *low ? (kCells - 1) / (*high - *low) : 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto cell = static_cast<std::uint32_t>(((*values)[i] - *low) * scale);
      code[i] |= static_cast<std::uint32_t>(morton_spread(cell)) << axis;
    }
    ++axis;
  }
  std::vector<std::uint64_t> keys(n);
  for (std::size_t i = 0; i < n; ++i) keys[i] = std::uint64_t{code[i]} << 32U | i;
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<std::uint32_t>(keys[i]);  // the lower half
  return order;
}

}  // namespace

UnitCloud UnitCloud::thinned(std::size_t count) const {
  if (count >= size()) return *this;
  UnitCloud out;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i * size() / count;
    out.x.push_back(x[k]), out.y.push_back(y[k]), out.z.push_back(z[k]);
    out.nx.push_back(nx[k]), out.ny.push_back(ny[k]), out.nz.push_back(nz[k]);
  }
  return out;
}

HiddenShare::HiddenShare(const UnitCloud& cloud, double bins_per_point)
    : bins_(static_cast<std::size_t>(bins_per_point * static_cast<double>(cloud.size()))),
      index_(z_order(cloud)),
      bin_(cloud.size()),
      range_(cloud.size()),
      nearest_(bins_.size()) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    surfaces_.push_back({cloud.x[i], cloud.y[i], cloud.z[i], cloud.nx[i], cloud.ny[i], cloud.nz[i]});
  }
  for (const std::uint32_t i : index_) x_.push_back(cloud.x[i]), y_.push_back(cloud.y[i]), z_.push_back(cloud.z[i]);
}

void HiddenShare::look_from(const Eigen::Vector3f& place) {
  const std::size_t n = index_.size();
  const float px = place.x(), py = place.y(), pz = place.z();
  const float *x = x_.data(), *y = y_.data(), *z = z_.data();
  std::int32_t* bin = bin_.data();
  float* range = range_.data();
  const DirectionBins bins = bins_;
  for (std::size_t i = 0; i < n; ++i) {
    const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
    range[i] = std::sqrt(dx * dx + dy * dy + dz * dz);
    bin[i] = bins(dx, dy, dz);
  }
  std::fill(nearest_.begin(), nearest_.end(), std::numeric_limits<std::uint64_t>::max());
  for (std::size_t i = 0; i < n; ++i) {
    // Bits of floats that are not negative are ordered as they are; of equally near points the first counts.
    const std::uint64_t own = std::uint64_t{std::bit_cast<std::uint32_t>(range[i])} << 32U | index_[i];
    std::uint64_t& nearest = nearest_[static_cast<std::size_t>(bin[i])];
    nearest = std::min(nearest, own);
  }
}

bool HiddenShare::hides(std::size_t bin, std::size_t i) const {
  const std::uint64_t nearest = nearest_[bin];
  const float gap = kGapOfScan + kGapOfRange * range_[i];
  // Of an empty bin it is not a number, which is no nearer than anything.
  const auto nearest_range = std::bit_cast<float>(static_cast<std::uint32_t>(nearest >> 32U));
  if (!(range_[i] - nearest_range > gap)) return false;
  return apart(surfaces_[index_[i]], surfaces_[static_cast<std::uint32_t>(nearest)], gap);
}

double HiddenShare::operator()(const Eigen::Vector3f& place, double at_most) {
  const std::size_t n = index_.size();
  if (n == 0) return 0;
  look_from(place);
  const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(n); };
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (hides(static_cast<std::size_t>(bin_[i]), i) && share(++hidden) > at_most) break;
  }
  return share(hidden);
}

double HiddenShare::inner(const Eigen::Vector3f& place) {
  const std::size_t n = index_.size();
  if (n == 0) return 0;
  look_from(place);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!hides(static_cast<std::size_t>(bin_[i]), i)) continue;
    const int row = bin_[i] / bins_.edge(), column = bin_[i] % bins_.edge();
    const auto hides_at = [&](int r, int c) { return hides(bins_.wrapped(r, c), i); };
    if ((hides_at(row, column - 1) && hides_at(row, column + 1)) ||
        (hides_at(row - 1, column) && hides_at(row + 1, column))) {
      ++hidden;
    }
  }
  return static_cast<double>(hidden) / static_cast<double>(n);
}

}  // namespace tcm_icp
