#include "tcm_icp/visibility/range_image.hpp"

#include <algorithm>
#include <limits>

#include "direction_bins.hpp"

namespace tcm_icp {
RangeImage::RangeImage(const Eigen::Vector3d& place, const Points& points)
    : place_(place), bins_(kRangeImageBins.size()) {
  constexpr double kFar = std::numeric_limits<float>::max();
  std::vector<double> least(kRangeImageBins.size(), kFar), greatest(kRangeImageBins.size(), 0);
  for (const auto& p : points) {
    const Eigen::Vector3d ray = p - place;
    const double range = ray.norm();
    const std::size_t bin = kRangeImageBins(range > 0 ? Eigen::Vector3d(ray / range) : ray);
    least[bin] = std::min(least[bin], range);
    greatest[bin] = std::max(greatest[bin], range);
  }
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    Surroundings s{kFar, 0, 0};
    for (const std::size_t near : kRangeImageBins.around(bin)) {
      s.least_m = std::min(s.least_m, least[near]);
      s.greatest_m = std::max(s.greatest_m, greatest[near]);
      s.num_filled += least[near] < kFar ? 1 : 0;
    }
    bins_[bin] = {static_cast<float>(s.least_m), static_cast<float>(s.greatest_m),
                  static_cast<std::uint8_t>(s.num_filled)};
  }
}

RangeImage::Surroundings RangeImage::about(const Eigen::Vector3d& direction) const {
  const Bin& bin = bins_[kRangeImageBins(direction)];
  return {bin.least_m, bin.greatest_m, bin.num_filled};
}

}  // namespace tcm_icp
