#pragma once
// The part of S, the cloud of all scans merged so far, that a scan can meet.

#include <cstddef>
#include <vector>

#include "inference/compared_pairs.hpp"
#include "scans/prepared_scan.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {

/// S as the scans that make it up. What lies near a scan is put together from those that overlap with it most, so that
/// a merge costs the same in a set of ten as in one of a thousand.
class MergedScans {
 public:
  /// Keeps references: all three must outlive it. Scans are where inference has put them until one is merged.
  MergedScans(const std::vector<PreparedScan>& scans, const PairGraph& graph, const Component& inferred);

  /// From now on at this pose. Returns the members whose part of S is another one now.
  std::vector<std::size_t> add(std::size_t scan, const Eigen::Isometry3d& T_reference_scan);

  bool has(std::size_t scan) const { return merged_[scan]; }
  /// Merged scans where they were merged, others where inference puts them.
  const Component& component() const { return component_; }
  /// Where a merged scan is; where inference puts another beside the merged one that it overlaps most with, so that
  /// what fits have moved so far moves it, too.
  Eigen::Isometry3d pose(std::size_t scan) const;
  /// Whether a hypothesis that holds joins the scan to what is merged.
  bool joins(std::size_t scan) const { return !neighbors_[scan].empty(); }

  /// What is merged near a member, in the reference's frame; thread-safe. Of those that nothing joins, what is nearest.
  PyramidLevel near(std::size_t scan, std::size_t level) const;
  ScanPyramid near(std::size_t scan) const;

 private:
  struct Neighbor {
    double overlap;
    std::size_t scan;
  };
  std::vector<std::size_t> neighbors_of(std::size_t scan) const;

  const std::vector<PreparedScan>& scans_;
  const PairGraph& graph_;
  const Component& inferred_;
  Component component_;
  std::vector<bool> merged_;
  std::vector<std::vector<Neighbor>> neighbors_;  ///< merged ones of each scan, the most overlapping first
};

}  // namespace tcm_icp
