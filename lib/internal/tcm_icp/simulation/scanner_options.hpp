#pragma once
// What a simulated scanner does, and what it does wrong.

#include <string>

namespace tcm_icp {

enum class SensorKind {
  kTerrestrial,  ///< on a tripod: a dome of rays
  kSpinning,     ///< on a vehicle: a few lines that turn about the vertical
  kAerial        ///< flying: lines across a strip below
};

/// "terrestrial", "spinning", "aerial"; @throws InvalidOptions  naming the sensors there are
SensorKind sensor_kind_from_name(const std::string& name);
std::string sensor_name(SensorKind kind);

/// The defaults are a terrestrial scanner without the effects that are 0 (or 90 degrees) here; default_scanner() has
/// those of each sensor.
struct ScannerOptions {
  SensorKind sensor = SensorKind::kTerrestrial;
  double step_deg = 0.4;            ///< [deg] 0.02..10, between rays: terrestrial in azimuth and elevation, spinning in
                                    ///< azimuth, aerial across the strip
  double min_elevation_deg = -60;   ///< [deg] -90 <= min < max <= 90; below it the tripod is in the way; not of aerial
  double max_elevation_deg = 70;    ///< [deg]
  int num_lines = 32;               ///< 2..256, of spinning: evenly from min to max elevation
  double half_swath_deg = 30;       ///< [deg] 1..80, of aerial: to either side of straight down
  double strip_length_m = 80;       ///< [m] > 0, of aerial: flown during one scan
  double line_spacing_m = 0.25;     ///< [m] > 0, of aerial: along the flight
  double min_range_m = 0.6;         ///< [m] >= 0; nearer surfaces give no return
  double max_range_m = 80;          ///< [m] > min_range_m
  double range_noise_m = 0.005;     ///< [m] >= 0, standard deviation along the ray
  double angular_noise_deg = 0.01;  ///< [deg] >= 0, standard deviation of a ray's true direction about the recorded one
  double full_return_signal = 0.1;  ///< > 0; reflectivity times cosine of incidence from which a return is certain;
                                    ///< below it the chance falls in proportion (glass, grazing incidence)
  double max_incidence_deg = 90;    ///< [deg] 0..90; surfaces met at a more grazing angle give no return
  double dropout_share = 0;         ///< 0..1, returns that get lost whatever they met
  double beam_width_deg = 0;        ///< [deg] 0..1; a beam of this width that meets two surfaces not farther apart
                                    ///< than a pulse is long gives a range between them: mixed pixels at edges
  double speed_m_s = 0;             ///< [m/s] |speed| <= 50; of the platform along its x axis while the scan is taken,
                                    ///< not corrected for. An aerial scan's motion is known and does no harm
  double turns_per_s = 10;          ///< [1/s] > 0; a terrestrial or spinning scan is one turn
  double thinning_voxel_m = 0.15;   ///< [m] >= 0; of each voxel's returns the first is kept; 0 keeps all
  double isolated_share = 0.002;    ///< 0..0.5, returns in mid air (dust, birds, rain) as a share of the kept ones
  void validate() const;            ///< throws InvalidOptions
};

/// A scanner of each kind with all effects but motion: terrestrial 5 mm of noise, 0.4 degrees between rays; spinning 3
/// cm, 32 lines; aerial 3 cm, 30 degrees to either side.
ScannerOptions default_scanner(SensorKind kind);

}  // namespace tcm_icp
