#include "simulation/shore.hpp"

#include <cmath>
#include <numbers>

#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSoil = 0.3;
constexpr double kWater = 0.006;  // most of the light goes in, or away from the scanner
constexpr double kLakeReach_m = 40;
constexpr double kLandReach_m = 55;

}  // namespace

Shore::Shore(Rng& rng) : relief_(rng) {
  for (int i = 0; i < 2; ++i) {
    phase_rad_[i] = uniform(rng, 0, 2 * std::numbers::pi);
    length_m_[i] = i == 0 ? uniform(rng, 50, 80) : uniform(rng, 15, 30);
    height_m_[i] = i == 0 ? uniform(rng, 3, 6) : uniform(rng, 0.6, 1.6);
  }
}

double Shore::shore_y_m(double x) const {
  double y = 0;
  for (int i = 0; i < 2; ++i) y += height_m_[i] * std::sin(2 * std::numbers::pi * x / length_m_[i] + phase_rad_[i]);
  return y;
}

double Shore::height_m(const Vector2d& at) const {
  const double inland = at.y() - shore_y_m(at.x());
  if (inland < 0) return std::max(-2.0, 0.15 * inland);
  // A bank, then a slope; the relief grows away from the water, which is level.
  const double relief = 2 * relief_.height_m(at) * std::min(1.0, inland / 6);
  return std::max(0.05 * inland, 0.8 * (1 - std::exp(-inland / 3)) + 0.05 * inland + relief);
}

void Shore::add_to(TriangleMesh& mesh, double begin_m, double end_m) const {
  const auto cell = [&](double x, double y, double reflectivity) {
    add_quad(mesh, lift({x, y}), lift({x + 1, y}), lift({x + 1, y + 1}), lift({x, y + 1}), reflectivity);
  };
  const double deepest = shore_y_m(0) - kLakeReach_m;
  for (double x = begin_m; x < end_m; ++x) {
    const double water = std::floor(shore_y_m(x)) - 3;
    for (double y = water; y < water + kLandReach_m; ++y) cell(x, y, kSoil);
  }
  add_quad(mesh, Vector3d(begin_m, deepest, 0), Vector3d(end_m, deepest, 0), Vector3d(end_m, 12, 0),
           Vector3d(begin_m, 12, 0), kWater);
}

}  // namespace tcm_icp
