#pragma once
// Poses of a pair of scans by local features, with no initial guess: any rotation, any translation.

#include <cstddef>
#include <vector>

#include "tcm_icp/coarse/pose_candidate.hpp"
#include "tcm_icp/coarse/scan_features.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

struct FeatureAlignmentOptions {
  FeatureOptions features;
  std::vector<std::size_t> levels = {2, 1};   ///< of the pyramid; not empty
  double tolerance_voxels = 2;                ///< > 0; how far matched points may be apart, in voxels of their level
  double min_length_voxels = 4;               ///< >= 0; matches nearer to one another do not support each other
  double max_normal_cosine_difference = 0.2;  ///< > 0; of the angle between two points' normals in both scans
  int max_hypotheses = 12;                    ///< >= 1; poses a level's matches are searched for
  int max_candidates = 5;                     ///< >= 1; poses returned
  int check_points = 300;                     ///< >= 1; points of each scan a pose is checked with
  void validate() const;                      ///< throws InvalidOptions
};

/// What the alignment needs to know of a scan.
struct DescribedScan {
  std::vector<ScanFeatures> levels;  ///< in the order of the options' levels
  Cloud check_sample;                ///< of all directions of normals
};

/// @throws InvalidOptions  also where a level is not in the pyramid
DescribedScan describe_scan(const ScanPyramid& pyramid, const FeatureAlignmentOptions& options, Rng& rng);

/// A scan with its features; both must outlive the call.
struct FeatureView {
  const ScanPyramid& pyramid;
  const DescribedScan& described;
};

/// Clearly different poses that many matches of any level agree on, best first; empty where there is none. The score is
/// the number of matches that hold, of all levels, each counted by how well it does, times the root of the share of
/// sampled points that meet the other scan with agreeing normals and distances. The same bits for any number of
/// threads.
///
/// @param target, source  described with these options
/// Cost: some ten milliseconds. Thread-safe.
std::vector<PoseCandidate> align_by_features(const FeatureView& target, const FeatureView& source,
                                             const FeatureAlignmentOptions& options);

}  // namespace tcm_icp
