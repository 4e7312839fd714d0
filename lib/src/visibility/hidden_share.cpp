#include "hidden_share.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

// What is clearly nearer: beyond noise and the slope of a surface across a bin.
constexpr float kGapOfScan = 0.005F, kGapOfRange = 0.02F;

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
    : cloud_(cloud),
      bins_(static_cast<std::size_t>(bins_per_point * static_cast<double>(cloud.size()))),
      bin_(cloud.size()),
      range_(cloud.size()),
      nearest_(bins_.size()) {}

// Neither lies on the other's tangent plane: a floor seen at a low angle fills a bin at many distances.
bool HiddenShare::apart(std::size_t p, std::size_t q, float gap) const {
  const float dx = cloud_.x[p] - cloud_.x[q], dy = cloud_.y[p] - cloud_.y[q], dz = cloud_.z[p] - cloud_.z[q];
  return std::abs(dx * cloud_.nx[p] + dy * cloud_.ny[p] + dz * cloud_.nz[p]) > gap &&
         std::abs(dx * cloud_.nx[q] + dy * cloud_.ny[q] + dz * cloud_.nz[q]) > gap;
}

double HiddenShare::operator()(const Eigen::Vector3f& place) {
  const std::size_t n = cloud_.size();
  const float px = place.x(), py = place.y(), pz = place.z();
  const float *x = cloud_.x.data(), *y = cloud_.y.data(), *z = cloud_.z.data();
  std::int32_t* bin = bin_.data();
  float* range = range_.data();
  const DirectionBins bins = bins_;
  for (std::size_t i = 0; i < n; ++i) {
    const float dx = x[i] - px, dy = y[i] - py, dz = z[i] - pz;
    range[i] = std::sqrt(dx * dx + dy * dy + dz * dz);
    bin[i] = bins(dx, dy, dz);
  }
  std::fill(nearest_.begin(), nearest_.end(), -1);
  for (std::size_t i = 0; i < n; ++i) {
    std::int32_t& nearest = nearest_[static_cast<std::size_t>(bin[i])];
    if (nearest < 0 || range[i] < range[nearest]) nearest = static_cast<std::int32_t>(i);
  }
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto nearest = static_cast<std::size_t>(nearest_[static_cast<std::size_t>(bin[i])]);
    const float gap = kGapOfScan + kGapOfRange * range[i];
    if (range[i] - range[nearest] > gap && apart(i, nearest, gap)) ++hidden;
  }
  return n == 0 ? 0 : static_cast<double>(hidden) / static_cast<double>(n);
}

}  // namespace tcm_icp
