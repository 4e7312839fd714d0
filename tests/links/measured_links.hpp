#pragma once
// What pairs of scans may show, without scans.

#include <limits>

#include "tcm_icp/links/link_measurements.hpp"

namespace tcm_icp::testing {

constexpr double kVoxel_m = 0.1, kNoise_m = 0.005;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// As right poses of a building usually have it.
inline LinkMeasurements usual_link() {
  LinkMeasurements m;
  m.evidence.num_points = 500;
  m.evidence.overlap = 0.6;
  m.evidence.inlier_share = 0.8;
  m.evidence.median_residual_m = 0.08 * kVoxel_m;
  m.evidence.tolerance_m = kVoxel_m / 4;
  m.evidence.slide_m = 4 * kVoxel_m;
  m.evidence.left_after_slide = {0.4, 0.3, 0.3, 0.2, 0.2, 0.1};
  m.evidence.left_across = 0.2;
  m.evidence.num_across = 120;
  m.other_overlap = 0.5;
  m.other_inlier_share = 0.75;
  m.free_space = {2000, 4, 1500, 30};
  m.slid_space = {3000, 90, 0, 0};
  m.sighted = true;
  return m;
}

/// As poses have it that nobody would take for right.
inline LinkMeasurements terrible_link() {
  LinkMeasurements m = usual_link();
  m.evidence.overlap = 0.2;
  m.evidence.inlier_share = 0.1;
  m.evidence.median_residual_m = 0.8 * kVoxel_m;
  m.evidence.left_after_slide = {1.5, 1.2, 1.1, 1, 1, 0.9};
  m.evidence.left_across = 1.5;
  m.evidence.num_across = 50;
  m.other_overlap = 0.1;
  m.other_inlier_share = 0.1;
  m.free_space = {2000, 600, 500, 300};
  m.slid_space = {3000, 900, 0, 0};
  return m;
}

/// The same in units of 1/`factor` of these.
inline LinkMeasurements scaled_link(LinkMeasurements m, double factor) {
  m.evidence.median_residual_m *= factor;
  m.evidence.tolerance_m *= factor;
  m.evidence.slide_m *= factor;
  return m;
}

}  // namespace tcm_icp::testing
