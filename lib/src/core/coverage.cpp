#include "tcm_icp/core/coverage.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "voxel_table.hpp"

namespace tcm_icp {
namespace {

constexpr int kFirstHalvings = 12;
constexpr std::size_t kLeastVoxels = 64;  // fewer say nothing of a dimension
constexpr double kLine = 1.05;            // the dimension of a line, and what a grid makes of an oblique one
// A line occupies six voxels in and around a coarse one that it passes through; a gap in it may take a third.
constexpr std::uint32_t kLeastAround = 4;
constexpr std::size_t kPlacesAsked = 4000;  // a dimension to one in a hundred
constexpr double kFewIsolated = 0.1;        // of all voxels: so few hardly change a dimension
constexpr double kMostIsolated = 0.6;       // with more, the rest are patches of what is sparse

VoxelKey halved(const VoxelKey& k) { return {k.x >> 1, k.y >> 1, k.z >> 1}; }

double dimension_of(std::size_t num_fine, std::size_t num_coarse) {
  return std::log2(static_cast<double>(num_fine) / static_cast<double>(num_coarse));
}

// The occupied voxels at twice the edge of a level, with the number of the level's voxels in each: 1 to 8.
class Octave {
 public:
  explicit Octave(const std::vector<VoxelKey>& fine) : num_fine_(fine.size()) {
    for (const VoxelKey& k : fine) {
      const std::uint32_t number = table_.find_or_insert(halved(k));
      if (number == occupied_.size()) occupied_.push_back(0);
      ++occupied_[number];
    }
  }

  const std::vector<VoxelKey>& coarse() const { return table_.keys(); }
  std::uint32_t occupied(std::size_t i) const { return occupied_[i]; }
  double dimension() const { return dimension_of(num_fine_, coarse().size()); }

  // Nothing continuous passes by: fewer voxels are occupied in and around a coarse one than a line has.
  bool is_isolated(std::size_t i) const {
    std::uint32_t around = occupied_[i];
    for (int n = 0; n < VoxelTable::kBlock && around < kLeastAround; ++n) {
      const std::uint32_t near = table_.find_in_block(coarse()[i], n);
      if (near != VoxelTable::kNone && near != i) around += occupied_[near];
    }
    return around < kLeastAround;
  }

 private:
  std::size_t num_fine_;
  VoxelTable table_;
  std::vector<std::uint32_t> occupied_;  // in the order of its keys
};

// What a sample of places says, which depends on no order.
struct Isolation {
  double share = 0;                          // of a level's voxels
  std::size_t num_kept = 0, num_coarse = 0;  // voxels that are not isolated, and those at twice the edge
};

Isolation isolation(const Octave& octave) {
  std::size_t one_of = 1;
  while (octave.coarse().size() / one_of > kPlacesAsked) one_of *= 2;
  std::size_t num_isolated = 0;
  Isolation out;
  for (std::size_t i = 0; i < octave.coarse().size(); ++i) {
    if (one_of > 1 && VoxelKeyHash{}(octave.coarse()[i]) % one_of != 0) continue;
    if (octave.is_isolated(i)) {
      num_isolated += octave.occupied(i);
    } else {
      out.num_kept += octave.occupied(i);
      ++out.num_coarse;
    }
  }
  if (num_isolated > 0)
    out.share = static_cast<double>(num_isolated) / static_cast<double>(num_isolated + out.num_kept);
  return out;
}

// Each isolated point stays one voxel at any edge, while the others' merge: its share grows, and many would hide the
// surfaces. Where the share falls, voxels are isolated because surfaces are sparse there, and count.
bool are_left_out(const Isolation& here, const Isolation& below) {
  return here.share > below.share && here.share > kFewIsolated && here.share <= kMostIsolated &&
         here.num_coarse >= kLeastVoxels;
}

VoxelTable occupied_by(const Points& points, double edge_m) {
  VoxelTable table;
  for (const auto& p : points) table.find_or_insert(voxel_key(p, edge_m));
  return table;
}

}  // namespace

double coverage_m(const Points& points, double extent_m) {
  double edge_m = std::ldexp(extent_m, -kFirstHalvings);
  Octave octave(occupied_by(points, edge_m).keys());
  double dimension_below = 0;  // one octave
  Isolation below{1};
  while (true) {
    if (octave.coarse().size() < kLeastVoxels) return 0;
    const Isolation here = isolation(octave);
    const double dimension =
        are_left_out(here, below) ? dimension_of(here.num_kept, here.num_coarse) : octave.dimension();
    if (dimension > kLine) {
      // Counts at an edge and at twice as much tell the dimension half-way between, which is where it is reached.
      const double share = (kLine - dimension_below) / (dimension - dimension_below);
      return edge_m * std::exp2(share - 0.5);
    }
    dimension_below = dimension;
    below = here;
    octave = Octave(octave.coarse());
    edge_m *= 2;
  }
}

}  // namespace tcm_icp
