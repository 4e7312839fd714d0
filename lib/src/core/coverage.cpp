#include "tcm_icp/core/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tcm_icp {
namespace {

constexpr std::size_t kLeastVoxels = 64;  // fewer say nothing of a dimension
constexpr double kLine = 1.05;            // the dimension of a line, and what a grid makes of an oblique one
// A line occupies six voxels in and around a coarse one that it passes through; a gap in it may take a third.
constexpr std::uint32_t kLeastAround = 4;
constexpr std::size_t kPlacesAsked = 4000;  // a dimension to one in a hundred
constexpr double kFewIsolated = 0.1;        // of all voxels: so few hardly change a dimension
constexpr double kMostIsolated = 0.6;       // with more, the rest are patches of what is sparse

double dimension_of(std::size_t num_fine, std::size_t num_coarse) {
  return std::log2(static_cast<double>(num_fine) / static_cast<double>(num_coarse));
}

// The occupied voxels at twice the edge of a level, with the number of the level's voxels in each: 1 to 8.
class Octave {
 public:
  explicit Octave(const std::vector<VoxelCode>& fine) : num_fine_(fine.size()) {
    for (const VoxelCode code : fine) {
      if (coarse_.empty() || coarse_.back() != code >> 3) {
        coarse_.push_back(code >> 3);
        occupied_.push_back(0);
      }
      ++occupied_.back();
    }
  }

  const std::vector<VoxelCode>& coarse() const { return coarse_; }
  std::uint32_t occupied(std::size_t i) const { return occupied_[i]; }
  double dimension() const { return dimension_of(num_fine_, coarse_.size()); }

  // Nothing continuous passes by: fewer voxels are occupied in and around a coarse one than a line has.
  bool is_isolated(std::size_t i) const {
    std::uint32_t around = occupied_[i];
    for (int n = 0; n < kTouchingVoxels && around < kLeastAround; ++n) {
      const VoxelCode near = touching_voxel(coarse_[i], n);
      if (near == coarse_[i]) continue;
      const auto found = std::lower_bound(coarse_.begin(), coarse_.end(), near);
      if (found != coarse_.end() && *found == near) around += occupied_[found - coarse_.begin()];
    }
    return around < kLeastAround;
  }

 private:
  std::size_t num_fine_;
  std::vector<VoxelCode> coarse_;  // ascending
  std::vector<std::uint8_t> occupied_;
};

// What a sample of places says, which depends on no order.
struct Isolation {
  double share = 0;                          // of a level's voxels
  std::size_t num_kept = 0, num_coarse = 0;  // voxels that are not isolated, and those at twice the edge
};

Isolation isolation(const Octave& octave, const VoxelOctaves& voxels, int num_doublings) {
  std::size_t one_of = 1;
  while (octave.coarse().size() / one_of > kPlacesAsked) one_of *= 2;
  std::size_t num_isolated = 0;
  Isolation out;
  for (std::size_t i = 0; i < octave.coarse().size(); ++i) {
    if (one_of > 1 && VoxelKeyHash{}(voxels.key(octave.coarse()[i], num_doublings)) % one_of != 0) continue;
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

}  // namespace

double coverage_m(const VoxelOctaves& voxels) {
  Octave octave(voxels.finest());
  double dimension_below = 0;  // one octave
  Isolation below{1};
  for (int num_doublings = 1;; ++num_doublings) {
    if (octave.coarse().size() < kLeastVoxels) return 0;
    const Isolation here = isolation(octave, voxels, num_doublings);
    const double dimension =
        are_left_out(here, below) ? dimension_of(here.num_kept, here.num_coarse) : octave.dimension();
    if (dimension > kLine) {
      // Counts at an edge and at twice as much tell the dimension half-way between, which is where it is reached.
      const double share = (kLine - dimension_below) / (dimension - dimension_below);
      return std::ldexp(voxels.finest_m(), num_doublings - 1) * std::exp2(share - 0.5);
    }
    dimension_below = dimension;
    below = here;
    octave = Octave(octave.coarse());
  }
}

}  // namespace tcm_icp
