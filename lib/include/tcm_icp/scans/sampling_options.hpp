#pragma once
// How scans are thinned for what looks at them.

#include <cstddef>

namespace tcm_icp {

/// How many points stand for a scan. Lengths follow from these numbers and the data.
struct SamplingOptions {
  std::size_t max_working_points = 262'144;  ///< >= 1000; of a scan, while it streams by
  std::size_t coarse_voxels = 60'000;   ///< >= 100; voxels of a typical scan at the resolution scans are placed with
  std::size_t fine_voxels = 100'000;    ///< >= coarse_voxels; and at the one they are adjusted with
  double max_surface_variation = 0.06;  ///< 0..1/3; rougher places (leaves, wires) do not count as surfaces
  void validate() const;                ///< throws InvalidOptions
};

/// Samples of a scan that fits and checks are made with.
struct SampleSizes {
  int coarse_points = 1500;    ///< >= 100; points of a scan in its coarse linear programs
  int fine_points = 3000;      ///< >= 100; and in the finer ones
  int held_out_points = 1500;  ///< >= 100; points for verification, kept from every fit where there are enough
  void validate() const;       ///< throws InvalidOptions
};

}  // namespace tcm_icp
