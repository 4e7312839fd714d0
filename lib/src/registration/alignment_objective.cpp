#include "tcm_icp/registration/alignment_objective.hpp"

#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr double kMinNormalCosine = 0.7;  // 45 degrees: what faces farther away is another surface

}  // namespace

AlignmentObjective::AlignmentObjective(const Cloud& source, const PyramidLevel& target, double scale_m, double gate_m)
    : source_(source), target_(target), squared_scale_m2_(scale_m * scale_m), gate_m_(gate_m) {
  if (source.empty()) throw InvalidInput("an alignment objective needs at least one source point");
  if (!source.has_normals()) throw InvalidInput("an alignment objective needs a source with normals");
  if (!(scale_m > 0)) throw InvalidOptions("scale_m must be above 0 m, not " + std::to_string(scale_m));
  if (!(gate_m > 0)) throw InvalidOptions("gate_m must be above 0 m, not " + std::to_string(gate_m));
}

template <typename Visit>
double AlignmentObjective::sum(const Eigen::Isometry3d& T_target_source, Visit visit) const {
  double total = 0;
  for (std::size_t i = 0; i < source_.size(); ++i) {
    const Eigen::Vector3d p = T_target_source * source_.points[i];
    const Neighbor q = target_.index.nearest_within(p, gate_m_);
    if (!q.found()) {
      total += 1;
      continue;
    }
    const Eigen::Vector3d n_source = T_target_source.linear() * source_.normals[i];
    const Eigen::Vector3d& n_target = target_.cloud.normals[q.index];
    const bool has_target = !n_target.isZero();
    if (has_target && !n_source.isZero() && std::abs(n_source.dot(n_target)) < kMinNormalCosine) {
      total += 1;
      continue;
    }
    const Eigen::Vector3d& normal = has_target ? n_target : n_source;
    const double r = normal.isZero() ? std::sqrt(q.squared_distance_m2) : normal.dot(p - target_.cloud.points[q.index]);
    total += r * r / (r * r + squared_scale_m2_);
    visit(p, normal, r);
  }
  return total / static_cast<double>(source_.size());
}

double AlignmentObjective::cost(const Eigen::Isometry3d& T_target_source) const {
  return sum(T_target_source, [](const Eigen::Vector3d&, const Eigen::Vector3d&, double) {});
}

double AlignmentObjective::cost_and_gradient(const Eigen::Isometry3d& T_target_source, const Eigen::Vector3d& centre,
                                             Twist& gradient) const {
  gradient.setZero();
  const double cost = sum(T_target_source, [&](const Eigen::Vector3d& p, const Eigen::Vector3d& n, double r) {
    const double denominator = r * r + squared_scale_m2_;
    const double derivative = 2 * r * squared_scale_m2_ / (denominator * denominator);  // d rho / d r
    gradient.head<3>() += derivative * (p - centre).cross(n);
    gradient.tail<3>() += derivative * n;
  });
  gradient /= static_cast<double>(source_.size());
  return cost;
}

}  // namespace tcm_icp
