#pragma once
// A bounded sample of a stream of points: one mean point per occupied voxel, voxels growing as the stream needs it.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Integer coordinates of a voxel; 64 bits an axis, so no point is out of range.
struct VoxelKey {
  std::int64_t x = 0, y = 0, z = 0;
  friend bool operator==(const VoxelKey&, const VoxelKey&) = default;
};

/// floor(point / voxel_size); coordinates beyond 2^61 voxels share the outermost one.
VoxelKey voxel_key(const Eigen::Vector3d& point, double voxel_size_m);

/// The nearest of a series with 31 steps a decade (7.7 % each): voxels whose edge was measured are the same where the
/// measurements differ by a rounding. 31, because units then lie on the series, too: 1,000 is 93 steps, a foot 16 (to
/// 0.03 %). 0 stays 0.
double rounded_voxel_size(double voxel_size_m);

struct VoxelKeyHash {
  std::size_t operator()(const VoxelKey& key) const;
};

/// What a VoxelSampler keeps of a stream of points.
struct VoxelSample {
  Points points;              ///< [m]
  std::vector<float> counts;  ///< points that each stands for
};

/// Streaming voxel sampling. The voxel starts well below the points' spacing (a fixed share of the first points' median
/// distance from their median, so that it scales and turns with the data) and doubles whenever more than `max_voxels`
/// are occupied. Memory is O(max_voxels), whatever the number of points. Order of the voxels: by their first point.
/// Once voxels have grown, neighbours whose means are nearer than half a voxel become one point: a place seen many
/// times would otherwise be up to eight of them, wherever voxel borders run through it, and the neighbourhoods that
/// normals come from would be that one place.
class VoxelSampler {
 public:
  /// @param max_voxels  >= 8; the sample has at most this many points
  explicit VoxelSampler(std::size_t max_voxels);
  ~VoxelSampler();
  VoxelSampler(VoxelSampler&&) noexcept;
  VoxelSampler& operator=(VoxelSampler&&) noexcept;

  /// Adds finite points [m], near the origin of their own local frame.
  void add(std::span<const Eigen::Vector3d> points);

  /// One mean point per occupied voxel, or per place that fills several. Call once, at the end.
  VoxelSample finish();

  /// Voxel edge at the end [m]; 0 where all points were equal.
  double voxel_size_m() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Number of voxels of the given size that hold a point; counting ends at `stop_at`. O(N).
std::size_t count_voxels(const Points& points, double voxel_size_m,
                         std::size_t stop_at = std::numeric_limits<std::size_t>::max());

/// One mean point per voxel of the given size; normals, where there are any, are averaged as axes of the point nearest
/// the mean.
Cloud voxel_downsample(const Cloud& cloud, double voxel_size_m);

}  // namespace tcm_icp
