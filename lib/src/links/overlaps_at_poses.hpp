#pragma once
// How much of two scans overlaps at poses that others lead to.

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "inference/implied_poses.hpp"
#include "scans/prepared_scan.hpp"

namespace tcm_icp {

class OverlapsAtPoses {
 public:
  /// Keeps a reference: the scans must outlive this.
  OverlapsAtPoses(const std::vector<PreparedScan>& scans, int num_threads) : scans_(scans), num_threads_(num_threads) {}

  /// Whether two scans can overlap at all, as far as their extents tell.
  bool may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const;

  /// At each of the poses, 0..1; known ones within `same_m` of them are not asked again. Most of what an inference
  /// implies the one before implied, too.
  std::vector<double> at(const std::vector<ImpliedPose>& poses, double same_m);

 private:
  double distance_m(std::size_t scan) const;
  std::optional<double> known_at(const ImpliedPose& pose, double same_m) const;

  const std::vector<PreparedScan>& scans_;
  int num_threads_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::pair<Eigen::Isometry3d, double>>> known_;
};

/// Those of the poses that overlap at all and are, for either scan and in their configuration, among the
/// `most_partners` best; ascending.
std::vector<std::size_t> most_overlapping(const std::vector<ImpliedPose>& poses, const std::vector<double>& overlaps,
                                          std::size_t most_partners);

}  // namespace tcm_icp
