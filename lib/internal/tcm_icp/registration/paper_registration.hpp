#pragma once
// The paper's simplex registration: 12 free entries of R and T, least slack, then the nearest rotation.

#include <limits>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/paper_options.hpp"
#include "tcm_icp/registration/registration_result.hpp"

namespace tcm_icp {

struct PaperRegistrationOptions {
  PaperOptions reading;
  double threshold_m = std::numeric_limits<double>::infinity();  ///< >= 0; of PaperMatches::kThreshold
  double convergence_share = 1e-4;  ///< > 0; a step that moves the points less than this share of their radius (rms),
                                    ///< or a mean slack that falls by less than this share, is the last
  L1FitOptions lp;
  void validate() const;  ///< throws InvalidOptions
};

/// Points and their counterparts, one by one [m].
struct PaperMatchedPoints {
  Points source, target;          ///< in their own frames
  std::vector<double> distances;  ///< between them under the pose they were matched at
};

/// Matches source points with target points under a pose, as the reading says. Cost O(N log M), twice that where they
/// must be mutual.
/// @param source_index  of the source's points; asked where matches must be mutual
PaperMatchedPoints paper_matches(const Points& source, const NeighborIndex& source_index, const Points& target,
                                 const NeighborIndex& target_index, const Eigen::Isometry3d& T_target_source,
                                 const PaperRegistrationOptions& options);

/// P' = R P + T in the 12 entries of R and T, for matched points: min sum |P' - (R P + T)|_1 over points and axes, by
/// linear programming; R is then projected onto SO(3) and T taken anew as the componentwise median of P' - R P. The
/// three rows of (R, T) share no unknown, so the program of 12 unknowns is three of 4: the same optimum, found faster.
/// @param source, target  N matched points each, N >= 1 [m]
/// @param slack  kAbove and kBelow: T is the least that leaves no point on the wrong side
Termination paper_simplex_step(const Points& source, const Points& target, const L1FitOptions& options,
                               Eigen::Isometry3d& T_target_source, LpFigures& figures,
                               PaperSlack slack = PaperSlack::kBoth);

/// Rounds of paper_matches and paper_simplex_step, until one of them is the last.
RegistrationResult register_paper(const Points& source, const Points& target, const NeighborIndex& target_index,
                                  const Eigen::Isometry3d& T_init, const PaperRegistrationOptions& options);

}  // namespace tcm_icp
