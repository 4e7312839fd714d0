#include "survey/survey_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

constexpr double kUsualResidual = 3;         // standard deviations: what right poses show, too
constexpr double kFewContradicted = 0.1;     // of pairs: their poses are wrong
constexpr std::size_t kPairedOfBlunder = 5;  // blunders are rare: one scan of so many at most
constexpr double kMostAgainst = 8;           // log-odds; one in 3,000 observations is a blunder at least

double squared(double x) { return x * x; }

// Normalised by standard deviations whose squares are given.
double normalised(double residual, double variance) { return residual / std::sqrt(variance); }

// Of a scan whose pose is known: how far off its middle and its rotation put a place, squared.
double variance_at(const SurveyedScan& scan, const Eigen::Vector3d& place) {
  return squared(scan.pose->sigma_position_m) +
         squared(scan.pose->sigma_rotation_rad) * (place - scan.middle).squaredNorm();
}

// A scan's points, by where the pose of the other puts them.
double residual_of_points(const SurveyedScan& with_points, const SurveyedScan& other,
                          const Eigen::Isometry3d& T_other_points, double pose_m2) {
  double largest = 0;
  for (const SurveyedScan::Point& p : with_points.points) {
    const Eigen::Vector3d place = T_other_points * p.measured;
    const double variance =
        squared(p.sigma_given_m) + squared(p.sigma_measured_m) + variance_at(other, place) + pose_m2;
    largest = std::max(largest, normalised((other.pose->T_survey_scan * place - p.given).norm(), variance));
  }
  return largest;
}

struct Contradicted {
  std::size_t pairs = 0, contradicted = 0;

  void add(const PairBySurvey& pair) {
    ++pairs;
    if (pair.log_odds < 0) ++contradicted;
  }
  // One pair alone may just be wrong.
  bool is_most() const { return contradicted >= 2 && 2 * contradicted > pairs; }
  // By the share, then the number; those of which not most are contradicted come first.
  bool operator<(const Contradicted& other) const {
    if (is_most() != other.is_most()) return other.is_most();
    const std::size_t own = contradicted * other.pairs, others = other.contradicted * pairs;
    return own != others ? own < others : pairs < other.pairs;
  }
};

}  // namespace

SurveyEvidence::SurveyEvidence(std::vector<SurveyedScan> scans, double voxel_m)
    : scans_(std::move(scans)), voxel_m_(voxel_m) {}

double SurveyEvidence::log_odds(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
  if (empty()) return 0;
  const double beyond = squared(largest_residual(scans_[a], scans_[b], T_a_b)) - squared(kUsualResidual);
  return -std::clamp(beyond / 2, 0.0, kMostAgainst);
}

double SurveyEvidence::largest_residual(const SurveyedScan& a, const SurveyedScan& b,
                                        const Eigen::Isometry3d& T_a_b) const {
  const double pose_m2 = squared(voxel_m_), radius_m = std::min(a.radius_m, b.radius_m);
  const double pose_rad2 = radius_m > 0 ? pose_m2 / squared(radius_m) : 0;
  double largest = 0;
  const auto ask = [&](double residual, double variance) {
    largest = std::max(largest, normalised(residual, variance));
  };
  for (const auto& p : a.points) {
    for (const auto& q : b.points) {
      const double distance_m = (p.measured - T_a_b * q.measured).norm(), given_m = (p.given - q.given).norm();
      const double given_m2 = p.name == q.name ? 0 : squared(p.sigma_given_m) + squared(q.sigma_given_m);
      ask(std::abs(distance_m - given_m),
          given_m2 + squared(p.sigma_measured_m) + squared(q.sigma_measured_m) + pose_m2);
    }
  }
  if (a.pose) largest = std::max(largest, residual_of_points(b, a, T_a_b, pose_m2));
  if (b.pose) largest = std::max(largest, residual_of_points(a, b, T_a_b.inverse(), pose_m2));
  if (a.pose && b.pose) {
    const Eigen::Isometry3d given = a.pose->T_survey_scan.inverse() * b.pose->T_survey_scan;
    const Eigen::Vector3d middle = T_a_b * b.middle;
    ask((middle - given * b.middle).norm(), variance_at(a, middle) + squared(b.pose->sigma_position_m) + pose_m2);
    ask(rotation_angle_rad(given.linear().transpose() * T_a_b.linear()),
        squared(a.pose->sigma_rotation_rad) + squared(b.pose->sigma_rotation_rad) + pose_rad2);
  }
  if (a.sigma_level_rad > 0 && b.sigma_level_rad > 0) {
    const double cosine = std::clamp(T_a_b.linear()(2, 2), -1.0, 1.0);
    ask(std::acos(cosine), squared(a.sigma_level_rad) + squared(b.sigma_level_rad) + pose_rad2);
  }
  return largest;
}

std::vector<bool> survey_blunders(const std::vector<PairBySurvey>& pairs, std::size_t num_scans) {
  const std::vector<bool> none(num_scans, false);
  std::vector<bool> out = none, has_pairs = none;
  for (const PairBySurvey& pair : pairs) has_pairs[pair.a] = has_pairs[pair.b] = true;
  const auto num_paired = static_cast<std::size_t>(std::count(has_pairs.begin(), has_pairs.end(), true));
  const std::size_t most = num_paired < 3 ? 0 : std::max<std::size_t>(1, num_paired / kPairedOfBlunder);
  for (std::size_t left = 0;; ++left) {
    std::vector<Contradicted> scans(num_scans);
    Contradicted all;
    for (const PairBySurvey& pair : pairs) {
      if (out[pair.a] || out[pair.b]) continue;
      for (Contradicted* count : {&scans[pair.a], &scans[pair.b], &all}) count->add(pair);
    }
    // The first of several.
    const auto worst = std::max_element(scans.begin(), scans.end());
    if (worst == scans.end() || !worst->is_most()) {
      return static_cast<double>(all.contradicted) <= kFewContradicted * static_cast<double>(all.pairs) ? out : none;
    }
    if (left == most) return none;
    out[static_cast<std::size_t>(worst - scans.begin())] = true;
  }
}

}  // namespace tcm_icp
