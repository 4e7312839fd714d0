#pragma once
// Every option of a registration, with its default; stages nest their own structs.

#include <string>

#include "tcm_icp/adjustment/adjustment_options.hpp"
#include "tcm_icp/decision/scan_decision.hpp"
#include "tcm_icp/inference/inference_options.hpp"
#include "tcm_icp/merging/merge_options.hpp"
#include "tcm_icp/outliers/outlier_removal.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"
#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/lp_registration.hpp"
#include "tcm_icp/registration/paper_options.hpp"
#include "tcm_icp/scans/sampling_options.hpp"
#include "tcm_icp/tcm/robust_tcm.hpp"

namespace tcm_icp {

/// A stage of the robust pipeline that is left out, to measure what it is worth.
enum class LeftOut {
  kNothing,
  kFeatures,      ///< the second search for pairs' poses; partners are still ranked by them in large sets
  kSlides,        ///< the third, along corridors
  kImpliedPoses,  ///< pairs asked where other pairs put them
  kFreeSpace,     ///< what scans saw through, and which side of a surface
  kTwins,         ///< parts held against a place that looks like the right one to all pairs
  kSetConstant,   ///< log-odds corrected by what the set's own poses teach
};

struct PipelineOptions {
  Profile profile = Profile::kRobust;
  std::string reference;  ///< file or number of the reference scan; empty: chosen by the graph
  MergeOrder merge_order = MergeOrder::kTcm;
  LeftOut without = LeftOut::kNothing;
  double graph_threshold = 0;  ///< >= 0; measure below which scans are connected; 0: from the data
  /// Scans were levelled: z points up in each (kMaxLevelTilt_deg). Links that tilt one against another are not tried.
  bool level = false;
  SamplingOptions sampling;
  OutlierOptions outliers;
  RobustTcmOptions tcm;
  L1FitOptions lp;
  SampleSizes samples;
  LpFormulation formulation = LpFormulation::kPointToPlane;  ///< of every linear program of the robust profile
  AdjustmentOptions adjustment;
  RefinementOptions refinement;
  PaperOptions paper;  ///< readings of the paper's profile
  InferenceOptions inference;
  DecisionOptions decision;
  void validate() const;  ///< throws InvalidOptions naming field, value and bound

  MergeOptions merging() const;  ///< kAuto resolved by the profile
};

}  // namespace tcm_icp
