#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/decompositions.hpp"
#include "density_fit.hpp"
#include "hidden_share.hpp"
#include "place_grid.hpp"
#include "place_search.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/visibility/point_density.hpp"
#include "unit_frame.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMinSamples = 200;
constexpr std::size_t kSeenPoints = 60000, kMinSeenPoints = 200;
constexpr double kBinsPerPoint = 2;

// The basin of a minimum is about as wide as its distance from what is near: some cells of the grid lead there.
constexpr double kFirstPlaces = 500;
constexpr std::size_t kFirstSamples = 300, kFits = 4;
constexpr std::size_t kFitSamples = 750, kMinima = 3;
constexpr double kSamePlace = 0.02;  // minima nearer to one another are one

constexpr double kDeviations = 3;
// Of simulated and real scans, right places had up to 0.038 of the points behind others, leaves mostly, and all but
// two wrong ones more. The two lay between two right ones, where scans had been made one; their misfit tells.
constexpr double kMostHiddenByDensity = 0.04;
// Median of absolute residuals of log areas. 24 points that lie at random count for 0.14 of it.
constexpr double kMaxMisfit = 0.19;

DensitySamples in_units(const DensitySamples& samples, const UnitFrame& frame) {
  const Eigen::Isometry3d T_axes_cloud = frame.T_cloud_axes.inverse();
  DensitySamples out;
  for (const auto& p : samples.points) out.points.push_back(T_axes_cloud * p / frame.unit_m);
  for (const auto& n : samples.normals) out.normals.push_back(T_axes_cloud.linear() * n);
  for (const double a : samples.log_area) out.log_area.push_back(a - 2 * std::log(frame.unit_m));
  return out;
}

std::array<Eigen::Vector3d, 3> main_axes(const Points& normals) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& n : normals) sum += n * n.transpose();
  const Eigen::Matrix3d axes = symmetric_eigen3(sum).vectors;
  return {axes.col(0), axes.col(1), axes.col(2)};
}

struct FittedModel {
  double loss;
  DensityModel model;
};

bool has_less_loss(const FittedModel& a, const FittedModel& b) { return a.loss < b.loss; }

std::vector<FittedModel> search_grid_of_models(const DensitySamples& samples, const Eigen::AlignedBox3d& box) {
  const std::size_t stride = std::max<std::size_t>(1, samples.points.size() / kFirstSamples);
  const PlaceGrid<double> grid = grid_of_places(box, kFirstPlaces);
  std::vector<FittedModel> found;
  for (const Eigen::Vector3d& place : grid.places) {
    const DensityModel model = model_from(place, samples, stride);
    found.push_back({density_loss(model, samples, stride), model});
  }
  std::stable_sort(found.begin(), found.end(), has_less_loss);
  return first_apart(found, kFits, kNotNextSteps * grid.step, [](const FittedModel& f) { return f.model.place; });
}

// Those of least loss first. Which minimum is the least shows with few samples.
std::vector<FittedModel> fit_models(const DensitySamples& samples, const Eigen::AlignedBox3d& box) {
  const std::size_t stride = std::max<std::size_t>(1, samples.points.size() / kFitSamples);
  const auto fit = [&](const DensityModel& start) {
    const DensityModel model = fit_density(start, samples, stride);
    return FittedModel{density_loss(model, samples, stride), model};
  };
  const auto apart = [&](std::vector<FittedModel> fitted, std::size_t count) {
    std::stable_sort(fitted.begin(), fitted.end(), has_less_loss);
    return first_apart(fitted, count, kSamePlace, [](const FittedModel& f) { return f.model.place; });
  };
  const std::array<Eigen::Vector3d, 3> axes = main_axes(samples.normals);
  std::vector<FittedModel> even, all;
  for (const FittedModel& start : search_grid_of_models(samples, box)) even.push_back(fit(start.model));
  even = apart(even, kMinima);
  for (const FittedModel& start : even) {
    all.push_back(start);
    for (const Eigen::Vector3d& axis : axes) {
      DensityModel model = start.model;
      model.axis = axis;
      all.push_back(fit(model));
    }
  }
  return apart(all, kMinima);
}

double misfit(const DensityModel& model, const DensitySamples& samples) {
  std::vector<double> residuals = density_residuals(model, samples);
  for (double& r : residuals) r = std::abs(r);
  return median(residuals);
}

int octant(const Eigen::Vector3d& ray) { return (ray.x() > 0 ? 1 : 0) + (ray.y() > 0 ? 2 : 0) + (ray.z() > 0 ? 4 : 0); }

// Covariance of the place by leaving out one octant about it at a time.
Eigen::Matrix3d jackknife(const DensityModel& model, const DensitySamples& samples) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  int count = 0;
  for (int left_out = 0; left_out < 8; ++left_out) {
    DensitySamples others;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      if (octant(samples.points[i] - model.place) == left_out) continue;
      others.points.push_back(samples.points[i]);
      others.normals.push_back(samples.normals[i]);
      others.log_area.push_back(samples.log_area[i]);
    }
    if (others.points.size() == samples.points.size()) continue;
    if (others.points.size() < kMinSamples / 2) return Eigen::Matrix3d::Identity();
    ++count;
    const Eigen::Vector3d by = fit_density(model, others).place - model.place;
    sum += by * by.transpose();
  }
  return count < 2 ? Eigen::Matrix3d::Identity() : Eigen::Matrix3d(sum * (count - 1) / count);
}

}  // namespace

std::optional<Viewpoint> find_viewpoint_by_density(const Cloud& cloud, const DensitySamples& samples, Rng& rng) {
  if (samples.points.size() < kMinSamples) return std::nullopt;
  const std::optional<UnitFrame> frame = find_unit_frame(cloud, kSeenPoints, kMinSeenPoints, rng);
  if (!frame) return std::nullopt;
  const DensitySamples units = in_units(samples, *frame);
  const Eigen::AlignedBox3d box = search_box(frame->box).cast<double>();
  std::optional<HiddenShare> hidden;
  for (const FittedModel& fitted : fit_models(units, box)) {
    if (!box.contains(fitted.model.place)) continue;
    const DensityModel model = fit_density(fitted.model, units);
    const Eigen::Vector3d& place = model.place;
    if (!box.contains(place) || misfit(model, units) > kMaxMisfit) continue;
    // Seen from behind a plane, points on it would lie as densely.
    if (!hidden) hidden.emplace(frame->cloud, kBinsPerPoint);
    const double share = hidden->inner(place.cast<float>());
    if (share > kMostHiddenByDensity) continue;
    const double variance = symmetric_eigen3(jackknife(model, units)).values[2];  // in its weakest direction
    Viewpoint out;
    out.evidence = ViewpointEvidence::kDensity;
    out.place = frame->from_axes(place);
    out.hidden_share = share;
    out.allowed_hidden_share = kMostHiddenByDensity;
    out.radius_m = kDeviations * std::sqrt(variance) * frame->unit_m;
    out.extent_m = frame->unit_m;
    return out;
  }
  return std::nullopt;
}

}  // namespace tcm_icp
