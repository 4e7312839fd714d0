#include "tcm_icp/io/scan_colour.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {

std::array<std::uint8_t, 3> scan_colour(std::size_t scan_index) {
  constexpr std::array<double, 3> kSaturation = {0.70, 0.95, 0.45};
  constexpr std::array<double, 3> kBrightness = {0.95, 0.72, 1.00};
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double turns = static_cast<double>(scan_index) * kGoldenRatio;
  const double hue = 6 * (turns - std::floor(turns));
  const double saturation = kSaturation[scan_index % 3], brightness = kBrightness[scan_index % 3];
  // HSV to RGB: each channel is a trapezium over the hue, shifted by a third of the wheel.
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue, 6.0);
    const double dip = std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(255 * brightness * (1 - saturation * dip) + 0.5);
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace tcm_icp
