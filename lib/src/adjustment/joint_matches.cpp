#include "adjustment/joint_matches.hpp"

#include <algorithm>
#include <numbers>

#include "core/memory_budget.hpp"
#include "scans/matched_sides.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/registration/match_precision.hpp"

namespace tcm_icp {
namespace {

// A scan with many neighbours shows each of them a part of its points, not the same part, so that its cost is bounded:
// up to this many times its whole sample, as far as no part is less than a third.
constexpr std::size_t kSamplesOfScan = 3, kMostParts = 3;
constexpr double kNormalAngle = std::numbers::pi / 6;

std::size_t parts_for(std::size_t num_neighbors) {
  return std::clamp<std::size_t>((num_neighbors + kSamplesOfScan - 1) / kSamplesOfScan, 1, kMostParts);
}

Cloud part_of(const Cloud& cloud, std::size_t which, std::size_t num_parts) {
  Cloud out;
  for (std::size_t i = which % num_parts; i < cloud.size(); i += num_parts) {
    out.points.push_back(cloud.points[i]);
    out.normals.push_back(cloud.normals[i]);
  }
  return out;
}

}  // namespace

std::vector<JointLink> match_pairs(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                   const std::vector<Eigen::Isometry3d>& T_reference_scan, double max_distance_m,
                                   int num_threads) {
  std::vector<JointLink> links;
  std::vector<std::size_t> num_neighbors(scans.size(), 0);
  for (const auto& [a, b] : pairs) {
    links.push_back({a, b, {}});
    links.push_back({b, a, {}});
    ++num_neighbors[a];
    ++num_neighbors[b];
  }
  const CorrespondenceGate gate{max_distance_m, kNormalAngle};
  std::vector<std::vector<bool>> doubted(links.size());
  parallel_for(num_threads, links.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      JointLink& link = links[k];
      const Eigen::Isometry3d& T = T_reference_scan[link.target];
      const PreparedScan &target = scans[link.target], &source = scans[link.source];
      const Eigen::Isometry3d T_target_source = T.inverse() * T_reference_scan[link.source];
      link.matches =
          find_correspondences(part_of(source.fine_sample, link.target, parts_for(num_neighbors[link.source])),
                               T_target_source, target.fine, gate);
      drop_opposed(target.sight, source.sight, T_target_source, link.matches);
      doubted[k] = may_be_opposed(target.sight, source.sight, T_target_source, link.matches);
      for (auto& m : link.matches) {
        m.source = T * m.source;
        m.target = T * m.target;
        m.normal = T.linear() * m.normal;
      }
      link.matches = in_budget(std::move(link.matches));
    }
  });
  set_precisions(links, doubted);
  return links;
}

std::vector<TwistFrame> scan_frames(const std::vector<PreparedScan>& scans,
                                    const std::vector<Eigen::Isometry3d>& T_reference_scan) {
  std::vector<TwistFrame> frames;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Points& points = scans[i].fine_sample.points;
    frames.push_back(points.empty() ? TwistFrame() : twist_frame(points, T_reference_scan[i]));
  }
  return frames;
}

std::vector<JointLink> thinned(std::vector<JointLink> links, std::size_t max_matches) {
  for (auto& link : links) {
    const std::size_t n = link.matches.size();
    if (n <= max_matches) continue;
    for (std::size_t i = 0; i < max_matches; ++i) link.matches[i] = link.matches[i * n / max_matches];
    link.matches.resize(max_matches);
  }
  return links;
}

}  // namespace tcm_icp
