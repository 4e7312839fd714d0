#include "tcm_icp/coarse/vertical.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/decompositions.hpp"
#include "envelope.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMaxNormals = 2000;  // a share is then known to about 0.01
constexpr std::size_t kNumPeaks = 3;       // ground and two walls
constexpr double kPeakAngle_deg = 10;      // normals of one surface, with a sensor's noise
constexpr double kDistinctAngle_deg = 20;  // two axes; nearer ones are the same one
constexpr double kMinPeakShare = 0.1;      // of all normals, for them to level the scan
constexpr double kCellsAcross = 64;        // a plan is about this wide

double to_rad(double deg) { return deg * EIGEN_PI / 180; }

bool are_distinct(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::abs(a.dot(b)) < std::cos(to_rad(kDistinctAngle_deg));
}

Eigen::Matrix3d principal_axes(const Points& points, Eigen::Vector3d& deviations) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose();
  const SymmetricEigen<3> eigen = symmetric_eigen3(covariance / static_cast<double>(points.size()));
  deviations = eigen.values.cwiseMax(0).cwiseSqrt();
  return eigen.vectors;
}

// Mean axis of the normals within the angle, and how many they are.
std::size_t mean_axis(const Points& normals, double angle_deg, Eigen::Vector3d& axis) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  const double min_cos = std::cos(to_rad(angle_deg));
  for (const auto& n : normals) {
    const double c = n.dot(axis);
    if (std::abs(c) < min_cos) continue;
    sum += c < 0 ? Eigen::Vector3d(-n) : n;
    ++count;
  }
  if (count > 0) axis = sum.normalized();
  return count;
}

Points drawn_normals(const Cloud& cloud) {
  Points normals;
  for (const auto& n : cloud.normals) {
    if (n.squaredNorm() > 0.5) normals.push_back(n);
  }
  return even_sample(normals, kMaxNormals);
}

// The directions most normals have, best first.
void append_normal_peaks(const Points& normals, std::vector<Eigen::Vector3d>& axes) {
  struct Peak {
    Eigen::Vector3d start, axis;
    std::size_t count;
  };
  std::vector<Peak> found;
  for (const auto& start : even_sample(normals, kMaxNormals / 10)) {
    Eigen::Vector3d axis = start;
    const std::size_t count = mean_axis(normals, kPeakAngle_deg, axis);
    found.push_back({start, axis, count});
  }
  std::vector<Eigen::Vector3d> peaks;
  for (std::size_t k = 0; k < kNumPeaks; ++k) {
    const Peak* best = nullptr;
    for (const Peak& peak : found) {
      if (peak.count <= (best == nullptr ? 0 : best->count)) continue;
      if (std::all_of(peaks.begin(), peaks.end(), [&](const auto& p) { return are_distinct(peak.start, p); })) {
        best = &peak;
      }
    }
    if (best == nullptr) break;
    peaks.push_back(best->axis);
  }
  axes.insert(axes.end(), peaks.begin(), peaks.end());
}

struct Axis {
  Eigen::Vector3d direction;
  Envelope envelope;
  double area = 0;
};

// Normals near the axis are those of floors and level ground; where there are enough, they know the vertical best.
void level_by_normals(const Points& normals, Eigen::Vector3d& axis) {
  Eigen::Vector3d refined = axis;
  for (const double angle_deg : {2 * kPeakAngle_deg, kPeakAngle_deg, kPeakAngle_deg / 2}) {
    const std::size_t count = mean_axis(normals, angle_deg, refined);
    if (static_cast<double>(count) < kMinPeakShare * static_cast<double>(normals.size())) return;
    axis = refined;
  }
}

// An axis has no sign, but the plan it is measured on is turned by it: one of the two is taken. Not by the largest
// entry: where two are equal, rounding would choose. One of three is always above 1/2, which is no direction of note.
void fix_sign(Eigen::Vector3d& axis) {
  for (const int k : {2, 1, 0}) {
    if (std::abs(axis[k]) < 0.5) continue;
    if (axis[k] < 0) axis = -axis;
    return;
  }
}

}  // namespace

void VerticalOptions::validate() const {
  if (max_axes < 1) throw InvalidOptions("max_axes is " + std::to_string(max_axes) + "; it must be at least 1");
  for (const auto& [name, value] :
       {std::pair("min_area_ratio", min_area_ratio), std::pair("max_roughness_ratio", max_roughness_ratio)}) {
    if (!(value >= 0 && value <= 1)) {
      throw InvalidOptions(std::string(name) + " is " + std::to_string(value) + "; it must be between 0 and 1");
    }
  }
}

std::vector<Eigen::Vector3d> find_up_directions(const Cloud& cloud, const VerticalOptions& options) {
  options.validate();
  if (cloud.size() < 3) throw InvalidInput("a cloud of fewer than 3 points has no vertical");
  Eigen::Vector3d deviations;
  const Eigen::Matrix3d principal = principal_axes(cloud.points, deviations);
  if (!(deviations[2] > 0)) throw InvalidInput("all points of the cloud are equal: it has no vertical");
  if (options.levelled) {
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    level_by_normals(drawn_normals(cloud), up);
    if (up.z() < 0) up = -up;
    const bool near = up.z() >= std::cos(kMaxLevelTilt_deg * EIGEN_PI / 180);
    return {near ? up : Eigen::Vector3d::UnitZ()};
  }
  // A uniform disk is 4 standard deviations wide. Same cell for all axes, or areas say nothing.
  const double cell_m = 4 * deviations[2] / kCellsAcross;

  std::vector<Eigen::Vector3d> directions = {principal.col(0), principal.col(1), principal.col(2)};
  const Points normals = drawn_normals(cloud);
  append_normal_peaks(normals, directions);
  std::vector<Axis> axes;
  for (auto& direction : directions) {
    level_by_normals(normals, direction);
    fix_sign(direction);
    Envelope envelope = make_envelope(cloud.points, levelling_rotation(direction), cell_m);
    const double area = envelope.num_occupied();
    axes.push_back({direction, std::move(envelope), area});
  }
  std::stable_sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.area > b.area; });

  std::vector<const Axis*> kept;
  for (const Axis& axis : axes) {
    if (static_cast<int>(kept.size()) == options.max_axes) break;
    if (axis.area < options.min_area_ratio * axes.front().area) break;
    if (std::all_of(kept.begin(), kept.end(),
                    [&](const Axis* k) { return are_distinct(k->direction, axis.direction); })) {
      kept.push_back(&axis);
    }
  }

  std::vector<Eigen::Vector3d> up;
  for (const Axis* axis : kept) {
    const Envelope& envelope = axis->envelope;
    const double low = roughness(envelope, envelope.lowest), high = roughness(envelope, envelope.highest);
    const double sign = high < low ? -1 : 1;
    up.push_back(sign * axis->direction);
    // Where both are zero nothing is shown either.
    if (std::min(low, high) >= options.max_roughness_ratio * std::max(low, high)) up.push_back(-sign * axis->direction);
  }
  return up;
}

}  // namespace tcm_icp
