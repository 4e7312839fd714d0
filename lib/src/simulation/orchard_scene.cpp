// An orchard: trees in equal rows, so that every scan looks like the same scan one tree or one row farther.

#include <numbers>

#include "simulation/box.hpp"
#include "simulation/draw.hpp"
#include "simulation/ground.hpp"
#include "simulation/require_length.hpp"
#include "tcm_icp/simulation/scene.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kRow_m = 4.5, kTree_m = 4;  // from row to row, from tree to tree
constexpr int kRows = 10;
constexpr double kBeyond_m = 30;       // rows go on beyond both ends of the way
constexpr double kOff_m = 0.15;        // how far a tree stands from its place, along and across
constexpr double kMissing = 0.06;      // of the trees
constexpr double kMostSpread_m = 1.3;  // of a crown
constexpr double kAisle_m = 1;         // ground without trees beyond the outer rows
constexpr double kBark = 0.35, kLeaf = 0.45;

void add_fruit_tree(TriangleMesh& mesh, const Isometry3d& T_world_tree, Rng& rng) {
  const double height = uniform(rng, 2.6, 3.6);
  const double spread = uniform(rng, 0.8, kMostSpread_m);
  const double radius = uniform(rng, 0.06, 0.1);
  add_frustum(mesh, T_world_tree * Translation3d(0, 0, -kObjectFooting_m),
              {radius, 0.7 * radius, kObjectFooting_m + height - spread, 10}, kBark);
  add_foliage(mesh, T_world_tree * Translation3d(0, 0, height - 0.8 * spread),
              {Vector3d(spread, spread, 0.8 * spread), static_cast<int>(350 * spread), 0.16}, kLeaf, rng);
}

double row_m(int row) { return (row - 0.5 * (kRows - 1)) * kRow_m; }

}  // namespace

void OrchardOptions::validate() const { require_length("orchard: length_m", length_m, 40, 2000); }

Scene make_orchard_scene(const OrchardOptions& options, Rng& rng) {
  options.validate();
  Scene scene;
  const Ground ground(rng);
  for (double x = 0; x <= options.length_m; ++x) scene.path.push_back(ground.lift({x, 0}));
  // The middle aisle's half, less what trees reach into it.
  scene.free_half_width_m = 0.5 * kRow_m - kMostSpread_m - 3 * kOff_m;
  ground.add_along(scene.mesh, scene.path, row_m(kRows - 1) + kAisle_m);
  for (int row = 0; row < kRows; ++row) {
    for (double x = -kBeyond_m; x <= options.length_m + kBeyond_m; x += kTree_m) {
      const double along = uniform(rng, -kOff_m, kOff_m);
      const double across = uniform(rng, -kOff_m, kOff_m);
      const double heading = uniform(rng, 0, 2 * std::numbers::pi);
      if (uniform01(rng) < kMissing) continue;
      add_fruit_tree(scene.mesh, upright_pose(ground.lift({x + along, row_m(row) + across}), heading), rng);
    }
  }
  return scene;
}

}  // namespace tcm_icp
