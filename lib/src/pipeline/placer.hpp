#pragma once
// Fits of one scan to the merged cloud: the linear programs, other poses nearby, refinement.

#include <Eigen/Geometry>
#include <functional>
#include <span>

#include "prepared_scan.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "verdict.hpp"

namespace tcm_icp {

/// One pose that programs came to, and what speaks for it.
struct PlacementCandidate {
  RegistrationResult fit;
  AlignmentEvidence evidence;
  Verdict verdict;
  bool found = false;
};

/// What free space says of a pose, against the scans that are merged already; may be empty.
using FreeSpaceCheck = std::function<FreeSpaceEvidence(const Eigen::Isometry3d& T_reference_scan)>;

bool better(const PlacementCandidate& a, const PlacementCandidate& b);

/// Holds references: scan, merged cloud, options and check must outlive it.
class Placer {
 public:
  Placer(const PreparedScan& scan, const ScanPyramid& merged, const PipelineOptions& options,
         const FreeSpaceCheck& free_space);

  const LpFigures& figures() const { return figures_; }  ///< of all programs so far

  AlignmentEvidence verify(const Eigen::Isometry3d& T) const;

  /// Free space is asked last: it costs more than the rest.
  Verdict judge_at(const Eigen::Isometry3d& T, const AlignmentEvidence& evidence) const;

  /// The best of a ladder of first gates [coarse voxels] from T_init; the first that passes ends it.
  PlacementCandidate fit_from(const Eigen::Isometry3d& T_init, std::span<const double> gates);

  /// Fits from the best shifts of the initial guess, too, with the first gate given.
  void try_shifts(const Eigen::Isometry3d& T_init, double gate_in_voxels, PlacementCandidate& best);

  /// Looks for other poses that fit as well; the one with the largest consensus wins. Repeated structure (bays of a
  /// hall, rows of trees) shows here and nowhere else: each of its fits looks right by itself. A pose that free space
  /// vetoes does not win, but counts as another: of a mirrored scan, say, one pose may violate nothing.
  void explore(PlacementCandidate& best);

  /// Descent and annealing, as the options ask for.
  void refine(PlacementCandidate& candidate, Rng& rng, MergeRecord& record) const;

 private:
  PlacementCandidate fit_and_verify(const Eigen::Isometry3d& T_init, double gate_in_voxels);
  PlacementCandidate look_at(const Eigen::Isometry3d& T_init, const PlacementCandidate& best);
  RegistrationResult fit_coarse(const Cloud& points, const Eigen::Isometry3d& T_init, double gate_m, int max_programs);
  RegistrationResult fit_fine(const Cloud& surfaces, const RegistrationResult& before, int max_programs);
  LpRegistrationOptions lp_options(double initial_gate_m, double final_gate_m, int max_programs) const;
  FreeSpaceEvidence free_space_of(const PlacementCandidate& candidate) const;
  bool same_pose(const PlacementCandidate& a, const PlacementCandidate& b) const;

  const PreparedScan& scan_;
  const ScanPyramid& merged_;
  const PipelineOptions& options_;
  const FreeSpaceCheck& free_space_;
  double voxel_m_;
  Cloud coarse_look_, fine_look_;  // what a look elsewhere is fitted with
  LpFigures figures_;
};

}  // namespace tcm_icp
