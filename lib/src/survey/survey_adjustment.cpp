#include "survey/survey_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/cross_matrix.hpp"
#include "core/decompositions.hpp"
#include "core/figure_text.hpp"
#include "survey/survey_equations.hpp"
#include "survey/survey_start.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

constexpr double kMostRotation_rad = 0.2;  // beyond it a rotation is not one small step from the start any more
constexpr double kLeastChecked = 1e-4;     // of a direction's weight: less is rounding
constexpr int kMaxSteps = 30;

/// One adjustment with some of the points and poses.
struct Fit {
  SurveyEquations equations;
  Eigen::Isometry3d T_survey_local;
  Eigen::MatrixXd Z;  ///< 6 x unknowns of the frame that are determined
  Matrix6 frame_covariance = Matrix6::Zero();
  Eigen::MatrixXd P;  ///< weight of the residuals: S^-1 less what the frame's unknowns take up
  Eigen::MatrixXd S_inverse;
  Eigen::VectorXd u;  ///< P y
  double chi_squared = 0;

  int num_rotations() const { return static_cast<int>(Z.cols()) - 3; }
  int degrees_of_freedom() const { return static_cast<int>(equations.num_rows() - Z.cols()); }
};

/// Columns: rotations that are determined better than 0.2 rad, and all translations.
Eigen::MatrixXd determined_directions(const Matrix6& normal, double radius_m) {
  const Eigen::Matrix3d by_translation = normal.bottomRightCorner<3, 3>();
  const Eigen::Matrix3d rotation =
      normal.topLeftCorner<3, 3>() -
      normal.topRightCorner<3, 3>() * by_translation.ldlt().solve(normal.bottomLeftCorner<3, 3>());
  const SymmetricEigen<3> axes = symmetric_eigen3((rotation + rotation.transpose()) / 2);
  std::vector<Eigen::Vector3d> kept;
  for (int k = 0; k < 3; ++k) {
    const double least = 1 / std::pow(kMostRotation_rad * radius_m, 2);
    if (axes.values[k] > least) kept.push_back(axes.vectors.col(k));
  }
  const auto count = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(6, count + 3);
  for (Eigen::Index k = 0; k < count; ++k) Z.block<3, 1>(0, k) = kept[static_cast<std::size_t>(k)];
  Z.bottomRightCorner<3, 3>().setIdentity();
  return Z;
}

Fit fit(const ScanNetwork& network, const TwistFrame& frame, const SurveyObservations& observations,
        const UsedObservations& used) {
  Eigen::Isometry3d T = start_of_survey(network, observations, used);
  for (int step = 0;; ++step) {
    SurveyEquations equations(network, frame, observations, used, T);
    const Eigen::MatrixXd SA = equations.S.solve(equations.A);
    const Matrix6 normal = equations.A.transpose() * SA;
    const Eigen::MatrixXd Z = determined_directions((normal + normal.transpose()) / 2, frame.radius_m);
    const Eigen::MatrixXd inside = (Z.transpose() * normal * Z).inverse();
    const Twist g = Z * (inside * (Z.transpose() * (SA.transpose() * equations.y)));
    const bool settled = g.norm() < 1e-10 * frame.radius_m;
    if (!settled && step < kMaxSteps) {
      T = TwistFrame{T * frame.centre, frame.radius_m}.moved(T, g);
      continue;
    }
    const Eigen::Index rows = equations.num_rows();
    Fit out{std::move(equations), T, Z, {}, {}, {}, {}, 0};
    out.frame_covariance = Z * inside * Z.transpose();
    out.S_inverse = out.equations.S.solve(Eigen::MatrixXd::Identity(rows, rows));
    out.P = out.S_inverse - SA * out.frame_covariance * SA.transpose();
    out.u = out.P * out.equations.y;
    out.chi_squared = out.equations.y.dot(out.u);
    return out;
  }
}

/// What the others say of an error that N rows may share, in the directions in which they check it.
template <int N>
struct Contradiction {
  Eigen::Matrix<double, N, 1> error = Eigen::Matrix<double, N, 1>::Zero();
  double test = 0;  ///< chi squared
  int directions = 0;
};

/// @param weight, most  of the error: by what the others check of it, and if they were exact
/// @param pull          on it, by the residuals
template <int N>
Contradiction<N> contradiction(const Eigen::Matrix<double, N, N>& weight, const Eigen::Matrix<double, N, N>& most,
                               const Eigen::Matrix<double, N, 1>& pull) {
  const SymmetricEigen<Eigen::Dynamic> axes =
      generalized_eigen((weight + weight.transpose()) / 2, (most + most.transpose()) / 2);
  Contradiction<N> out;
  for (int k = 0; k < N; ++k) {
    const double checked = axes.values[k];
    if (!(checked > kLeastChecked)) continue;
    const double pull_along = axes.vectors.col(k).dot(pull);
    out.test += pull_along * pull_along / checked;
    out.error += pull_along / checked * axes.vectors.col(k);
    ++out.directions;
  }
  return out;
}

/// That one point, or all of one name, are off by the same three numbers; or that a pose is, by six.
struct Suspicion {
  std::vector<std::size_t> points;
  std::optional<std::size_t> pose;  ///< in place of points
  double test = 0;                  ///< chi squared
  int directions = 0;
  double off_m = 0;  ///< by what the others say
  double excess() const { return directions > 0 ? test / chi_squared_limit(directions) : 0; }
};

Suspicion suspect_points(const Fit& fit, std::vector<std::size_t> points) {
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero(), most = Eigen::Matrix3d::Zero();
  for (const std::size_t a : points) {
    const Eigen::Index row = fit.equations.row_of[a];
    pull += fit.u.segment<3>(row);
    for (const std::size_t b : points) {
      weight += fit.P.block<3, 3>(row, fit.equations.row_of[b]);
      most += fit.S_inverse.block<3, 3>(row, fit.equations.row_of[b]);
    }
  }
  const Contradiction<3> found = contradiction<3>(weight, most, pull);
  return {std::move(points), std::nullopt, found.test, found.directions, found.error.norm()};
}

Suspicion suspect_pose(const Fit& fit, std::size_t pose) {
  const Eigen::Index row = fit.equations.row_of_pose[pose];
  const Contradiction<6> found =
      contradiction<6>(fit.P.block<6, 6>(row, row), fit.S_inverse.block<6, 6>(row, row), fit.u.segment<6>(row));
  return {{}, pose, found.test, found.directions, found.error.norm()};
}

/// The one that exceeds its limit most first.
std::vector<Suspicion> suspicions(const Fit& fit, const SurveyObservations& observations,
                                  const UsedObservations& used) {
  const auto& points = observations.points;
  std::vector<Suspicion> out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!used.points[k]) continue;
    out.push_back(suspect_points(fit, {k}));
    std::vector<std::size_t> same;
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (used.points[j] && points[j].name == points[k].name) same.push_back(j);
    }
    if (same.size() > 1 && same.front() == k) out.push_back(suspect_points(fit, same));
  }
  for (std::size_t k = 0; k < observations.poses.size(); ++k) {
    if (used.poses[k] && !observations.poses[k].is_fixed) out.push_back(suspect_pose(fit, k));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Suspicion& a, const Suspicion& b) { return a.excess() > b.excess(); });
  return out;
}

class SurveyAdjustment {
 public:
  SurveyAdjustment(const ScanNetwork& network, const SurveyObservations& observations)
      : network_(network), whole_(frame_of_network(network)), in_(observations) {
    for (const auto& point : in_.points) used_.points.push_back(!point.is_check);
    used_.poses.assign(in_.poses.size(), true);
  }

  SurveySolution run() {
    Fit best = fit(network_, whole_, in_, used_);
    while (leave_worst_out(best)) {
    }
    fill_in(best);
    remark(best);
    return std::move(out_);
  }

 private:
  /// Given places and poses, of all that may leave or of those that did not.
  std::size_t num_given(bool of_used) const {
    std::set<std::string> names;
    for (std::size_t k = 0; k < in_.points.size(); ++k) {
      if (!in_.points[k].is_check && (!of_used || used_.points[k])) names.insert(in_.points[k].name);
    }
    std::size_t out = names.size();
    for (std::size_t k = 0; k < in_.poses.size(); ++k) {
      if (!in_.poses[k].is_fixed && (!of_used || used_.poses[k])) ++out;
    }
    return out;
  }

  bool has_fixed_pose() const {
    return std::any_of(in_.poses.begin(), in_.poses.end(), [](const PoseObservation& p) { return p.is_fixed; });
  }

  /// False where none is left that may leave.
  bool leave_worst_out(Fit& best) {
    const std::vector<Suspicion> worst = suspicions(best, in_, used_);
    for (const Suspicion& s : worst) {
      if (s.excess() <= 1) return false;
      UsedObservations without = used_;
      for (const std::size_t k : s.points) without.points[k] = false;
      if (s.pose) without.poses[*s.pose] = false;
      const UsedObservations before = std::exchange(used_, without);
      // Who is wrong, the minority or the rest, cannot be told from half of them on.
      const bool is_minority = 2 * (num_given(false) - num_given(true)) < num_given(false);
      if (is_minority && (num_given(true) > 0 || has_fixed_pose())) {
        Fit rest = fit(network_, whole_, in_, used_);
        if (rest.num_rotations() >= best.num_rotations()) {
          remark_on_others(best, s, worst);
          best = std::move(rest);
          return true;
        }
      }
      used_ = before;
    }
    return false;
  }

  std::string name_of(const Suspicion& s) const {
    return s.pose ? "the initial pose of " + in_.poses[*s.pose].name : in_.points[s.points.front()].name;
  }

  void remark_on_others(const Fit& fit, const Suspicion& chosen, const std::vector<Suspicion>& all) {
    const std::string name = name_of(chosen);
    for (const Suspicion& s : all) {
      const std::string other = name_of(s);
      if (other == name || s.excess() <= 1) continue;
      if (fit.chi_squared - s.test > chi_squared_limit(fit.degrees_of_freedom() - s.directions)) continue;
      say(name + " was left out as a blunder, but without " + other +
          " instead the others would agree as well: measure both again");
      return;
    }
  }

  Eigen::Matrix<double, 6, 6> pose_covariance(const Fit& f, std::size_t scan) const {
    const auto at = static_cast<Eigen::Index>(6 * scan);
    const Eigen::Matrix3d turn = f.T_survey_local.linear();
    const Eigen::MatrixXd BC = f.equations.BC.middleCols<6>(at);
    const Eigen::MatrixXd gain = (f.S_inverse * BC).transpose();  // 6 x rows
    const Matrix6 by_frame = gain * f.equations.A, Q = f.frame_covariance;
    const Matrix6 step = network_.covariance_m2.block<6, 6>(at, at) - gain * BC + by_frame * Q * by_frame.transpose();
    Matrix6 of_frame = Matrix6::Zero(), of_step = Matrix6::Zero();
    const Eigen::Vector3d arm = turn * (network_.frames[scan].centre - whole_.centre);
    of_frame.topLeftCorner<3, 3>().diagonal().setConstant(1 / whole_.radius_m);
    of_frame.bottomLeftCorner<3, 3>() = -cross_matrix(arm) / whole_.radius_m;
    of_frame.bottomRightCorner<3, 3>().setIdentity();
    of_step.topLeftCorner<3, 3>() = turn / network_.frames[scan].radius_m;
    of_step.bottomRightCorner<3, 3>() = turn;
    const Matrix6 both = of_frame * (-Q * by_frame.transpose()) * of_step.transpose();
    const Matrix6 sum =
        of_frame * Q * of_frame.transpose() + of_step * step * of_step.transpose() + both + both.transpose();
    return (sum + sum.transpose()) / 2;
  }

  void fill_in(const Fit& f) {
    out_.T_survey_local = f.T_survey_local;
    out_.num_rotations = f.num_rotations();
    out_.degrees_of_freedom = f.degrees_of_freedom();
    out_.chi_squared = f.chi_squared;
    const Eigen::VectorXd steps = f.equations.BC.transpose() * (f.S_inverse * f.equations.y);
    for (std::size_t i = 0; i < network_.frames.size(); ++i) {
      const Twist step = steps.segment<6>(static_cast<Eigen::Index>(6 * i));
      out_.largest_change_m = std::max(out_.largest_change_m, step.norm());
      out_.T_survey_scan.push_back(f.T_survey_local * network_.frames[i].moved(network_.T_local_scan[i], step));
      out_.covariance.push_back(pose_covariance(f, i));
    }
    const Eigen::MatrixXd residual_covariance = f.equations.R * f.P * f.equations.R;
    for (std::size_t k = 0; k < in_.points.size(); ++k) {
      out_.points.push_back(predicted(f, in_.points[k]));
      SurveyPoint& point = out_.points.back();
      point.is_used = used_.points[k];
      point.is_blunder = !used_.points[k] && !in_.points[k].is_check;
      if (!point.is_used) continue;
      const Eigen::Index row = f.equations.row_of[k];
      point.sigma_m = residual_covariance.block<3, 3>(row, row).diagonal().cwiseMax(0).cwiseSqrt();
      point.redundancy = (f.equations.R.block<3, 3>(row, row) * f.P.block<3, 3>(row, row)).trace();
      const Suspicion own = suspect_points(f, {k});
      point.test = own.directions > 0 ? std::optional(own.test) : std::nullopt;
    }
  }

  /// As of a point that had no part in the adjustment.
  SurveyPoint predicted(const Fit& f, const PointObservation& p) const {
    const bool in_scan = p.scan != kNoScan;
    const Eigen::Isometry3d T = in_scan ? out_.T_survey_scan[p.scan] : f.T_survey_local;
    Matrix6 pose = f.frame_covariance;
    Eigen::Vector3d centre = f.T_survey_local * whole_.centre;
    if (in_scan) {
      pose = out_.covariance[p.scan];
      centre = f.T_survey_local * network_.frames[p.scan].centre;
    } else {
      const Eigen::Matrix<double, 6, 1> units =
          (Eigen::Matrix<double, 6, 1>() << Eigen::Vector3d::Constant(1 / whole_.radius_m), Eigen::Vector3d::Ones())
              .finished();
      pose = units.asDiagonal() * pose * units.asDiagonal();
    }
    Eigen::Matrix<double, 3, 6> motion;
    motion << -cross_matrix(T * p.measured - centre), Eigen::Matrix3d::Identity();
    Eigen::Matrix3d covariance = motion * pose * motion.transpose() +
                                 T.linear() * p.sigma_measured_m.cwiseAbs2().asDiagonal() * T.linear().transpose();
    covariance.diagonal() += p.sigma_given_m.cwiseAbs2();
    SurveyPoint out;
    out.residual_m = T * p.measured - p.given;
    out.sigma_m = covariance.diagonal().cwiseSqrt();
    out.test = out.residual_m.dot(covariance.ldlt().solve(out.residual_m));
    return out;
  }

  void say(const std::string& remark) { out_.remarks.push_back(remark); }

  /// Rms over the scan's points between its known pose and where it is now.
  double distance_m(const Fit& f, const PoseObservation& known) const {
    const TwistFrame& frame = network_.frames[known.scan];
    const Eigen::Vector3d centre = f.T_survey_local * frame.centre;
    const Eigen::Isometry3d off = known.T_survey_scan * out_.T_survey_scan[known.scan].inverse();
    return std::hypot((off * centre - centre).norm(), frame.radius_m * rotation_angle_rad(off.linear()));
  }

  void remark_on_pose(const Fit& f, std::size_t pose) {
    const std::string name = "the initial pose of " + in_.poses[pose].name;
    if (!used_.poses[pose]) {
      say(name + " contradicts links and other observations and was left out: these put it " +
          figure(distance_m(f, in_.poses[pose])) + " m from there");
    } else if (const Suspicion s = suspect_pose(f, pose); s.excess() > 1) {
      say(name + " contradicts links and other observations: these put it " + figure(s.off_m) + " m from there");
    }
  }

  void remark(const Fit& f) {
    if (f.num_rotations() == 0) {
      say("the observations determine no rotation of the frame: its axes are those of the reference scan");
    } else if (f.num_rotations() < 3) {
      say("the observations determine " + std::to_string(f.num_rotations()) +
          " of three rotations of the frame, about the other axes it turns as little as can be; at least three points "
          "that are not on one line are needed, or scans that are level");
    }
    for (std::size_t k = 0; k < in_.poses.size(); ++k) remark_on_pose(f, k);
    if (f.degrees_of_freedom() == 0) {
      say("nothing is redundant: no observation is checked by the others");
    } else if (f.chi_squared > chi_squared_limit(f.degrees_of_freedom())) {
      say("what was used contradicts itself more than its standard deviations allow (variance factor " +
          figure(f.chi_squared / f.degrees_of_freedom()) +
          "): they are too small, or blunders are left that cannot be told");
    }
  }

  const ScanNetwork& network_;
  const TwistFrame whole_;  ///< of all scans, in the local frame
  const SurveyObservations& in_;
  UsedObservations used_;
  SurveySolution out_;
};

}  // namespace

SurveySolution adjust_to_survey(const ScanNetwork& network, const SurveyObservations& observations) {
  return SurveyAdjustment(network, observations).run();
}

}  // namespace tcm_icp
