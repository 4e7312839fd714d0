#include "simulation/scan_pattern.hpp"

#include <cmath>
#include <numbers>

#include "simulation/draw.hpp"

namespace tcm_icp {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

namespace {

Vector3d outward(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

Vector3d downward(double ahead_rad, double across_rad) {
  return {std::sin(ahead_rad), std::cos(ahead_rad) * std::sin(across_rad), -std::cos(ahead_rad) * std::cos(across_rad)};
}

}  // namespace

std::size_t ScanPattern::num_sweeps() const {
  if (is_aerial()) return 1 + static_cast<std::size_t>(options_.strip_length_m / options_.line_spacing_m);
  return static_cast<std::size_t>(std::lround(360 / options_.step_deg));
}

std::size_t ScanPattern::num_rays() const {
  switch (options_.sensor) {
    case SensorKind::kSpinning:
      return static_cast<std::size_t>(options_.num_lines);
    case SensorKind::kAerial:
      return 1 + static_cast<std::size_t>(2 * options_.half_swath_deg / options_.step_deg);
    case SensorKind::kTerrestrial:
      break;
  }
  return 1 + static_cast<std::size_t>((options_.max_elevation_deg - options_.min_elevation_deg) / options_.step_deg);
}

RayAngles ScanPattern::angles(std::size_t sweep, std::size_t ray) const {
  const double row = static_cast<double>(ray);
  if (is_aerial()) return {0, options_.step_deg * row - options_.half_swath_deg};
  const double azimuth_deg = 360.0 * static_cast<double>(sweep) / static_cast<double>(num_sweeps());
  const double between_lines_deg =
      options_.sensor == SensorKind::kSpinning
          ? (options_.max_elevation_deg - options_.min_elevation_deg) / (options_.num_lines - 1)
          : options_.step_deg;
  return {azimuth_deg, options_.min_elevation_deg + between_lines_deg * row};
}

Vector3d ScanPattern::direction(const RayAngles& angles) const {
  const double first = radians(angles.first_deg), second = radians(angles.second_deg);
  return is_aerial() ? downward(first, second) : outward(first, second);
}

Vector3d ScanPattern::random_direction(Rng& rng) const {
  if (is_aerial()) return downward(0, radians(uniform(rng, -options_.half_swath_deg, options_.half_swath_deg)));
  const double azimuth = 2 * std::numbers::pi * uniform01(rng);
  return outward(azimuth, radians(uniform(rng, options_.min_elevation_deg, options_.max_elevation_deg)));
}

Isometry3d ScanPattern::T_scan_sweep(std::size_t sweep) const {
  if (is_aerial()) return T_scan_recorded(sweep);
  // One turn lasts 1 / turns_per_s; its middle is where the scan is said to have been taken.
  const double turn = static_cast<double>(sweep) / static_cast<double>(num_sweeps()) - 0.5;
  return Isometry3d(Translation3d(options_.speed_m_s / options_.turns_per_s * turn, 0, 0));
}

Isometry3d ScanPattern::T_scan_recorded(std::size_t sweep) const {
  if (!is_aerial()) return Isometry3d::Identity();
  const double middle = static_cast<double>(num_sweeps() - 1) / 2;
  return Isometry3d(Translation3d(options_.line_spacing_m * (static_cast<double>(sweep) - middle), 0, 0));
}

}  // namespace tcm_icp
