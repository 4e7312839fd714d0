#include "tcm_icp/registration/verification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/decompositions.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/registration/refinement.hpp"

namespace tcm_icp {
namespace {

constexpr double kCrossing = 2;  // tolerances: what agreed within one does not any more

using Information = Eigen::Matrix<double, 6, 6>;

struct Tally {
  std::size_t overlapping = 0;
  std::size_t agreeing = 0;
  std::vector<double> residuals_m;
  Information information = Information::Zero();
};

// `frame` gives the centre and radius of the information matrix; without it only the counts are taken.
Tally take_tally(const Cloud& points, const PyramidLevel& target, const Eigen::Isometry3d& T,
                 const VerificationOptions& options, const TwistFrame* frame) {
  const double min_cosine = std::cos(options.max_normal_angle_deg * std::numbers::pi / 180);
  Tally tally;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = T * points.points[i];
    const Neighbor q = target.index.nearest_within(p, options.gate_m);
    if (!q.found()) continue;
    ++tally.overlapping;
    const Eigen::Vector3d& n_target = target.cloud.normals[q.index];
    const Eigen::Vector3d n_source = T.linear() * points.normals[i];
    const Eigen::Vector3d& normal = n_target.isZero() ? n_source : n_target;
    const double residual = normal.dot(p - target.cloud.points[q.index]);
    if (frame != nullptr) {
      tally.residuals_m.push_back(std::abs(residual));
      Twist row;
      row << (p - frame->centre).cross(normal) / frame->radius_m, normal;
      tally.information += row * row.transpose();
    }
    // A target without a normal is no surface: nothing there can agree.
    if (!n_target.isZero() && std::abs(residual) <= options.tolerance_m &&
        std::abs(n_source.dot(n_target)) >= min_cosine) {
      ++tally.agreeing;
    }
  }
  return tally;
}

// Those which a step takes off their surfaces, by `least_m` and more.
Cloud crossed_by(const Cloud& points, const TwistFrame& frame, const Eigen::Isometry3d& T, const Twist& step_m,
                 double least_m) {
  Cloud out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d n = T.linear() * points.normals[i];
    Twist row;
    row << (T * points.points[i] - frame.centre).cross(n) / frame.radius_m, n;
    if (std::abs(row.dot(step_m)) < least_m) continue;
    out.points.push_back(points.points[i]);
    out.normals.push_back(points.normals[i]);
  }
  return out;
}

}  // namespace

void VerificationOptions::validate() const {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0)) throw InvalidOptions(std::string(name) + " must be above 0 m, not " + std::to_string(value));
  };
  positive(gate_m, "gate_m");
  positive(tolerance_m, "tolerance_m");
  positive(slide_m, "slide_m");
  if (!(max_normal_angle_deg > 0 && max_normal_angle_deg <= 90)) {
    throw InvalidOptions("max_normal_angle_deg must be above 0 and at most 90 degrees, not " +
                         std::to_string(max_normal_angle_deg));
  }
}

AlignmentEvidence verify_alignment(const Cloud& held_out, const PyramidLevel& target,
                                   const Eigen::Isometry3d& T_target_source, const VerificationOptions& options) {
  options.validate();
  if (!held_out.empty() && !held_out.has_normals()) throw InvalidInput("verify_alignment needs points with normals");
  AlignmentEvidence evidence;
  evidence.num_points = held_out.size();
  evidence.tolerance_m = options.tolerance_m;
  evidence.slide_m = options.slide_m;
  evidence.left_after_slide.fill(1);
  if (held_out.size() < 2) return evidence;
  const TwistFrame frame = twist_frame(held_out.points, T_target_source);
  Tally tally = take_tally(held_out, target, T_target_source, options, &frame);
  evidence.overlap = static_cast<double>(tally.overlapping) / static_cast<double>(held_out.size());
  if (tally.agreeing == 0) return evidence;
  evidence.inlier_share = static_cast<double>(tally.agreeing) / static_cast<double>(tally.overlapping);
  evidence.median_residual_m = median(tally.residuals_m);
  if (!options.with_slides) return evidence;

  const SymmetricEigen<6> axes = symmetric_eigen6(tally.information);
  const auto left_of = [&](const Cloud& points, std::size_t agreeing, const Twist& step) {
    double left = 0;
    for (const double sign : {-1.0, 1.0}) {
      const Tally slid = take_tally(points, target, frame.moved(T_target_source, sign * step), options, nullptr);
      left = std::max(left, static_cast<double>(slid.agreeing) / static_cast<double>(agreeing));
    }
    return left;
  };
  const auto slide = [&](int k) -> Twist { return options.slide_m * axes.vectors.col(k); };
  int weakest = 0;
  double most_left = -1;
  for (int k = 0; k < 6; ++k) {
    const double left = left_of(held_out, tally.agreeing, slide(k));
    evidence.left_after_slide[static_cast<std::size_t>(k)] = left;
    if (left > most_left) most_left = left, weakest = k;
  }
  const Cloud across = crossed_by(held_out, frame, T_target_source, slide(weakest), kCrossing * options.tolerance_m);
  evidence.num_across = take_tally(across, target, T_target_source, options, nullptr).agreeing;
  if (evidence.num_across > 0) evidence.left_across = left_of(across, evidence.num_across, slide(weakest));
  std::sort(evidence.left_after_slide.rbegin(), evidence.left_after_slide.rend());
  return evidence;
}

}  // namespace tcm_icp
