#pragma once
// The paper's simplex registration: 12 free entries of R and T, least slack, then the nearest rotation.

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/registration/l1_fit.hpp"
#include "tcm_icp/registration/registration_result.hpp"

namespace tcm_icp {

struct PaperRegistrationOptions {
  int max_iterations = 30;          ///< >= 1
  double convergence_share = 1e-4;  ///< stop when a step moves the points less than this share of their radius (rms)
  L1FitOptions lp;
  void validate() const;  ///< throws InvalidOptions
};

/// P' = R P + T in the 12 entries of R and T, for matched points: min sum |P' - (R P + T)|_1 over points and axes, by
/// linear programming; R is then projected onto SO(3) and T taken anew as the componentwise median of P' - R P. The
/// three rows of (R, T) share no unknown, so the program of 12 unknowns is three of 4: the same optimum, found faster.
/// @param source, target  N matched points each, N >= 1 [m]
Termination paper_simplex_step(const Points& source, const Points& target, const L1FitOptions& options,
                               Eigen::Isometry3d& T_target_source, LpFigures& figures);

/// Nearest neighbours in the whole target (the paper has no gate), paper_simplex_step, and again until nothing moves.
RegistrationResult register_paper(const Points& source, const Points& target, const NeighborIndex& target_index,
                                  const Eigen::Isometry3d& T_init, const PaperRegistrationOptions& options);

}  // namespace tcm_icp
