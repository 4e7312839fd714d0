#include "tcm_icp/visibility/range_image.hpp"

#include <algorithm>
#include <limits>

#include "direction_bins.hpp"

namespace tcm_icp {
namespace {

const DirectionBins kBins(41'253);  // square degrees of a sphere

std::size_t bin_of(const Eigen::Vector3d& direction) {
  const Eigen::Vector3f d = direction.cast<float>();
  return static_cast<std::size_t>(kBins(d.x(), d.y(), d.z()));
}

}  // namespace

RangeImage::RangeImage(const Eigen::Vector3d& place, const Points& points) : place_(place), bins_(kBins.size()) {
  constexpr double kFar = std::numeric_limits<float>::max();
  std::vector<double> least(kBins.size(), kFar), greatest(kBins.size(), 0);
  for (const auto& p : points) {
    const Eigen::Vector3d ray = p - place;
    const double range = ray.norm();
    const std::size_t bin = bin_of(range > 0 ? ray / range : ray);
    least[bin] = std::min(least[bin], range);
    greatest[bin] = std::max(greatest[bin], range);
  }
  for (int row = 0; row < kBins.edge(); ++row) {
    for (int column = 0; column < kBins.edge(); ++column) {
      Surroundings s{kFar, 0, 0};
      for (int k = 0; k < 9; ++k) {
        const std::size_t near = kBins.wrapped(row + k / 3 - 1, column + k % 3 - 1);
        s.least_m = std::min(s.least_m, least[near]);
        s.greatest_m = std::max(s.greatest_m, greatest[near]);
        s.num_filled += least[near] < kFar ? 1 : 0;
      }
      bins_[kBins.wrapped(row, column)] = {static_cast<float>(s.least_m), static_cast<float>(s.greatest_m),
                                           static_cast<std::uint8_t>(s.num_filled)};
    }
  }
}

RangeImage::Surroundings RangeImage::about(const Eigen::Vector3d& direction) const {
  const Bin& bin = bins_[bin_of(direction)];
  return {bin.least_m, bin.greatest_m, bin.num_filled};
}

}  // namespace tcm_icp
