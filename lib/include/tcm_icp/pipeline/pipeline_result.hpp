#pragma once
// Everything a run found out, for the files and the report.

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tcm_icp/baselines/pair_fit.hpp"
#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/graph/correspondence_graph.hpp"
#include "tcm_icp/decision/scan_decision.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/links/link_measurements.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"
#include "tcm_icp/registration/linear_program.hpp"
#include "tcm_icp/registration/link_strength.hpp"
#include "tcm_icp/registration/pose_covariance.hpp"
#include "tcm_icp/registration/refinement.hpp"
#include "tcm_icp/registration/registration_result.hpp"
#include "tcm_icp/registration/verification.hpp"
#include "tcm_icp/tcm/tcm.hpp"
#include "tcm_icp/visibility/free_space.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// What is known of a scan before it is placed.
struct ScanSummary {
  std::string file;
  std::uint64_t num_points = 0;                      ///< finite points of the file
  std::uint64_t num_dropped_points = 0;              ///< NaN or infinite
  std::size_t num_working_points = 0;                ///< after outlier removal
  double voxel_size_m = 0;                           ///< [m] of the working cloud
  double spacing_m = 0;                              ///< [m] median nearest-neighbour distance of the working cloud
  double noise_m = 0;                                ///< [m] median deviation from the local plane
  double extent_m = 0;                               ///< [m] 90th percentile of the distance from the median point
  OutlierRule outliers;                              ///< for points in the scan's local frame
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] local frame = raw coordinates minus this
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m] median point, local frame
};

/// How a scan was merged into S.
struct MergeRecord {
  std::size_t scan = 0;
  TcmTerms tcm;                      ///< against S, before the simplex
  RegistrationResult simplex;
  std::optional<RefinementTrace> descent;
  std::optional<RefinementTrace> annealing;
  bool accepted = false;  ///< the fit was taken: in the robust profile it stays where links lead
  std::string reason;
};

/// Two scans whose points overlap at the final poses.
struct LinkRecord {
  std::size_t a = 0, b = 0;    ///< the file of a comes first by name
  AlignmentEvidence evidence;  ///< of the direction that overlaps more
  FreeSpaceEvidence free_space;
  double probability = 0;  ///< that the pose is right, by the pair alone
  std::string verdict, reason;
  std::optional<LinkStrength> strength;  ///< in the reference's local frame; robust profile only
};

/// The last joint adjustment of a run.
struct AdjustmentRecord {
  LpFigures lp;                            ///< of the joint linear programs
  LpStatus lp_status = LpStatus::kNotRun;  ///< of the last
  std::size_t num_lp_matches = 0;          ///< of the last
  double lp_rms_move_m = 0;                ///< [m] of the scans, in the last that was solved
  int num_steps = 0;                       ///< of the least squares that follow
  double rms_move_m = 0;                   ///< [m] of the scans, in the last of them
  std::vector<std::pair<std::size_t, std::size_t>>
      outlying_pairs;  ///< fit far worse than the others, see outlying_links
};

/// A pose that a pair may have, found without a guess, and what became of it.
struct LinkHypothesisRecord {
  std::size_t a = 0, b = 0;                                 ///< the file of a comes first by name
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();  ///< for raw coordinates
  PoseCandidate candidate;                                  ///< the coarse pose it came from; local frames
  AlignmentEvidence evidence;                               ///< of the pair alone
  FreeSpaceEvidence free_space;
  double log_odds = 0;  ///< that it is right, by the pair alone
  LinkFeatures features{};  ///< what that was told from
  std::string fate;     ///< confirmed or contradicted by the final poses; open where no group has both scans
};

struct StageRecord {
  std::string name;
  double seconds = 0;
  double peak_memory_mb = 0;  ///< of the process, up to the end of the stage
};

struct PipelineResult {
  std::string method = "tcm";  ///< tcm, or the conventional method that registered the scans
  std::size_t reference = 0;
  std::vector<ScanSummary> scans;
  std::vector<ScanPose> poses;  ///< for raw coordinates, in the order of the scans
  /// Of each scan's final pose against all its neighbours; for a scan that is not registered, of its last attempt.
  /// Nothing for the reference, and in the paper profile.
  std::vector<std::optional<AlignmentEvidence>> evidence;
  std::vector<FreeSpaceEvidence> free_space;  ///< of the same poses, against the neighbours together
  /// Of each scan's last place in a component; robust profile only.
  std::vector<std::optional<ScanMeasurements>> measurements;
  std::vector<Decision> decisions;
  /// Of each scan, in raw coordinates; not looked for in the paper profile.
  std::vector<std::optional<Viewpoint>> viewpoints;
  CorrespondenceGraph graph;
  std::vector<MergeRecord> merges;
  AdjustmentRecord adjustment;   ///< of the reference's group; robust profile only
  JointUncertainty uncertainty;  ///< of the same, in the reference's local frame; no poses in the paper profile
  std::vector<LinkRecord> links;
  std::vector<LinkHypothesisRecord> hypotheses;  ///< robust profile only
  std::vector<PairFit> pairs;                    ///< of a conventional method; in local frames
  std::vector<std::size_t> pair_tree;            ///< positions of those that the poses follow
  double feature_voxel_m = 0;                    ///< [m] a conventional method computed features at; 0: none
  std::vector<StageRecord> stages;
  double coarse_voxel_m = 0;  ///< [m] resolution scans were placed with
  double fine_voxel_m = 0;    ///< [m] resolution they were adjusted with

  bool all_registered() const;
};

}  // namespace tcm_icp
