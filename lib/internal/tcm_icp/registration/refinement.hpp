#pragma once
// Refinement of a pose: descent over all sign combinations of marginal steps, and simulated annealing.

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {

/// What is minimised: any measure of a pose, smaller is better. For the paper it is tau, for the robust profile an
/// AlignmentObjective.
using PoseCost = std::function<double(const Eigen::Isometry3d& T_target_source)>;
/// Its derivative by a twist about the frame's centre; returns the cost.
using PoseGradient = std::function<double(const Eigen::Isometry3d& T_target_source, Twist& gradient)>;

/// Twists are applied about `centre` (the moved source's centroid); a rotation is measured by how far it moves a point
/// at `radius_m`, so one length serves all six parameters.
struct TwistFrame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 1;

  /// T moved by a step whose six entries are lengths [m].
  Eigen::Isometry3d moved(const Eigen::Isometry3d& T_target_source, const Twist& step_m) const;
};

/// The frame of a cloud under a pose: its centroid and RMS radius.
/// @throws InvalidInput  if there are no points
TwistFrame twist_frame(const Points& points, const Eigen::Isometry3d& T_target_source);

struct DescentOptions {
  double initial_step_m = 0;  ///< [m] > 0; the first marginal increase and decrease
  double min_step_m = 0;      ///< [m] > 0, <= initial_step_m; the descent ends when its step falls below
  double step_shrink = 0.5;   ///< 0 < shrink < 1; where no combination improves
  int max_steps = 40;         ///< >= 1
  void validate() const;      ///< throws InvalidOptions
};

struct AnnealingOptions {
  double initial_step_m = 0;          ///< [m] > 0; rms size of the first proposals
  double final_step_m = 0;            ///< [m] > 0, <= initial_step_m; and of the last
  double initial_temperature = 0.02;  ///< > 0; in units of the cost at the start
  double final_temperature = 0.0005;  ///< > 0, <= initial_temperature; cooling is geometric in between
  int num_steps = 100;                ///< >= 0
  void validate() const;              ///< throws InvalidOptions
};

struct RefinementTrace {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  int num_steps = 0;     ///< steps tried
  int num_accepted = 0;  ///< steps taken
  double initial_cost = 0;
  double final_cost = 0;
  double initial_held_out_cost = 0;  ///< on points the fit did not see; equal to the cost where none were held out
  double final_held_out_cost = 0;
  bool kept = false;  ///< the refined pose replaced the one given
};

/// Descent of the paper: every combination of a marginal increase and decrease of the six twist parameters (2^6) is
/// tried, the best taken; where none improves the step shrinks. With a gradient, one more candidate is the step of the
/// same size down the slope. The result is kept only if the held-out cost does not rise. Cost: 64 evaluations a step.
RefinementTrace descend(const PoseCost& cost, const PoseGradient& gradient, const PoseCost& held_out_cost,
                        const TwistFrame& frame, const Eigen::Isometry3d& T_init, const DescentOptions& options);

/// Simulated annealing over the twist (Kirkpatrick et al., 1983): Gaussian proposals whose size and temperature fall
/// geometrically, Metropolis acceptance on `cost`. The best pose met is kept only if it improves `held_out_cost`, that
/// is, points the walk never saw. Cost: one evaluation a step.
RefinementTrace anneal(const PoseCost& cost, const PoseCost& held_out_cost, const TwistFrame& frame,
                       const Eigen::Isometry3d& T_init, const AnnealingOptions& options, Rng& rng);

}  // namespace tcm_icp
