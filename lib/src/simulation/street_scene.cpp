// The middle lines of simulated streets: a winding one, one around a corner, one around a block, and all of a town.

#include <cmath>

#include "simulation/draw.hpp"
#include "simulation/require_length.hpp"
#include "simulation/street_builder.hpp"
#include "simulation/tree.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

/// Chaikin's corner cutting: each corner becomes two of half the angle. The ends stay.
Points with_cut_corners(const Points& path) {
  Points out{path.front()};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d step = path[i + 1] - path[i];
    if (i > 0) out.push_back(path[i] + 0.25 * step);
    if (i + 2 < path.size()) out.push_back(path[i] + 0.75 * step);
  }
  out.push_back(path.back());
  return out;
}

}  // namespace

void StreetOptions::validate() const { require_length("street: length_m", length_m, 40, 20000); }

void UrbanOptions::validate() const { require_length("urban: length_m", length_m, 40, 20000); }

void BlockOptions::validate() const { require_length("block: perimeter_m", perimeter_m, 120, 20000); }

void TownGridOptions::validate() const { require_length("town-grid: length_m", length_m, 400, 50000); }

Scene make_street_scene(const StreetOptions& options, Rng& rng) {
  options.validate();
  // Headings stay within 25 degrees of the x axis: however long, the street never meets itself.
  Points path{Vector3d::Zero()};
  for (double left = options.length_m; left > 0;) {
    const double heading = radians(uniform(rng, -25, 25));
    double step = std::min(left, uniform(rng, 35, 80));
    if (left - step < 20) step = left;
    path.push_back(path.back() + step * Vector3d(std::cos(heading), std::sin(heading), 0));
    left -= step;
  }
  return StreetBuilder(with_cut_corners(with_cut_corners(path)), rng).build();
}

Scene make_urban_scene(const UrbanOptions& options, Rng& rng) {
  options.validate();
  // Around a corner: the two halves of the way see little of each other.
  const double turn = (uniform01(rng) < 0.5 ? -1 : 1) * radians(uniform(rng, 60, 90));
  Points path{Vector3d::Zero()};
  constexpr int kLegs = 4;
  for (int leg = 0; leg < kLegs; ++leg) {
    const double heading = (leg < kLegs / 2 ? 0 : turn) + radians(uniform(rng, -12, 12));
    path.push_back(path.back() + options.length_m / kLegs * Vector3d(std::cos(heading), std::sin(heading), 0));
  }
  StreetStyle leafy;
  leafy.closed_front_share = 0.5;
  leafy.detached_share = 0.35;
  leafy.avenue_share = 0.8;
  leafy.has_wires = true;
  leafy.add_tree = add_broadleaf_tree;
  return StreetBuilder(with_cut_corners(path), rng, leafy).build();
}

Scene make_block_scene(const BlockOptions& options, Rng& rng) {
  options.validate();
  const double longer = options.perimeter_m * uniform(rng, 0.25, 0.29);
  const double shorter = options.perimeter_m / 2 - longer;
  const double bend = 0.04 * options.perimeter_m / 4;
  Points path;
  for (const auto& [x, y] : {std::pair(-1, -1), {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}) {
    const double dx = uniform(rng, -bend, bend);
    const double dy = uniform(rng, -bend, bend);
    path.push_back({x * longer / 2 + dx, y * shorter / 2 + dy, 0});
  }
  path.push_back(path.front());
  return StreetBuilder(path, rng).build();
}

Scene make_town_grid_scene(const TownGridOptions& options, Rng& rng) {
  options.validate();
  // From corner to corner of every street along, then of every street across: 2 m (m - 1) blocks' edges, and the ways
  // from one street to the next along the border.
  constexpr double kLeastEdge_m = 70, kBend = 0.06;
  const auto num_edges = [](int m) { return 2 * m * (m - 1) + 2 * (m - 1); };
  int streets = 2;
  while (num_edges(streets + 1) * kLeastEdge_m <= options.length_m) ++streets;
  const double edge_m = options.length_m / num_edges(streets);
  std::vector<Vector3d> corners;
  for (int k = 0; k < streets * streets; ++k) {
    const double dx = uniform(rng, -kBend, kBend), dy = uniform(rng, -kBend, kBend);
    corners.push_back(edge_m * Vector3d(k % streets + dx, k / streets + dy, 0));
  }
  const auto corner = [&](int x, int y) { return corners[static_cast<std::size_t>(y * streets + x)]; };
  Points path;
  for (int y = 0; y < streets; ++y) {
    for (int x = 0; x < streets; ++x) path.push_back(corner(y % 2 == 0 ? x : streets - 1 - x, y));
  }
  // Streets across begin where those along ended.
  const bool ends_right = streets % 2 == 1;
  for (int x = 0; x < streets; ++x) {
    for (int y = 0; y < streets; ++y) {
      const int column = ends_right ? streets - 1 - x : x;
      path.push_back(corner(column, x % 2 == 0 ? streets - 1 - y : y));
    }
  }
  path.erase(path.begin() + streets * streets);  // where those along ended: the same corner
  return StreetBuilder(path, rng).build();
}

}  // namespace tcm_icp
