#include "simulation/ground.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "simulation/draw.hpp"

namespace tcm_icp {
namespace {

constexpr double kReflectivity = 0.3;

}  // namespace

Ground::Ground(Rng& rng) {
  for (double& s : slope_) s = uniform(rng, -0.015, 0.015);
  for (Wave& wave : waves_) {
    const double length = uniform(rng, 12, 45);
    const double heading = uniform(rng, 0, 2 * std::numbers::pi);
    wave.number = 2 * std::numbers::pi / length * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    wave.phase_rad = uniform(rng, 0, 2 * std::numbers::pi);
    wave.height_m = 0.004 * length;
  }
}

double Ground::height_m(const Eigen::Vector2d& at) const {
  double z = slope_.dot(at);
  for (const Wave& wave : waves_) z += wave.height_m * std::sin(wave.number.dot(at) + wave.phase_rad);
  return z;
}

void Ground::add_to(TriangleMesh& mesh, double reach_m) const {
  const int cells = static_cast<int>(std::ceil(2 * reach_m));
  const auto at = [&](int i, int j) {
    return lift({2 * reach_m * i / cells - reach_m, 2 * reach_m * j / cells - reach_m});
  };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j)
      add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), kReflectivity);
  }
}

void Ground::add_along(TriangleMesh& mesh, const Points& path, double reach_m) const {
  // By tiles, not cells: the points of a path share most of their surroundings. A set, so that the order is fixed.
  constexpr int kTile_m = 8;
  const int reach = static_cast<int>(std::ceil(reach_m / kTile_m));
  std::set<std::pair<int, int>> tiles;
  for (const auto& p : path) {
    const int x = static_cast<int>(std::floor(p.x() / kTile_m)), y = static_cast<int>(std::floor(p.y() / kTile_m));
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) tiles.insert({x + i, y + j});
  }
  const auto at = [&](int x, int y) { return lift({x, y}); };
  for (const auto& [tile_x, tile_y] : tiles) {
    for (int x = kTile_m * tile_x; x < kTile_m * (tile_x + 1); ++x)
      for (int y = kTile_m * tile_y; y < kTile_m * (tile_y + 1); ++y)
        add_quad(mesh, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1), kReflectivity);
  }
}

}  // namespace tcm_icp
