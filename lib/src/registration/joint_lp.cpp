#include "tcm_icp/registration/joint_lp.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

void check_input(const std::vector<TwistFrame>& frames, std::size_t fixed, const std::vector<JointLink>& links) {
  if (fixed >= frames.size()) throw InvalidInput("joint linear program: the fixed scan is not among the scans");
  for (const auto& link : links) {
    if (link.target >= frames.size() || link.source >= frames.size() || link.target == link.source) {
      throw InvalidInput("joint linear program: link from " + std::to_string(link.source) + " to " +
                         std::to_string(link.target) + " among " + std::to_string(frames.size()) + " scans");
    }
    for (const auto& m : link.matches) {
      if (!m.source.allFinite() || !m.target.allFinite() || !m.normal.allFinite()) {
        throw InvalidInput("joint linear program: a match is not finite");
      }
    }
  }
}

// The dual: max d'y, A'y = 0, |y| <= 1. One column a match, then one a coordinate that holds it still.
class DualProgram {
 public:
  DualProgram(const std::vector<TwistFrame>& frames, std::size_t fixed) : frames_(frames), fixed_(fixed) {
    num_matches_.assign(frames.size(), 0);
  }

  void add(const JointLink& link, const Correspondence& match, double d) {
    add_coefficients(link.source, residual_gradient(match, frames_[link.source]));
    add_coefficients(link.target, -residual_gradient(match, frames_[link.target]));
    objective_.push_back(d);
    bounds_.push_back(1);
  }

  void hold(double share) {
    for (std::size_t scan = 0; scan < frames_.size(); ++scan) {
      if (scan == fixed_) continue;
      for (int k = 0; k < 6; ++k) {
        entries_.emplace_back(row_of(scan) + k, static_cast<int>(objective_.size()), 1.0);
        objective_.push_back(0);
        bounds_.push_back(share * static_cast<double>(std::max<std::size_t>(1, num_matches_[scan])));
      }
    }
  }

  LinearProgram program() const {
    LinearProgram lp;
    const auto num_columns = static_cast<Eigen::Index>(objective_.size());
    lp.equations.resize(static_cast<Eigen::Index>(6 * (frames_.size() - 1)), num_columns);
    lp.equations.setFromTriplets(entries_.begin(), entries_.end());
    lp.rhs = Eigen::VectorXd::Zero(lp.equations.rows());
    lp.objective = Eigen::VectorXd::Map(objective_.data(), num_columns);
    lp.upper = Eigen::VectorXd::Map(bounds_.data(), num_columns);
    lp.lower = -lp.upper;
    return lp;
  }

  int row_of(std::size_t scan) const { return static_cast<int>(6 * (scan < fixed_ ? scan : scan - 1)); }

 private:
  void add_coefficients(std::size_t scan, const Twist& gradient) {
    if (scan == fixed_) return;
    ++num_matches_[scan];
    for (int k = 0; k < 6; ++k) {
      entries_.emplace_back(row_of(scan) + k, static_cast<int>(objective_.size()), gradient[k]);
    }
  }

  const std::vector<TwistFrame>& frames_;
  std::size_t fixed_;
  std::vector<std::size_t> num_matches_;  // of each scan
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> objective_, bounds_;
};

void solve_scaled(const std::vector<TwistFrame>& frames, std::size_t fixed, const std::vector<JointLink>& links,
                  double scale_m, const JointLpOptions& options, JointLpResult& result) {
  DualProgram dual(frames, fixed);
  Rng rng = make_stream(options.seed, "joint program tie breaking");
  for (const auto& link : links) {
    for (const auto& match : link.matches) {
      const double noise = options.tie_breaking * (2 * uniform01(rng) - 1);
      dual.add(link, match, -residual_m(match) / scale_m + noise);
    }
  }
  dual.hold(options.hold);
  const LpSolution solution = solve(dual.program(), options.lp);
  result.status = solution.status;
  result.duality_gap = solution.duality_gap;
  result.pivots = solution.pivots;
  if (!solution.optimal()) return;
  for (std::size_t scan = 0; scan < frames.size(); ++scan) {
    if (scan != fixed) result.steps_m[scan] = scale_m * solution.row_duals.segment<6>(dual.row_of(scan));
  }
}

void fill_residuals(const std::vector<TwistFrame>& frames, const std::vector<JointLink>& links, JointLpResult& result) {
  result.objective_m = 0;
  for (const auto& link : links) {
    std::vector<double> residuals;
    for (const auto& match : link.matches) {
      const double moved = residual_m(match) +
                           residual_gradient(match, frames[link.source]).dot(result.steps_m[link.source]) -
                           residual_gradient(match, frames[link.target]).dot(result.steps_m[link.target]);
      residuals.push_back(std::abs(moved));
      result.objective_m += residuals.back();
    }
    result.link_medians_m.push_back(residuals.empty() ? std::numeric_limits<double>::quiet_NaN() : median(residuals));
  }
}

}  // namespace

void JointLpOptions::validate() const {
  lp.validate();
  if (!(tie_breaking >= 0) || !(tie_breaking < 1)) {
    throw InvalidOptions("JointLpOptions: tie_breaking is " + std::to_string(tie_breaking) + ", must be in [0, 1)");
  }
  if (!(hold > 0) || !(hold < 1)) {
    throw InvalidOptions("JointLpOptions: hold is " + std::to_string(hold) + ", must be in (0, 1)");
  }
}

JointLpResult solve_joint_lp(const std::vector<TwistFrame>& frames, std::size_t fixed,
                             const std::vector<JointLink>& links, const JointLpOptions& options) {
  options.validate();
  check_input(frames, fixed, links);
  const auto start = std::chrono::steady_clock::now();
  JointLpResult result;
  result.steps_m.assign(frames.size(), Twist::Zero());
  const std::vector<double> before = absolute_residuals_m(links);
  result.num_matches = before.size();
  result.initial_objective_m = 0;
  for (const double residual : before) result.initial_objective_m += residual;
  const double scale_m = median_nonzero(before);
  if (scale_m > 0) {
    solve_scaled(frames, fixed, links, scale_m, options, result);
  } else {
    result.status = LpStatus::kOptimal;  // nothing to match, or an exact fit
    result.duality_gap = 0;
  }
  fill_residuals(frames, links, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::vector<std::size_t> outlying_links(const std::vector<double>& link_medians_m, double noise_m) {
  constexpr std::size_t kFewest = 4;
  constexpr double kMads = 3;
  std::vector<double> medians;
  std::copy_if(link_medians_m.begin(), link_medians_m.end(), std::back_inserter(medians),
               [](double value) { return std::isfinite(value); });
  if (medians.size() < kFewest) return {};
  const double middle = median(medians);
  for (double& value : medians) value = std::abs(value - middle);
  const double limit = std::max(noise_m, middle + kMads * kMadToSigma * median(medians));
  std::vector<std::size_t> outlying;
  for (std::size_t k = 0; k < link_medians_m.size(); ++k) {
    if (link_medians_m[k] > limit) outlying.push_back(k);
  }
  return outlying;
}

}  // namespace tcm_icp
