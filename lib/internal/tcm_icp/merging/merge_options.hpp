#pragma once
// How scans are merged into S.

#include "tcm_icp/registration/lp_registration.hpp"
#include "tcm_icp/registration/paper_options.hpp"
#include "tcm_icp/tcm/robust_tcm.hpp"

namespace tcm_icp {

/// kAuto: none in the robust profile, where the joint adjustment leaves nothing to refine (docs/results.md); descent,
/// then annealing in the paper's.
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

struct MergeOptions {
  MergeOrder order = MergeOrder::kTcm;
  bool paper_tcm = false;  ///< kTcm means the paper's equations
  bool fits = true;        ///< false: scans stay where inference put them, from where the joint adjustment starts
  RobustTcmOptions tcm;
  LpFormulation formulation = LpFormulation::kPointToPlane;  ///< of the robust profile's linear programs
  L1FitOptions lp;
  RefinementOptions refinement;
  PaperOptions paper;
  double correspondence_threshold_m = 0;  ///< of the graph, for PaperMatches::kThreshold
};

}  // namespace tcm_icp
