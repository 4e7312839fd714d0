#include "tcm_icp/simulation/scanner_options.hpp"

#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

void require(bool holds, const char* field, double value, const char* bound) {
  if (!holds)
    throw InvalidOptions("scanner: " + std::string(field) + " = " + std::to_string(value) + "; needs " + bound);
}

ScannerOptions default_terrestrial() {
  ScannerOptions s;
  s.max_incidence_deg = 87;
  s.dropout_share = 0.01;
  s.beam_width_deg = 0.02;
  s.thinning_voxel_m = 0.05;
  return s;
}

/// As makers of spinning scanners state for theirs: 2 to 5 cm, 3 mrad, 10 turns a second.
ScannerOptions default_spinning() {
  ScannerOptions s;
  s.sensor = SensorKind::kSpinning;
  s.step_deg = 0.2;
  s.min_elevation_deg = -25;
  s.max_elevation_deg = 15;
  s.min_range_m = 1;
  s.range_noise_m = 0.03;
  s.angular_noise_deg = 0.05;
  s.full_return_signal = 0.08;
  s.max_incidence_deg = 86;
  s.dropout_share = 0.02;
  s.beam_width_deg = 0.17;
  s.thinning_voxel_m = 0;
  return s;
}

ScannerOptions default_aerial() {
  ScannerOptions s;
  s.sensor = SensorKind::kAerial;
  s.step_deg = 0.2;
  s.min_range_m = 5;
  s.max_range_m = 200;
  s.range_noise_m = 0.03;
  s.angular_noise_deg = 0.01;
  s.max_incidence_deg = 85;
  s.dropout_share = 0.02;
  s.beam_width_deg = 0.03;
  s.thinning_voxel_m = 0;
  s.isolated_share = 0.001;
  return s;
}

}  // namespace

SensorKind sensor_kind_from_name(const std::string& name) {
  for (const SensorKind kind : {SensorKind::kTerrestrial, SensorKind::kSpinning, SensorKind::kAerial})
    if (name == sensor_name(kind)) return kind;
  throw InvalidOptions("sensor '" + name + "' is not known; there are: terrestrial, spinning, aerial");
}

std::string sensor_name(SensorKind kind) {
  switch (kind) {
    case SensorKind::kTerrestrial:
      return "terrestrial";
    case SensorKind::kSpinning:
      return "spinning";
    case SensorKind::kAerial:
      return "aerial";
  }
  throw InvalidOptions("simulate: unknown sensor");
}

ScannerOptions default_scanner(SensorKind kind) {
  switch (kind) {
    case SensorKind::kTerrestrial:
      return default_terrestrial();
    case SensorKind::kSpinning:
      return default_spinning();
    case SensorKind::kAerial:
      return default_aerial();
  }
  throw InvalidOptions("simulate: unknown sensor");
}

void ScannerOptions::validate() const {
  require(step_deg >= 0.02 && step_deg <= 10, "step_deg", step_deg, "0.02..10");
  require(min_elevation_deg >= -90 && min_elevation_deg < max_elevation_deg, "min_elevation_deg", min_elevation_deg,
          "-90 <= min < max");
  require(max_elevation_deg <= 90, "max_elevation_deg", max_elevation_deg, "<= 90");
  require(num_lines >= 2 && num_lines <= 256, "num_lines", num_lines, "2..256");
  require(half_swath_deg >= 1 && half_swath_deg <= 80, "half_swath_deg", half_swath_deg, "1..80");
  require(strip_length_m > 0 && strip_length_m <= 10000, "strip_length_m", strip_length_m, "0 < length <= 10000");
  require(line_spacing_m >= 0.01 && line_spacing_m <= strip_length_m, "line_spacing_m", line_spacing_m,
          "0.01 <= spacing <= strip_length_m");
  require(min_range_m >= 0 && min_range_m < max_range_m, "min_range_m", min_range_m, "0 <= min < max");
  require(std::isfinite(max_range_m), "max_range_m", max_range_m, "a finite number");
  require(range_noise_m >= 0 && range_noise_m < max_range_m, "range_noise_m", range_noise_m,
          "0 <= noise < max_range_m");
  require(angular_noise_deg >= 0 && angular_noise_deg <= 10, "angular_noise_deg", angular_noise_deg, "0..10");
  require(full_return_signal > 0 && full_return_signal <= 1, "full_return_signal", full_return_signal,
          "0 < signal <= 1");
  require(max_incidence_deg > 0 && max_incidence_deg <= 90, "max_incidence_deg", max_incidence_deg, "0 < angle <= 90");
  require(dropout_share >= 0 && dropout_share < 1, "dropout_share", dropout_share, "0 <= share < 1");
  require(beam_width_deg >= 0 && beam_width_deg <= 1, "beam_width_deg", beam_width_deg, "0..1");
  require(std::abs(speed_m_s) <= 50, "speed_m_s", speed_m_s, "-50..50");
  require(turns_per_s >= 0.001 && turns_per_s <= 1000, "turns_per_s", turns_per_s, "0.001..1000");
  require(thinning_voxel_m >= 0 && std::isfinite(thinning_voxel_m), "thinning_voxel_m", thinning_voxel_m, ">= 0");
  require(isolated_share >= 0 && isolated_share <= 0.5, "isolated_share", isolated_share, "0..0.5");
}

}  // namespace tcm_icp
