#pragma once
// Everything a run found out, for the files and the report.

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/adjustment/adjustment_record.hpp"
#include "tcm_icp/baselines/pair_fit.hpp"
#include "tcm_icp/decision/scan_decision.hpp"
#include "tcm_icp/graph/correspondence_graph.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/links/link_record.hpp"
#include "tcm_icp/merging/merge_record.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"
#include "tcm_icp/registration/pose_covariance.hpp"
#include "tcm_icp/survey/survey_record.hpp"
#include "tcm_icp/visibility/free_space.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// What is known of a scan before it is placed.
struct ScanSummary {
  std::string file;
  std::string unit = "m";                            ///< of the coordinates in the file; all lengths here are metres
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

struct StageRecord {
  std::string name;
  double seconds = 0;
  double peak_memory_mb = 0;  ///< of the process, up to the end of the stage
};

struct PipelineResult {
  std::string method = "tcm";  ///< tcm, or the conventional method that registered the scans
  std::size_t reference = 0;
  std::vector<ScanSummary> scans;
  std::vector<std::string> warnings;  ///< of scans in another unit than the others, as it seems
  std::vector<ScanPose> poses;        ///< for raw coordinates, in the order of the scans
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
  JointUncertainty uncertainty;  ///< of the same, in the local frame; no poses in the paper profile
  SurveyRecord survey;           ///< robust profile only
  std::vector<LinkRecord> links;
  std::vector<LinkHypothesisRecord> hypotheses;  ///< robust profile only
  std::vector<PairFit> pairs;                    ///< of a conventional method; in local frames
  std::vector<std::size_t> pair_tree;            ///< positions of those that the poses follow
  double feature_voxel_m = 0;                    ///< [m] a conventional method computed features at; 0: none
  std::vector<StageRecord> stages;
  double coarse_voxel_m = 0;  ///< [m] resolution scans were placed with
  double fine_voxel_m = 0;    ///< [m] resolution they were adjusted with
  double set_log_odds = 0;    ///< constant in the log-odds of all hypotheses and links, learnt from the poses
  /// In its place, of hypotheses for scans that the first search left; and a factor that theirs have before.
  double later_log_odds = 0, later_factor = 1;

  bool all_registered() const;
  /// [m] The local frame, in which uncertainties and strengths are, is the common one minus this.
  Eigen::Vector3d local_origin() const { return survey.has_frame ? survey.origin : scans[reference].origin; }
  /// [m] The same of the frame that a scan is in, its group's where that is not the common one. Cost O(scans).
  Eigen::Vector3d local_origin(std::size_t scan) const;
  /// Whether a scan holds together with others, but not with the reference.
  bool has_frame_of_its_own(std::size_t scan) const {
    return poses[scan].status == ScanStatus::kUnregistered && poses[scan].pose_in_component;
  }
};

}  // namespace tcm_icp
