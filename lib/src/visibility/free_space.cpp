#include "tcm_icp/visibility/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/acceptance.hpp"
#include "visibility/direction_bins.hpp"
#include "visibility/seen_through.hpp"

namespace tcm_icp {
namespace {

constexpr double kMinIncidenceCosine = 0.2;  // nearly along a surface, a bin holds any range
constexpr double kMinNormalCosine = 0.7;
constexpr double kSamePlane = 0.25;  // [voxels] thin things have both sides within a voxel, but not at one place

// In units of the largest share, and of a standard deviation of the count beyond it.
double beyond_chance(std::size_t part, std::size_t all, double largest_share) {
  const double largest = largest_share * static_cast<double>(all);
  return static_cast<double>(part) / (largest + std::sqrt(largest));
}

struct Tally {
  std::size_t before = 0, large = 0, at = 0;
  std::size_t count() const { return before + at; }
  double share() const { return count() == 0 ? 1 : static_cast<double>(before) / static_cast<double>(count()); }
};

// Points before the surfaces that a scanner saw, by bins of its range image.
class PointsBefore {
 public:
  void add(const Eigen::Vector3d& direction, double solid_angle_sr) {
    const std::size_t bin = kRangeImageBins(direction);
    bins_.push_back(bin);
    solid_angle_sr_[bin] += solid_angle_sr;
  }

  std::size_t count() const { return bins_.size(); }

  // Those that fill a bin with the others about them. What is smaller, a post far away, may stand between two rays.
  std::size_t num_large() const {
    return static_cast<std::size_t>(std::count_if(bins_.begin(), bins_.end(), [&](std::size_t bin) {
      double about_sr = 0;
      for (const std::size_t near : kRangeImageBins.around(bin)) {
        const auto found = solid_angle_sr_.find(near);
        if (found != solid_angle_sr_.end()) about_sr += found->second;
      }
      return about_sr >= kRangeImageBins.mean_solid_angle_sr();
    }));
  }

 private:
  std::vector<std::size_t> bins_;  // of each point
  std::unordered_map<std::size_t, double> solid_angle_sr_;
};

// Each point stands for so much of a surface.
Tally look(const RangeImage& image, const Cloud& points, double voxel_m, double area_m2) {
  Tally tally;
  PointsBefore before;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d ray = points.points[i] - image.place();
    const double range = ray.norm(), cosine = std::abs(points.normals[i].dot(ray)) / range;
    if (cosine <= kMinIncidenceCosine) continue;
    const Seen seen = seen_at(image, points.points[i], voxel_m);
    if (seen == Seen::kThrough) before.add(ray / range, area_m2 * cosine / (range * range));
    tally.at += seen == Seen::kAt ? 1 : 0;
  }
  tally.before = before.count();
  tally.large = before.num_large();
  return tally;
}

// Every so-manieth, so that both directions cost the same for any scan.
struct Picked {
  std::vector<std::size_t> points;
  double share = 1;  // of those that have a normal
};

Picked pick(const Cloud& cloud, std::size_t max_points) {
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.normals[i].isZero()) usable.push_back(i);
  }
  Picked out;
  const std::size_t count = std::min(max_points, usable.size());
  for (std::size_t i = 0; i < count; ++i) out.points.push_back(usable[i * usable.size() / count]);
  if (count > 0) out.share = static_cast<double>(count) / static_cast<double>(usable.size());
  return out;
}

Tally look_from(const SightedScan& viewer, const SightedScan& other, const Picked& picked,
                const Eigen::Isometry3d& T_viewer_other) {
  Cloud moved;
  for (const std::size_t i : picked.points) {
    moved.points.push_back(T_viewer_other * other.surfaces.cloud.points[i]);
    moved.normals.push_back(T_viewer_other.linear() * other.surfaces.cloud.normals[i]);
  }
  const double voxel_m = viewer.surfaces.voxel_size_m, area_m2 = voxel_m * voxel_m / picked.share;
  Tally least;
  bool first = true;
  for (const RangeImage& image : viewer.sight.images) {
    const Tally tally = look(image, moved, voxel_m, area_m2);
    if (first || tally.share() < least.share()) least = tally;
    first = false;
  }
  return least;
}

void compare_sides(const SightedScan& a, const SightedScan& b, const Picked& picked, const Eigen::Isometry3d& T_a_b,
                   FreeSpaceEvidence& evidence) {
  const double voxel_m = a.surfaces.voxel_size_m;
  for (const std::size_t i : picked.points) {
    const Eigen::Vector3d p = T_a_b * b.surfaces.cloud.points[i];
    const Neighbor q = a.surfaces.index.nearest_within(p, voxel_m);
    if (!q.found()) continue;
    const Eigen::Vector3d apart = p - a.surfaces.cloud.points[q.index];
    if (std::abs(a.surfaces.cloud.normals[q.index].dot(apart)) > kSamePlane * voxel_m) continue;
    const double cosine = (T_a_b.linear() * b.sight.facing[i]).dot(a.sight.facing[q.index]);
    if (std::abs(cosine) <= kMinNormalCosine) continue;
    ++evidence.num_matches;
    evidence.num_opposed += cosine < 0 ? 1 : 0;
  }
}

}  // namespace

bool FreeSpaceEvidence::tells() const { return num_points >= kMinFreeSpacePoints; }

double FreeSpaceEvidence::excess() const {
  const double violating = tells() ? beyond_chance(num_violating, num_points, kMaxViolationShare) : 0;
  const double opposed =
      num_matches < kMinFreeSpacePoints ? 0 : beyond_chance(num_opposed, num_matches, kVetoedOpposedShare);
  return std::max(violating, opposed);
}

FreeSpaceEvidence& FreeSpaceEvidence::operator+=(const FreeSpaceEvidence& other) {
  num_points += other.num_points;
  num_violating += other.num_violating;
  num_points_of_b += other.num_points_of_b;
  num_violating_of_b += other.num_violating_of_b;
  num_large += other.num_large;
  num_large_of_b += other.num_large_of_b;
  num_matches += other.num_matches;
  num_opposed += other.num_opposed;
  return *this;
}

FreeSpaceEvidence measure_free_space(const SightedScan& a, const SightedScan& b, const Eigen::Isometry3d& T_a_b) {
  FreeSpaceEvidence evidence = measure_violations(a, b, T_a_b);
  if (!a.sight.knows_sides() || !b.sight.knows_sides()) return evidence;
  compare_sides(a, b, pick(b.surfaces.cloud, kFreeSpaceSample), T_a_b, evidence);
  compare_sides(b, a, pick(a.surfaces.cloud, kFreeSpaceSample), T_a_b.inverse(), evidence);
  return evidence;
}

FreeSpaceEvidence measure_violations(const SightedScan& a, const SightedScan& b, const Eigen::Isometry3d& T_a_b,
                                     std::size_t max_points) {
  Tally of_a, of_b;
  if (a.sight.sees_space()) of_b = look_from(a, b, pick(b.surfaces.cloud, max_points), T_a_b);
  if (b.sight.sees_space()) of_a = look_from(b, a, pick(a.surfaces.cloud, max_points), T_a_b.inverse());
  FreeSpaceEvidence evidence;
  evidence.num_points = of_a.count() + of_b.count();
  evidence.num_violating = of_a.before + of_b.before;
  evidence.num_points_of_b = of_b.count();
  evidence.num_violating_of_b = of_b.before;
  evidence.num_large = of_a.large + of_b.large;
  evidence.num_large_of_b = of_b.large;
  return evidence;
}

}  // namespace tcm_icp
