#pragma once
// How far estimated poses are from the truth.

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/evaluation/truth.hpp"

namespace tcm_icp {

struct PoseError {
  double rotation_deg = 0;
  double rmse_m = 0;         ///< [m] root mean square of how far the scan's points are from where they belong
  double translation_m = 0;  ///< [m] how far the origin of the scan's file is: where that lies away from the points,
                             ///< the rotation's lever arm is in it

  bool within(const Tolerance& tolerance) const {
    return rotation_deg <= tolerance.rotation_deg && rmse_m <= tolerance.rmse_m;
  }
};

/// Error of scan i against scan `ref`: E = (T_ref^-1 T_i)^-1 T_est_ref^-1 T_est_i, which does not depend on the frames
/// the two sets of poses are given in.
/// @param points  of scan i, in its own frame; rmse_m is NaN where there are none
PoseError pose_error(const Eigen::Isometry3d& T_true_ref, const Eigen::Isometry3d& T_true_i,
                     const Eigen::Isometry3d& T_est_ref, const Eigen::Isometry3d& T_est_i, const Points& points);

enum class PoseVerdict {
  kOk,       ///< within tolerance; or left unregistered and rightly so, being of another group than the reference
  kFlagged,  ///< left unregistered though it belongs to the reference's group
  kWrong,    ///< said to be registered, and is not within tolerance (or is of another group): the worst outcome
};
std::string to_string(PoseVerdict verdict);  ///< "ok", "flagged", "WRONG"

struct ScanScore {
  std::string file;
  std::optional<PoseError> error;  ///< none where there is no pose or no truth to compare with
  PoseVerdict verdict = PoseVerdict::kWrong;
};

/// Two scans against one another, whatever the reference is.
struct PairScore {
  std::size_t a = 0, b = 0;        ///< indices, a < b
  double overlap = 0;              ///< true one, the larger of its two directions; NaN where the truth does not say
  std::optional<PoseError> error;  ///< of b seen from a; none where one of them has no pose
  bool is_ok = false;
};

struct SceneScore {
  std::vector<ScanScore> scans;     ///< in the order of the truth
  std::size_t reference = 0;        ///< index of the reference scan
  std::vector<PairScore> pairs;     ///< those of the reference's group that truly overlap by min_overlap or more
  std::size_t num_pairs = 0;        ///< pairs.size()
  std::size_t num_pairs_ok = 0;     ///< of them, those whose relative pose is within tolerance
  std::optional<PoseError> median;  ///< over the scans with an error but the reference; none where there are none
  std::optional<double> max_rmse_m;

  std::size_t count(PoseVerdict verdict) const;

  /// Registration recall: share of the pairs whose relative pose is within the truth's tolerance; NaN where there are
  /// no pairs.
  double recall() const;
};

struct ScoreOptions {
  double min_overlap = 0.1;  ///< 0..1, from which a pair counts for pair recall
  void validate() const;     ///< throws InvalidOptions
};

/// @param estimates  T_any_scan in the order of the truth; none where a scan was left unregistered
/// @param reference  index of the scan the errors are taken against; it must have an estimate
/// @param points     of each scan, in its own frame
/// @throws InvalidInput    if the lengths differ or the reference has no estimate
/// @throws InvalidOptions
SceneScore score_poses(const Truth& truth, const std::vector<std::optional<Eigen::Isometry3d>>& estimates,
                       std::size_t reference, const std::vector<Points>& points, const ScoreOptions& options);

}  // namespace tcm_icp
