#pragma once
// What the links say about where a scan lies, once some scans are placed.

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "link_search.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/graph/correspondence_graph.hpp"

namespace tcm_icp {

/// A pose of a scan, and what its links to placed scans say of it.
struct StartPose {
  Eigen::Isometry3d T_reference_scan = Eigen::Isometry3d::Identity();
  /// Log-odds of the links that lead there, summed, less what those of links that lead elsewhere exceed kDoubtLogOdds;
  /// a pair with several hypotheses counts by how much the best one elsewhere outdoes the one that leads there.
  double log_odds = 0;
  std::size_t num_links = 0;  ///< that lead there
};

class PoseGraph {
 public:
  explicit PoseGraph(std::size_t num_scans) : num_scans_(num_scans) {}

  /// A pair's hypotheses join those it has, likeliest first. a < b.
  void add(const CandidateLink& link);
  /// The same, all ranked anew, since they are rivals.
  void add(const CandidateLink& link, const PointMoments& points_b, double voxel_m);
  const std::map<std::pair<std::size_t, std::size_t>, CandidateLink>& links() const { return links_; }

  /// Weighs every link by the loops of three it is part of: clear links, by their likeliest poses, either close or
  /// contradict one another. Log-odds come from a pair alone; in a place that repeats itself all pairs err alike, and
  /// only loops show it. A link counts by the share of its loops that close, with the set's own share standing in where
  /// it has few: fully from nine in ten on, not at all below a half. The worst link is dropped first, and its loops
  /// are not held against the others; but none counts more than the set's own share allows. Links that free space told
  /// of and did not veto are weighed by their own loops alone. Replaces earlier weights.
  /// Cost: n loops a clear link.
  /// @param points  of each scan
  /// @param same_m  rms over a scan's points within which poses are one
  void weigh_by_loops(const std::vector<PointMoments>& points, double same_m);

  /// Poses of `scan` that its links to placed scans lead to, likeliest first: those within `same_m` (rms over the scan)
  /// are one.
  std::vector<StartPose> start_poses(std::size_t scan, const std::vector<bool>& placed,
                                     const std::vector<Eigen::Isometry3d>& T_reference_scan, const PointMoments& points,
                                     double same_m) const;

  /// What all links of `scan` to placed scans say of its pose T_reference_scan[scan].
  StartPose support(std::size_t scan, const std::vector<bool>& placed,
                    const std::vector<Eigen::Isometry3d>& T_reference_scan, const PointMoments& points,
                    double same_m) const;

  /// Of `scan`'s links to placed scans.
  std::size_t num_hypotheses(std::size_t scan, const std::vector<bool>& placed) const;

  /// Scans that clear links do not join to the largest group of scans.
  std::vector<bool> outside_of_largest_group() const;

  /// The graph of links more likely right than wrong, among the scans with `wanted`: measure 1 - probability.
  CorrespondenceGraph correspondence_graph(const std::vector<bool>& wanted) const;

 private:
  template <typename Visit>
  void for_each_link(std::size_t scan, const std::vector<bool>& placed, Visit visit) const {
    for (const auto& [pair, link] : links_) {
      if (pair.first != scan && pair.second != scan) continue;
      const std::size_t other = pair.first == scan ? pair.second : pair.first;
      if (placed[other]) visit(other, link);
    }
  }

  std::size_t num_scans_;
  std::map<std::pair<std::size_t, std::size_t>, CandidateLink> links_;
};

}  // namespace tcm_icp
