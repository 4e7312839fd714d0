#pragma once
// Every option of a registration, with its default; stages nest their own structs.

#include <cstddef>
#include <string>

#include "tcm_icp/decision/scan_decision.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"
#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "tcm_icp/tcm/robust_tcm.hpp"

namespace tcm_icp {

enum class Profile {
  kRobust,  ///< the paper's steps with statistics in place of minima, gates, verification
  kPaper,   ///< the paper to the letter
};

/// kAuto: none in the robust profile, where the joint adjustment leaves nothing to refine (docs/results.md); descent, then
/// annealing in the paper's.
enum class Refinement { kAuto, kNone, kDescent, kAnnealing, kDescentThenAnnealing };

/// Which of the scans that may be merged is merged next.
enum class MergeOrder {
  kTcm,        ///< least tau, as the profile measures it
  kPaperTcm,   ///< least tau by the paper's equations
  kRobustTcm,  ///< least tau by quantiles
  kOverlap,    ///< largest overlap with what is merged
  kFile,       ///< as the files stand
  kRandom,     ///< drawn with the seed
};

/// How many points stand for a scan. Lengths follow from these numbers and the data.
struct SamplingOptions {
  std::size_t max_working_points = 262'144;  ///< >= 1000; of a scan, while it streams by
  std::size_t coarse_voxels = 30'000;   ///< >= 100; voxels of a typical scan at the resolution scans are placed with
  std::size_t fine_voxels = 100'000;    ///< >= coarse_voxels; and at the one they are adjusted with
  double max_surface_variation = 0.06;  ///< 0..1/3; rougher places (leaves, wires) do not count as surfaces
  void validate() const;                ///< throws InvalidOptions
};

/// Placing one scan against what is merged.
struct PlacementOptions {
  LpFormulation formulation = LpFormulation::kPointToPlane;  ///< of every step of the robust profile
  int coarse_points = 1500;                                  ///< >= 100; points of a scan in its coarse linear programs
  int fine_points = 3000;                                    ///< >= 100; and in the finer ones
  int held_out_points = 1500;                                ///< >= 100; points kept from every fit, for verification
  int adjustment_lp_steps = 2;  ///< >= 0; linear programs over all poses at once, at the fine resolution
  int adjustment_steps = 10;    ///< >= 0; Gauss-Newton steps over all poses at once, after the programs
  void validate() const;        ///< throws InvalidOptions
};

/// Refinement after the simplex. Lengths are in units of the noise found by the fit.
struct RefinementOptions {
  Refinement method = Refinement::kAuto;
  int points = 160;                   ///< >= 20; points the cost is taken over, and as many held out
  int descent_steps = 8;              ///< >= 1
  int annealing_steps = 100;          ///< >= 0
  double initial_temperature = 0.02;  ///< > 0; in units of the cost at the start
  double final_temperature = 0.0005;  ///< > 0
  void validate() const;              ///< throws InvalidOptions
};

/// Inference over all hypotheses of a set.
struct InferenceOptions {
  /// Logarithm of how many clearly different poses a pair has that a wrong hypothesis may be taken by: what agreement by
  /// chance is worth. Far fewer than fit into the search's space, since wrong hypotheses, too, lay walls on walls.
  double log_poses = 3;
  double most_log_odds = 8;     ///< > 0; of one hypothesis: no pair is surer
  int max_starts = 24;          ///< >= 1; strongest hypotheses that configurations are grown from
  int max_sweeps = 10;          ///< >= 1; of moves of single scans and of groups
};

struct PipelineOptions {
  Profile profile = Profile::kRobust;
  std::string reference;  ///< file of the reference scan; empty: chosen by the correspondence graph
  MergeOrder merge_order = MergeOrder::kTcm;
  double graph_threshold = 0;  ///< >= 0; measure below which scans are connected; 0: from the data
  /// Scans were levelled: z points up in each (kMaxLevelTilt_deg). Links that tilt one against another are not tried.
  bool level = false;
  SamplingOptions sampling;
  OutlierOptions outliers;
  RobustTcmOptions tcm;
  L1FitOptions lp;
  PlacementOptions placement;
  RefinementOptions refinement;
  InferenceOptions inference;
  DecisionOptions decision;
  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

}  // namespace tcm_icp
