#include "tcm_icp/core/coverage.hpp"

#include <cmath>
#include <optional>

#include "voxel_table.hpp"

namespace tcm_icp {
namespace {

constexpr int kFirstHalvings = 12;
constexpr std::size_t kLeastVoxels = 64;  // fewer say nothing of a dimension
constexpr double kLine = 1.05;            // the dimension of a line, and what a grid makes of an oblique one

}  // namespace

double coverage_m(const Points& points, double extent_m) {
  double edge_m = std::ldexp(extent_m, -kFirstHalvings);
  std::vector<VoxelKey> keys;
  {
    VoxelTable table;
    for (const auto& p : points) table.find_or_insert(voxel_key(p, edge_m));
    keys = table.keys();
  }
  double before = 0;  // dimension one octave below
  while (true) {
    VoxelTable coarser;
    for (const VoxelKey& k : keys) coarser.find_or_insert({k.x >> 1, k.y >> 1, k.z >> 1});
    if (coarser.size() < kLeastVoxels) return 0;
    const double dimension = std::log2(static_cast<double>(keys.size()) / coarser.size());
    if (dimension > kLine) {
      // Counts at an edge and at twice as much tell the dimension half-way between, which is where it is reached.
      const double share = (kLine - before) / (dimension - before);
      return edge_m * std::exp2(share - 0.5);
    }
    before = dimension;
    keys = coarser.keys();
    edge_m *= 2;
  }
}

}  // namespace tcm_icp
