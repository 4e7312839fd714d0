#include "pipeline/survey_frame.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "adjustment/uncertainty.hpp"
#include "core/figure_text.hpp"
#include "pipeline/measured_scan.hpp"
#include "pipeline/scan_set.hpp"
#include "survey/survey_adjustment.hpp"

namespace tcm_icp {
namespace {

// Of scans that --fix keeps: tight beside any other figure, and loose enough for doubles.
constexpr double kFixedSigma_m = 1e-5;

bool is_fixed(const PipelineInput& in, std::size_t scan) {
  const auto& fixed = in.survey.fixed;
  return std::find(fixed.begin(), fixed.end(), in.files[scan]) != fixed.end();
}

const PosePrior* prior_of(const PipelineInput& in, std::size_t scan) {
  const auto& priors = in.survey.priors;
  const auto at =
      std::find_if(priors.begin(), priors.end(), [&](const PosePrior& prior) { return prior.scan == in.files[scan]; });
  return at == priors.end() ? nullptr : &*at;
}

double level_of(const PipelineInput& in, std::size_t scan) {
  double sigma_rad = in.survey.sigma_level_rad;
  for (const ScanLevel& level : in.survey.levels) {
    if (level.scan == in.files[scan]) sigma_rad = level.sigma_rad;
  }
  return sigma_rad;
}

/// Rms distance of its points from their middle.
double radius_m(const PreparedScan& scan) { return std::sqrt(scan.moments.covariance.trace()); }

/// Of a scan that is fixed or has a weighted initial pose.
std::optional<SurveyedScan::Pose> known_pose(const PipelineInput& in, std::size_t i, const PreparedScan& scan,
                                             const InitialPoses& T_init) {
  if (is_fixed(in, i)) {
    const double sigma_rad = radius_m(scan) > 0 ? kFixedSigma_m / radius_m(scan) : kFixedSigma_m;
    return SurveyedScan::Pose{*T_init[i], kFixedSigma_m, sigma_rad};
  }
  const PosePrior* const prior = prior_of(in, i);
  if (prior == nullptr) return std::nullopt;
  return SurveyedScan::Pose{*T_init[i], prior->sigma_position_m, prior->sigma_rotation_rad};
}

/// Scans that share a local frame.
struct Members {
  std::vector<std::size_t> scans;
  std::size_t reference = 0;
  const SettledComponent* settled = nullptr;  ///< nullptr: one scan by itself
};

class SurveyFrame {
 public:
  SurveyFrame(const PipelineInput& input, const std::vector<PreparedScan>& scans, const Resolutions& resolutions,
              PipelineResult& result)
      : in_(input), scans_(scans), resolutions_(resolutions), result_(result), record_(result.survey) {
    T_init_ = initial_local_poses(in_.initial_poses, in_.sampled, false);
    record_.crs = in_.survey.crs;
    record_.origin = choose_origin();
    for (const auto& point : in_.survey.points) record_.points.push_back({point});
    out_.T_survey_scan.resize(in_.files.size());
    out_.is_confirmed.assign(in_.files.size(), false);
    out_.sigma_in_voxels.resize(in_.files.size());
  }

  SurveyPlacement run(const std::vector<SettledComponent>& settled) {
    std::vector<bool> left(in_.files.size(), true);
    for (const SettledComponent& component : settled) {
      const Members members{component.component.members(), component.component.reference, &component};
      for (const std::size_t i : members.scans) left[i] = false;
      if (&component == &settled.front()) {
        if (!place_first(members)) return {};
      } else {
        place(members);
      }
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left[i]) place({{i}, i, nullptr});
    }
    warn();
    return std::move(out_);
  }

 private:
  Eigen::Vector3d choose_origin() const {
    for (const auto& point : in_.survey.points) {
      if (point.use == PointUse::kControl) return point.given.array().round();
    }
    for (std::size_t i = 0; i < in_.files.size(); ++i) {
      if (is_fixed(in_, i) || prior_of(in_, i) != nullptr)
        return (*T_init_[i] * scans_[i].moments.mean).array().round();
    }
    return Eigen::Vector3d::Zero();
  }

  // The frame is that of these scans, whatever their observations determine.
  bool place_first(const Members& members) {
    const SurveyObservations observed = observations(members, true);
    if (!defines_frame(observed)) {
      record_.remarks.emplace_back(
          "no control point, position or fixed scan is among the scans of the largest component: "
          "the frame is that of the reference scan");
      warn();
      return false;
    }
    record_.has_frame = true;
    const ScanNetwork network = network_of(members);
    const SurveySolution solution = adjust_to_survey(network, observed);
    record_.num_rotations = solution.num_rotations;
    record_.degrees_of_freedom = solution.degrees_of_freedom;
    if (solution.degrees_of_freedom > 0) record_.variance_factor = solution.chi_squared / solution.degrees_of_freedom;
    record_.largest_change_m = solution.largest_change_m;
    record_.remarks.insert(record_.remarks.end(), solution.remarks.begin(), solution.remarks.end());
    describe(observed);
    take(members, network, solution);
    return true;
  }

  void place(const Members& members) {
    const SurveyObservations observed = observations(members, false);
    if (!defines_frame(observed)) return;
    const ScanNetwork network = network_of(members);
    const SurveySolution solution = adjust_to_survey(network, observed);
    if (solution.is_determined()) take(members, network, solution);
  }

  static bool defines_frame(const SurveyObservations& observed) {
    return !observed.poses.empty() || std::any_of(observed.points.begin(), observed.points.end(),
                                                  [](const PointObservation& p) { return !p.is_check; });
  }

  std::optional<std::size_t> position_of(const std::string& file, const Members& members) const {
    for (std::size_t k = 0; k < members.scans.size(); ++k) {
      if (in_.files[members.scans[k]] == file) return k;
    }
    return std::nullopt;
  }

  SurveyObservations observations(const Members& members, bool is_first) {
    SurveyObservations out;
    source_.clear();
    for (std::size_t k = 0; k < in_.survey.points.size(); ++k) {
      const ControlPoint& p = in_.survey.points[k];
      PointObservation o{p.name,
                         kNoScan,
                         p.measured,
                         p.given - record_.origin,
                         p.sigma_given_m,
                         p.sigma_measured_m,
                         p.use == PointUse::kCheck};
      std::size_t scan = members.reference;
      if (p.scan.empty()) {
        if (!is_first) continue;
      } else {
        const auto at = position_of(p.scan, members);
        if (!at) continue;
        o.scan = *at;
        scan = members.scans[*at];
      }
      o.measured -= in_.sampled[scan].scan.origin;
      out.points.push_back(std::move(o));
      source_.push_back(k);
    }
    for (std::size_t k = 0; k < members.scans.size(); ++k) {
      const std::size_t i = members.scans[k];
      if (const auto known = known_pose(in_, i, scans_[i], T_init_)) {
        out.poses.push_back({in_.files[i], k, Eigen::Translation3d(-record_.origin) * known->T_survey_scan,
                             known->sigma_rotation_rad, known->sigma_position_m, is_fixed(in_, i)});
      }
      if (const double sigma_rad = level_of(in_, i); sigma_rad > 0) out.levels.push_back({k, sigma_rad});
    }
    return out;
  }

  ScanNetwork network_of(const Members& members) {
    const auto count = static_cast<Eigen::Index>(members.scans.size());
    std::vector<Eigen::Isometry3d> T(scans_.size(), Eigen::Isometry3d::Identity());
    ScanNetwork out;
    for (const std::size_t i : members.scans) {
      if (members.settled != nullptr) T[i] = *members.settled->component.T_reference_scan[i];
      out.T_local_scan.push_back(T[i]);
    }
    const std::vector<TwistFrame> frames = scan_frames(scans_, T);
    for (const std::size_t i : members.scans) out.frames.push_back(frames[i]);
    out.covariance_m2 = Eigen::MatrixXd::Zero(6 * count, 6 * count);
    if (members.settled == nullptr) return out;
    const Eigen::MatrixXd all =
        joint_covariance(scans_, members.settled->pairs, members.reference, resolutions_, T, in_.context.num_threads);
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b < count; ++b) {
        const std::size_t i = members.scans[static_cast<std::size_t>(a)],
                          j = members.scans[static_cast<std::size_t>(b)];
        out.covariance_m2.block<6, 6>(6 * a, 6 * b) =
            all.block<6, 6>(static_cast<Eigen::Index>(6 * i), static_cast<Eigen::Index>(6 * j));
      }
    }
    if (!out.covariance_m2.allFinite()) {
      out.covariance_m2.setZero();
      record_.remarks.emplace_back(
          "too few points match to say how exact the scans' places among each other are: they "
          "were kept as they are");
    }
    return out;
  }

  void describe(const SurveyObservations& observed) {
    bool by_points = false, by_scanners = false;
    for (std::size_t k = 0; k < observed.points.size(); ++k) {
      if (observed.points[k].is_check) continue;
      (in_.survey.points[source_[k]].is_scanner ? by_scanners : by_points) = true;
    }
    const auto add = [&](bool is_there, const char* what) {
      if (is_there) record_.defined_by += (record_.defined_by.empty() ? "" : " and ") + std::string(what);
    };
    add(by_points, "control points");
    add(by_scanners, "positions of scanners");
    const bool by_fixed =
        std::any_of(observed.poses.begin(), observed.poses.end(), [](const PoseObservation& p) { return p.is_fixed; });
    const bool by_priors =
        std::any_of(observed.poses.begin(), observed.poses.end(), [](const PoseObservation& p) { return !p.is_fixed; });
    add(by_fixed, "fixed scans");
    add(by_priors, "initial poses");
  }

  void take(const Members& members, const ScanNetwork& network, const SurveySolution& solution) {
    auto& uncertainty = result_.uncertainty.poses;
    uncertainty.resize(in_.files.size());
    for (std::size_t k = 0; k < members.scans.size(); ++k) {
      const std::size_t i = members.scans[k];
      out_.T_survey_scan[i] = Eigen::Translation3d(record_.origin) * solution.T_survey_scan[k] *
                              Eigen::Translation3d(-in_.sampled[i].scan.origin);
      if (is_fixed(in_, i)) out_.T_survey_scan[i] = in_.initial_poses[i];
      out_.is_confirmed[i] = members.settled != nullptr ||
                             (!is_fixed(in_, i) && prior_of(in_, i) == nullptr && solution.degrees_of_freedom > 0 &&
                              solution.chi_squared <= chi_squared_limit(solution.degrees_of_freedom));
      PoseUncertainty& pose = uncertainty[i];
      pose.centre = solution.T_survey_local * network.frames[k].centre;
      pose.determined = solution.is_determined() && solution.covariance[k].allFinite();
      if (pose.determined) pose.covariance = solution.covariance[k];
      out_.sigma_in_voxels[i] =
          sigma_in_voxels(pose, scans_[i].moments, solution.T_survey_scan[k], resolutions_.coarse_m);
    }
    for (std::size_t k = 0; k < solution.points.size(); ++k) take(solution.points[k], record_.points[source_[k]]);
    for (LinkRecord& link : result_.links) {
      const bool is_member = std::find(members.scans.begin(), members.scans.end(), link.a) != members.scans.end();
      if (!is_member || !link.strength) continue;
      link.strength->centre = solution.T_survey_local * link.strength->centre;
      for (LinkAxis& axis : link.strength->axes) {
        axis.rotation_per_m = solution.T_survey_local.linear() * axis.rotation_per_m;
        axis.translation = solution.T_survey_local.linear() * axis.translation;
      }
    }
  }

  static void take(const SurveyPoint& from, PointResidual& to) {
    to.status = from.is_blunder ? PointStatus::kBlunder : from.is_used ? PointStatus::kUsed : PointStatus::kCheck;
    to.residual_m = from.residual_m;
    to.sigma_m = from.sigma_m;
    to.redundancy = from.redundancy;
    to.test = from.test.value_or(PointResidual::kUnknown);
  }

  void warn() const {
    for (const PointResidual& p : record_.points) {
      const std::string name = p.point.is_scanner     ? "the position of " + p.point.scan
                               : p.point.scan.empty() ? "control point " + p.point.name
                                                      : "control point " + p.point.name + " in " + p.point.scan;
      if (p.status == PointStatus::kBlunder) {
        in_.context.warn(name + " contradicts the others and was left out: it is off by " +
                         figure(p.residual_m.norm(), 4) + " m");
      } else if (p.status == PointStatus::kNotRegistered && record_.has_frame) {
        in_.context.warn(name + " was not used: its scan has no place in the survey frame");
      }
    }
    for (const auto& remark : record_.remarks) in_.context.warn(remark);
  }

  const PipelineInput& in_;
  const std::vector<PreparedScan>& scans_;
  const Resolutions& resolutions_;
  PipelineResult& result_;
  SurveyRecord& record_;
  InitialPoses T_init_;
  std::vector<std::size_t> source_;  ///< which of the survey's points the observations last made are
  SurveyPlacement out_;
};

}  // namespace

SurveyEvidence survey_evidence(const PipelineInput& input, const std::vector<PreparedScan>& scans, double voxel_m) {
  if (input.survey.empty() && input.survey.sigma_level_rad == 0 && input.survey.levels.empty()) return {};
  const InitialPoses T_init = initial_local_poses(input.initial_poses, input.sampled, false);
  std::vector<SurveyedScan> surveyed(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    SurveyedScan& out = surveyed[i];
    out.middle = scans[i].moments.mean;
    out.radius_m = radius_m(scans[i]);
    out.sigma_level_rad = level_of(input, i);
    out.pose = known_pose(input, i, scans[i], T_init);
    for (const ControlPoint& p : input.survey.points) {
      if (p.scan != input.files[i] || p.use != PointUse::kControl) continue;
      out.points.push_back({p.name, p.measured - input.sampled[i].scan.origin, p.given, p.sigma_given_m.maxCoeff(),
                            p.sigma_measured_m.maxCoeff()});
    }
  }
  return {std::move(surveyed), voxel_m};
}

SurveyPlacement fit_to_survey(const PipelineInput& input, const std::vector<PreparedScan>& scans,
                              const Resolutions& resolutions, const std::vector<SettledComponent>& settled,
                              PipelineResult& result) {
  return SurveyFrame(input, scans, resolutions, result).run(settled);
}

}  // namespace tcm_icp
