#include "links/overlaps_at_poses.hpp"

#include <algorithm>
#include <set>

#include "core/acceptance.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

// The pyramid's level at which poses are asked for overlap, and the distance of what overlaps, in its voxels.
constexpr std::size_t kOverlapLevel = 2;
constexpr double kOverlapInVoxels = 2;

}  // namespace

double OverlapsAtPoses::distance_m(std::size_t scan) const {
  return kOverlapInVoxels * scans_[scan].pyramid.level(kOverlapLevel).voxel_size_m;
}

bool OverlapsAtPoses::may_overlap(std::size_t a, std::size_t b, const Eigen::Isometry3d& T_a_b) const {
  return may_meet(scans_[a], scans_[b], T_a_b, distance_m(a));
}

std::vector<double> OverlapsAtPoses::at(const std::vector<ImpliedPose>& poses, double same_m) {
  std::vector<double> out(poses.size(), 0);
  std::vector<char> is_new(poses.size(), 0);
  parallel_for(num_threads_, poses.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t a = poses[k].a, b = poses[k].b;
      const Eigen::Isometry3d& T_a_b = poses[k].T_a_b;
      if (!may_overlap(a, b, T_a_b)) continue;
      if (const auto known = known_at(poses[k], same_m)) {
        out[k] = *known;
        continue;
      }
      const PyramidLevel &x = scans_[a].pyramid.level(kOverlapLevel), &y = scans_[b].pyramid.level(kOverlapLevel);
      out[k] = overlap(x, y, T_a_b, distance_m(a));
      is_new[k] = 1;
    }
  });
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (is_new[k] != 0) known_[{poses[k].a, poses[k].b}].emplace_back(poses[k].T_a_b, out[k]);
  }
  return out;
}

std::optional<double> OverlapsAtPoses::known_at(const ImpliedPose& pose, double same_m) const {
  const auto known = known_.find({pose.a, pose.b});
  if (known == known_.end()) return std::nullopt;
  for (const auto& [T, share] : known->second) {
    if (rms_displacement(pose.T_a_b.inverse() * T, scans_[pose.b].moments) < same_m) return share;
  }
  return std::nullopt;
}

std::vector<std::size_t> most_overlapping(const std::vector<ImpliedPose>& poses, const std::vector<double>& overlaps,
                                          std::size_t most_partners) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> of_scan;  // by configuration and scan
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (overlaps[k] < kGuessedOverlap) continue;
    for (const std::size_t i : {poses[k].a, poses[k].b}) of_scan[{poses[k].configuration, i}].push_back(k);
  }
  std::set<std::size_t> out;
  for (auto& [place, all] : of_scan) {
    std::stable_sort(all.begin(), all.end(), [&](std::size_t x, std::size_t y) { return overlaps[x] > overlaps[y]; });
    out.insert(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(most_partners, all.size())));
  }
  return {out.begin(), out.end()};
}

}  // namespace tcm_icp
