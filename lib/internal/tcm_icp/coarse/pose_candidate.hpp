#pragma once
// A pose two scans may have, before anything verified it.

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

namespace tcm_icp {

/// kSlide: a pose of one of the first two, moved along a corridor or a street. kGuess: the user's initial poses.
/// kImplied: by the links of other pairs.
enum class CoarseMethod { kFeatures, kHeightMap, kSlide, kGuess, kImplied };

/// "features", "height map", "slide", "initial pose" or "other links".
std::string_view to_string(CoarseMethod method);

struct PoseCandidate {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  CoarseMethod method = CoarseMethod::kFeatures;
  double score = 0;   ///< larger is better; comparable within a method and a set
  double margin = 0;  ///< score by the best score of a clearly different pose of the same pair and method; 1 is a tie
  /// Asked there alone: a fit from about there has led to another pose that is one with it, a wall's other face
  /// perhaps.
  bool there = false;
  double accuracy_m = 0;  ///< what points are off at most where it is right, by how it was searched; 0: not known
};

/// That of the first, the best of a search; 0 of none.
inline double best_score(const std::vector<PoseCandidate>& found) { return found.empty() ? 0 : found.front().score; }

}  // namespace tcm_icp
