#pragma once
// Lines 4 to 9 of Algorithm 1: scans joined to S one by one, in the order of the TCM, each placed and verified.

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "merged_cloud.hpp"
#include "pose_graph.hpp"
#include "prepared_scan.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/tcm/merge_order.hpp"
#include "tcm_icp/tcm/robust_tcm.hpp"

namespace tcm_icp {

/// What merging starts from; all poses for local frames.
struct MergeInput {
  const std::vector<PreparedScan>& scans;
  const std::vector<std::string>& files;
  /// Initial guesses in any common frame, nothing where there is none. The paper profile takes every scan as it lies.
  const std::vector<std::optional<Eigen::Isometry3d>>& T_init;
  const PoseGraph& graph;
  const PipelineOptions& options;
  const RunContext& context;
};

/// A set of scans growing around its reference. A scan whose check fails is set aside, and tried again when a new
/// neighbour of it was merged, or with a guess when anything was.
class Merging {
 public:
  Merging(const MergeInput& input, std::size_t reference, std::vector<bool> wanted);

  /// Merges what can be merged; may be called again when the graph has got more links.
  void run(std::vector<MergeRecord>& records);

  std::size_t reference() const { return reference_; }
  const std::vector<bool>& placed() const { return placed_; }
  std::vector<bool> unplaced() const;  ///< of the wanted
  const std::vector<Eigen::Isometry3d>& T_reference_scan() const { return T_reference_scan_; }

 private:
  struct Choice {
    std::size_t scan;
    std::vector<StartPose> starts;
    bool by_guess;
  };
  enum class Source { kStrongLinks, kLinks, kGuesses };

  std::vector<Choice> choices(Source source);
  bool may_guess(std::size_t scan) const;
  std::size_t choose_next(const std::vector<Choice>& choices, const std::vector<MergeCandidate>& candidates);
  void compute_tcm(const std::vector<Choice>& choices, std::vector<MergeCandidate>& candidates);
  void merge(const Choice& choice, const TcmTerms& terms, std::vector<MergeRecord>& records);
  FreeSpaceEvidence free_space_at(std::size_t scan, const Eigen::Isometry3d& T) const;
  void ask_links(const Choice& choice, const Eigen::Isometry3d& T, MergeRecord& record);
  Eigen::Isometry3d guess(std::size_t scan) const;
  double same_m() const { return kSameLinkPose * target_.level(0).voxel_size_m; }

  MergeInput in_;
  std::size_t reference_;
  std::vector<bool> wanted_;
  std::vector<bool> placed_;
  std::vector<Eigen::Isometry3d> T_reference_scan_;
  std::vector<std::size_t> tried_with_;        ///< hypotheses that a scan had at its last attempt by links
  std::vector<std::size_t> tried_guess_with_;  ///< size of S at its last attempt from its guess
  std::vector<int> attempts_;
  std::size_t num_merged_ = 1;
  std::size_t num_choices_ = 0;  ///< made at random
  MergedCloud merged_;
  ScanPyramid target_;
  std::vector<std::optional<RobustTcmCloud>> tcm_clouds_;  ///< of the scans, once they are asked for
  std::optional<RobustTcmCloud> merged_tcm_cloud_;         ///< of S as it is; none where it has grown since
};

}  // namespace tcm_icp
