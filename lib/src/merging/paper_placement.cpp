#include <algorithm>
#include <cmath>

#include "merging/fit_to_cloud.hpp"
#include "tcm_icp/registration/paper_registration.hpp"
#include "tcm_icp/tcm/tcm.hpp"

namespace tcm_icp {
namespace {

// Several points may have one counterpart; tau takes it for one point.
Points distinct(Points points) {
  const auto before = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// What tau is taken over: the clouds, or what of them has a counterpart.
struct TauClouds {
  Points fixed, moving;
};

TauClouds tau_clouds(const Points& moving, const Points& target, const NeighborIndex& target_index,
                     const Eigen::Isometry3d& T, const PaperRegistrationOptions& paper) {
  if (paper.reading.descent == PaperDescent::kWholeScans) return {target, moving};
  PaperMatchedPoints matches = paper_matches(moving, NeighborIndex(moving), target, target_index, T, paper);
  return {distinct(std::move(matches.target)), std::move(matches.source)};
}

}  // namespace

Eigen::Isometry3d place_scan_as_printed(const PreparedScan& scan, const ScanPyramid& s, const Eigen::Isometry3d& T_init,
                                        const MergeOptions& options, Rng& rng, MergeRecord& record) {
  const Points& target = s.level(0).cloud.points;
  const NeighborIndex target_index(target);
  const Points& all = scan.pyramid.level(0).cloud.points;
  const Points& points = options.paper.points == PaperPoints::kAll ? all : scan.coarse_sample.points;
  PaperRegistrationOptions paper;
  paper.reading = options.paper;
  paper.threshold_m = options.correspondence_threshold_m;
  paper.lp = options.lp;
  record.simplex = register_paper(points, target, target_index, T_init, paper);
  Eigen::Isometry3d T = record.simplex.T_target_source;
  record.accepted = record.simplex.usable();
  record.reason = record.accepted ? "placed by the simplex; this profile does not verify"
                                  : "the simplex step failed: " + std::string(to_string(record.simplex.termination));
  if (!record.accepted || options.refinement.method == Refinement::kNone) return T;

  const TauClouds clouds = tau_clouds(all, target, target_index, T, paper);
  const TauClouds held_out = tau_clouds(scan.held_out_sample.points, target, target_index, T, paper);
  if (std::min({clouds.fixed.size(), clouds.moving.size(), held_out.fixed.size(), held_out.moving.size()}) < 2)
    return T;
  const TcmCloud fixed(clouds.fixed), moving(clouds.moving), kept_fixed(held_out.fixed), kept(held_out.moving);
  const TcmEvaluator tau(fixed, moving), held_out_tau(kept_fixed, kept);
  const TwistFrame frame = twist_frame(all, T);
  const double step_m = options.paper.marginal_share * s.level(0).voxel_size_m;
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
