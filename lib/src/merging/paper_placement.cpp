#include <algorithm>
#include <cmath>

#include "merging/fit_to_cloud.hpp"
#include "tcm_icp/registration/paper_registration.hpp"
#include "tcm_icp/tcm/tcm.hpp"

namespace tcm_icp {
namespace {

// A marginal change: a hundredth of a voxel, far below any structure.
constexpr double kMarginalStep = 0.01;

}  // namespace

Eigen::Isometry3d place_scan_as_printed(const PreparedScan& scan, const ScanPyramid& s, const Eigen::Isometry3d& T_init,
                                        const MergeOptions& options, Rng& rng, MergeRecord& record) {
  const PyramidLevel& target = s.level(0);
  PaperRegistrationOptions paper;
  paper.lp = options.lp;
  record.simplex = register_paper(scan.coarse_sample.points, target.cloud.points, target.index, T_init, paper);
  Eigen::Isometry3d T = record.simplex.T_target_source;
  record.accepted = record.simplex.usable();
  record.reason = record.accepted ? "placed by the simplex; this profile does not verify"
                                  : "the simplex step failed: " + std::string(to_string(record.simplex.termination));
  if (!record.accepted) return T;

  const TcmCloud fixed(target.cloud.points), moving(scan.pyramid.level(0).cloud.points),
      kept(scan.held_out_sample.points);
  const TcmEvaluator tau(fixed, moving), held_out_tau(fixed, kept);
  const TwistFrame frame = twist_frame(scan.pyramid.level(0).cloud.points, T);
  const double step_m = kMarginalStep * target.voxel_size_m;
  const RefinementOptions& o = options.refinement;
  if (o.method == Refinement::kDescent || o.method == Refinement::kDescentThenAnnealing) {
    record.descent = descend(tau, {}, held_out_tau, frame, T, descent_options(o, step_m, step_m / 16));
    T = record.descent->T_target_source;
  }
  if (o.method == Refinement::kAnnealing || o.method == Refinement::kDescentThenAnnealing) {
    record.annealing = anneal(tau, held_out_tau, frame, T, annealing_options(o, step_m, step_m / 16), rng);
    T = record.annealing->T_target_source;
  }
  return T;
}

}  // namespace tcm_icp
