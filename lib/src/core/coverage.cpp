#include "tcm_icp/core/coverage.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "voxel_table.hpp"

namespace tcm_icp {
namespace {

constexpr int kFirstHalvings = 12;
constexpr std::size_t kLeastVoxels = 64;  // fewer say nothing of a dimension
constexpr double kLine = 1.05;            // the dimension of a line, and what a grid makes of an oblique one
// A line that passes through a block and those around it occupies twelve voxels there; a gap in it may take a third.
constexpr std::uint32_t kLeastAround = 8;
constexpr std::size_t kPlacesAsked = 4000;  // a dimension to one in a hundred
constexpr double kFewIsolated = 0.1;        // of all voxels: so few hardly change a dimension
constexpr double kMostIsolated = 0.5;       // with more, the rest are patches of what is sparse

VoxelKey halved(const VoxelKey& k) { return {k.x >> 1, k.y >> 1, k.z >> 1}; }

// The occupied voxels at twice the edge of a level, with the number of the level's voxels in each: 1 to 8.
struct Octave {
  explicit Octave(const std::vector<VoxelKey>& fine) : num_fine(fine.size()) {
    VoxelTable table;
    for (const VoxelKey& k : fine) {
      const std::uint32_t number = table.find_or_insert(halved(k));
      if (number == occupied.size()) occupied.push_back(0);
      ++occupied[number];
    }
    coarse = table.keys();
  }

  std::size_t num_fine;
  std::vector<VoxelKey> coarse;
  std::vector<std::uint32_t> occupied;  // in the order of `coarse`
};

// Tells by which voxels nothing continuous passes: fewer occupied ones lie around than a line has.
class Surroundings {
 public:
  explicit Surroundings(const Octave& octave) {
    for (std::size_t i = 0; i < octave.coarse.size(); ++i) {
      const std::uint32_t block = blocks_.find_or_insert(halved(octave.coarse[i]));
      if (block == occupied_.size()) occupied_.push_back(0);
      occupied_[block] += octave.occupied[i];
    }
  }

  // All voxels of a block are isolated, or none: so are all that lie in one of the octave's coarse ones.
  bool isolate(const VoxelKey& coarse) const {
    const VoxelKey centre = halved(coarse);
    std::uint32_t around = occupied(centre);  // most blocks of surfaces need no other
    for (int cell = 0; cell < 27 && around < kLeastAround; ++cell) {
      if (cell == 13) continue;
      around += occupied({centre.x + cell % 3 - 1, centre.y + cell / 3 % 3 - 1, centre.z + cell / 9 - 1});
    }
    return around < kLeastAround;
  }

 private:
  std::uint32_t occupied(const VoxelKey& block) const {
    const std::uint32_t number = blocks_.find(block);
    return number == VoxelTable::kNone ? 0 : occupied_[number];
  }

  VoxelTable blocks_;  // of four voxels' edge
  std::vector<std::uint32_t> occupied_;
};

double dimension(std::size_t num_fine, std::size_t num_coarse) {
  return std::log2(static_cast<double>(num_fine) / static_cast<double>(num_coarse));
}

// Without the isolated voxels, where they are many: each stays one at any edge, and many would hide the surfaces.
// Whether they are, and the dimension then, comes of a sample of places, which depends on no order.
double dimension_of_surfaces(const Octave& octave) {
  const double of_all = dimension(octave.num_fine, octave.coarse.size());
  // Saves time: left out, so many leave less than a line even if each has a coarse voxel to itself.
  const auto most = static_cast<std::size_t>(kMostIsolated * static_cast<double>(octave.num_fine));
  if (most < octave.coarse.size() && dimension(octave.num_fine - most, octave.coarse.size() - most) <= kLine) {
    return of_all;
  }
  const Surroundings surroundings(octave);
  std::size_t one_of = 1;
  while (octave.coarse.size() / one_of > kPlacesAsked) one_of *= 2;
  std::size_t num_isolated = 0, num_kept = 0, num_coarse = 0;
  for (std::size_t i = 0; i < octave.coarse.size(); ++i) {
    if (VoxelKeyHash{}(octave.coarse[i]) % one_of != 0) continue;
    if (surroundings.isolate(octave.coarse[i])) {
      num_isolated += octave.occupied[i];
    } else {
      num_kept += octave.occupied[i];
      ++num_coarse;
    }
  }
  const double share = static_cast<double>(num_isolated) / static_cast<double>(num_isolated + num_kept);
  const bool are_left_out = share > kFewIsolated && share <= kMostIsolated && num_coarse >= kLeastVoxels;
  return are_left_out ? dimension(num_kept, num_coarse) : of_all;
}

}  // namespace

double coverage_m(const Points& points, double extent_m) {
  double edge_m = std::ldexp(extent_m, -kFirstHalvings);
  VoxelTable table;
  for (const auto& p : points) table.find_or_insert(voxel_key(p, edge_m));
  std::vector<VoxelKey> keys = table.keys();
  double before = 0;  // dimension one octave below
  while (true) {
    Octave octave(keys);
    if (octave.coarse.size() < kLeastVoxels) return 0;
    const double here = dimension_of_surfaces(octave);
    if (here > kLine) {
      // Counts at an edge and at twice as much tell the dimension half-way between, which is where it is reached.
      const double share = (kLine - before) / (here - before);
      return edge_m * std::exp2(share - 0.5);
    }
    before = here;
    keys = std::move(octave.coarse);
    edge_m *= 2;
  }
}

}  // namespace tcm_icp
