#include "visibility/density_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/box_room.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

const Vector3d kSource(2.9, 2.4, 1.5), kTurningAxis = Vector3d(0.1, 0.2, 1).normalized();

// What the model says, once more, slowly: each spacing by itself.
double area_of(const DensityModel& model, const Vector3d& point, const Vector3d& normal) {
  const Vector3d ray = point - model.place, d = ray.normalized();
  const double even = std::exp(model.log_step) * ray.norm(), thinned = std::exp(model.log_thinned);
  const double elevation = model.axis ? std::asin(model.axis->dot(d)) : 0;
  const auto larger = [&](double spacing) { return std::pow(std::pow(spacing, 4) + std::pow(thinned, 4), 0.25); };
  return larger(even * std::cos(elevation)) * larger(even / std::abs(normal.dot(d)));
}

DensitySamples samples_of(const DensityModel& model) {
  const Cloud cloud = testing::scan_room(testing::furnished_room(), model.place, 4000);
  DensitySamples samples;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d d = (cloud.points[i] - model.place).normalized();
    // Where the model is cut off, it is not what is written here.
    if (std::abs(d.dot(cloud.normals[i])) < 0.05 || (model.axis && std::abs(d.dot(*model.axis)) > 0.98)) continue;
    samples.points.push_back(cloud.points[i]);
    samples.normals.push_back(cloud.normals[i]);
    samples.log_area.push_back(std::log(area_of(model, cloud.points[i], cloud.normals[i])));
  }
  return samples;
}

DensityModel model_of_scanner(bool turns) {
  DensityModel model{kSource, {}, std::log(0.01), std::log(0.02)};
  if (turns) model.axis = kTurningAxis;
  return model;
}

DensityModel start_from(const Vector3d& place, const DensitySamples& samples, const DensityModel& like) {
  DensityModel start = model_from(place, samples, 1);
  start.axis = like.axis;
  return start;
}

TEST(DensityFit, AreasAreThoseOfTheFormula) {
  for (const bool turns : {false, true}) {
    const DensitySamples samples = samples_of(model_of_scanner(turns));
    ASSERT_GT(samples.points.size(), 3000u);
    for (const double r : density_residuals(model_of_scanner(turns), samples)) EXPECT_NEAR(r, 0, 1e-9);
  }
}

TEST(DensityFit, ExactAreasGiveThePlaceBack) {
  for (const bool turns : {false, true}) {
    const DensityModel model = model_of_scanner(turns);
    const DensitySamples samples = samples_of(model);
    const DensityModel start = start_from(kSource + Vector3d(1, -0.7, 0.5), samples, model);
    EXPECT_GT(density_loss(start, samples), 0.01);
    const DensityModel found = fit_density(start, samples);
    EXPECT_LT((found.place - kSource).norm(), 1e-3);
    EXPECT_NEAR(found.log_step, model.log_step, 1e-3);
    EXPECT_NEAR(found.log_thinned, model.log_thinned, 1e-3);
  }
}

TEST(DensityFit, AFifthThatIsWrongMovesItLittle) {
  const DensityModel model = model_of_scanner(true);
  DensitySamples samples = samples_of(model);
  for (std::size_t i = 0; i < samples.log_area.size(); i += 5) samples.log_area[i] += i % 2 == 0 ? 1.5 : 0.8;
  const DensityModel found = fit_density(start_from(kSource + Vector3d(1, -0.7, 0.5), samples, model), samples);
  EXPECT_LT((found.place - kSource).norm(), 0.05);
}

TEST(DensityFit, NeverEndsWithMoreLossThanItBegan) {
  const DensitySamples samples = samples_of(model_of_scanner(false));
  for (const Vector3d& from : {Vector3d(0, 0, 0), Vector3d(100, 0, 0), Vector3d(4, 3, -20), samples.points[0]}) {
    const DensityModel start = model_from(from, samples, 1), found = fit_density(start, samples);
    EXPECT_TRUE(found.place.allFinite());
    EXPECT_LE(density_loss(found, samples), density_loss(start, samples));
  }
}

}  // namespace
}  // namespace tcm_icp
