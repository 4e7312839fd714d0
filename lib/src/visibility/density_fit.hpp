#pragma once
// The place from which points would lie as densely as they do. Lengths are in units of a UnitFrame.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tcm_icp/visibility/point_density.hpp"

namespace tcm_icp {

struct DensityModel {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> axis;  ///< about which the scanner turns; none: its steps are equal on the sphere
  double log_step = 0;                  ///< angle between neighbouring points, [rad]
  double log_thinned = 0;               ///< least spacing
};

/// Logarithms of the areas that were found, less those of the model.
std::vector<double> density_residuals(const DensityModel& model, const DensitySamples& samples);

/// Mean soft L1 loss of one in `stride` of the samples.
double density_loss(const DensityModel& model, const DensitySamples& samples, std::size_t stride = 1);

/// The step and least spacing that go with a place, by medians: a start for a fit. One in `stride` of the samples.
DensityModel model_from(const Eigen::Vector3d& place, const DensitySamples& samples, std::size_t stride);

/// Levenberg and Marquardt's method, up to 40 steps, each O(samples / stride).
DensityModel fit_density(const DensityModel& start, const DensitySamples& samples, std::size_t stride = 1);

}  // namespace tcm_icp
