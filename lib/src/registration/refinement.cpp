#include "tcm_icp/registration/refinement.hpp"

#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

void require(bool ok, const char* rule, double value) {
  if (!ok) throw InvalidOptions(std::string(rule) + ", not " + std::to_string(value));
}

constexpr int kNumCombinations = 64;  // 2^6 signs

// Entry k of combination c: plus or minus the step.
Twist signed_step(int combination, double step_m) {
  Twist step;
  for (int k = 0; k < 6; ++k) step[k] = (combination >> k & 1) != 0 ? step_m : -step_m;
  return step;
}

}  // namespace

Eigen::Isometry3d TwistFrame::moved(const Eigen::Isometry3d& T_target_source, const Twist& step_m) const {
  Twist twist = step_m;
  twist.head<3>() /= radius_m;
  Eigen::Isometry3d T = isometry_about(centre, twist) * T_target_source;
  T.linear() = project_onto_so3(T.linear());  // rounding of many products adds up
  return T;
}

TwistFrame twist_frame(const Points& points, const Eigen::Isometry3d& T_target_source) {
  if (points.empty()) throw InvalidInput("a twist frame needs at least one point");
  const auto n = static_cast<double>(points.size());
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const auto& p : points) centroid += p;
  centroid /= n;
  double squared = 0;
  for (const auto& p : points) squared += (p - centroid).squaredNorm();
  // Points all in one place leave rotations without effect: any radius does, but zero.
  const double radius_m = squared > 0 ? std::sqrt(squared / n) : 1;
  return {T_target_source * centroid, radius_m};
}

void DescentOptions::validate() const {
  require(initial_step_m > 0, "descent initial_step_m must be above 0 m", initial_step_m);
  require(min_step_m > 0 && min_step_m <= initial_step_m,
          "descent min_step_m must be above 0 m and at most initial_step_m", min_step_m);
  require(step_shrink > 0 && step_shrink < 1, "descent step_shrink must be between 0 and 1", step_shrink);
  require(max_steps >= 1, "descent max_steps must be at least 1", max_steps);
}

void AnnealingOptions::validate() const {
  require(initial_step_m > 0, "annealing initial_step_m must be above 0 m", initial_step_m);
  require(final_step_m > 0 && final_step_m <= initial_step_m,
          "annealing final_step_m must be above 0 m and at most initial_step_m", final_step_m);
  require(initial_temperature > 0, "annealing initial_temperature must be above 0", initial_temperature);
  require(final_temperature > 0 && final_temperature <= initial_temperature,
          "annealing final_temperature must be above 0 and at most initial_temperature", final_temperature);
  require(num_steps >= 0, "annealing num_steps must be at least 0", num_steps);
}

RefinementTrace descend(const PoseCost& cost, const PoseGradient& gradient, const PoseCost& held_out_cost,
                        const TwistFrame& frame, const Eigen::Isometry3d& T_init, const DescentOptions& options) {
  options.validate();
  RefinementTrace trace;
  trace.initial_cost = cost(T_init);
  trace.initial_held_out_cost = held_out_cost(T_init);
  Eigen::Isometry3d best = T_init;
  double best_cost = trace.initial_cost;
  double step_m = options.initial_step_m;
  while (trace.num_steps < options.max_steps && step_m >= options.min_step_m) {
    ++trace.num_steps;
    Eigen::Isometry3d next = best;
    double next_cost = best_cost;
    const auto consider = [&](const Twist& step) {
      const Eigen::Isometry3d candidate = frame.moved(best, step);
      const double c = cost(candidate);
      if (c < next_cost) {
        next_cost = c;
        next = candidate;
      }
    };
    for (int combination = 0; combination < kNumCombinations; ++combination) {
      consider(signed_step(combination, step_m));
    }
    if (gradient) {
      Twist slope;
      gradient(best, slope);
      slope.head<3>() /= frame.radius_m;  // by metres moved at the radius
      if (slope.norm() > 0) consider(-step_m / slope.norm() * slope);
    }
    if (next_cost < best_cost) {
      best = next;
      best_cost = next_cost;
      ++trace.num_accepted;
    } else {
      step_m *= options.step_shrink;
    }
  }
  trace.final_cost = best_cost;
  trace.final_held_out_cost = held_out_cost(best);
  trace.kept = best_cost < trace.initial_cost && trace.final_held_out_cost <= trace.initial_held_out_cost;
  trace.T_target_source = trace.kept ? best : T_init;
  return trace;
}

RefinementTrace anneal(const PoseCost& cost, const PoseCost& held_out_cost, const TwistFrame& frame,
                       const Eigen::Isometry3d& T_init, const AnnealingOptions& options, Rng& rng) {
  options.validate();
  RefinementTrace trace;
  trace.initial_cost = cost(T_init);
  trace.initial_held_out_cost = held_out_cost(T_init);
  Eigen::Isometry3d current = T_init, best = T_init;
  double current_cost = trace.initial_cost, best_cost = trace.initial_cost;
  for (int i = 0; i < options.num_steps; ++i) {
    const double share = options.num_steps > 1 ? static_cast<double>(i) / (options.num_steps - 1) : 0;
    const double step_m = options.initial_step_m * std::pow(options.final_step_m / options.initial_step_m, share);
    const double temperature = trace.initial_cost * options.initial_temperature *
                               std::pow(options.final_temperature / options.initial_temperature, share);
    Twist step;
    for (int k = 0; k < 6; ++k) step[k] = step_m * standard_normal(rng);
    const Eigen::Isometry3d candidate = frame.moved(current, step);
    const double candidate_cost = cost(candidate);
    ++trace.num_steps;
    const double threshold = uniform01(rng);  // drawn always, so that one comparison does not shift the stream
    if (candidate_cost < current_cost ||
        (temperature > 0 && threshold < std::exp((current_cost - candidate_cost) / temperature))) {
      current = candidate;
      current_cost = candidate_cost;
      ++trace.num_accepted;
    }
    if (current_cost < best_cost) {
      best = current;
      best_cost = current_cost;
    }
  }
  trace.final_cost = best_cost;
  trace.final_held_out_cost = held_out_cost(best);
  trace.kept = best_cost < trace.initial_cost && trace.final_held_out_cost < trace.initial_held_out_cost;
  trace.T_target_source = trace.kept ? best : T_init;
  return trace;
}

}  // namespace tcm_icp
