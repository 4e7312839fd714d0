#pragma once
// Links between scans in unknown frames: coarse candidates of a pair, fitted and looked at by themselves.

#include <Eigen/Geometry>
#include <map>
#include <utility>
#include <vector>

#include "adjustment.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/visibility/free_space.hpp"
#include "verdict.hpp"

namespace tcm_icp {

/// Poses whose rms distance over a scan is less, in coarse voxels, are one to the links: a fit to S starts from either.
constexpr double kSameLinkPose = 4;

/// One pose a pair may have, after a fit.
struct LinkHypothesis {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();  ///< local frames
  PoseCandidate candidate;                                  ///< what the fit started from
  AlignmentEvidence evidence;                               ///< of the direction that overlaps more
  double log_odds = 0;                                      ///< that it is right, by the pair alone (link_score.hpp)
  FreeSpaceEvidence free_space{};                           ///< may veto it
};

/// A pair of scans (a < b) that was tried, with the poses it may have, the likeliest first. Ambiguous pairs keep
/// several until the graph decides.
struct CandidateLink {
  std::size_t a = 0, b = 0;
  std::vector<LinkHypothesis> hypotheses;
  double trust = 1;  ///< 0..1; how far loops bear out what the pair says of itself (PoseGraph::weigh_by_loops)

  /// Log-odds of a hypothesis: by the pair alone, less where loops do not bear out what speaks for it.
  double log_odds(const LinkHypothesis& h) const { return h.log_odds > 0 ? trust * h.log_odds : h.log_odds; }
  /// Scores all hypotheses anew, against one another too, and puts the likeliest first.
  /// @param points_b  of scan b, to tell poses apart by
  void rank(const PointMoments& points_b, double voxel_m);
  void swap();  ///< the same link, the other scan first
  /// The pose of one of the two scans in the other's frame.
  Eigen::Isometry3d T_other(std::size_t scan, const LinkHypothesis& hypothesis) const {
    return scan == b ? hypothesis.T_a_b : hypothesis.T_a_b.inverse();
  }
};

/// Fits each coarse candidate of a pair by linear programs over a light sample and takes its evidence. Candidates that
/// fit to the same pose are one hypothesis. Where free space vetoes a pose, another one is tried; candidates at which
/// far too much is seen through walls are not even fitted.
CandidateLink fit_candidates(const std::vector<PreparedScan>& scans, std::size_t a, std::size_t b,
                             const std::vector<PoseCandidate>& candidates, const PipelineOptions& options);

}  // namespace tcm_icp
