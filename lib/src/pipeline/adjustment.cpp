#include "adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"
#include "tcm_icp/registration/lp_registration.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kSharesOfSample = 3;     // each neighbour sees a third of a scan's points, not the same third
constexpr double kFirstGate = 2, kLastGate = 2;  // in coarse voxels, in fine voxels
constexpr double kNormalAngle = std::numbers::pi / 6;

Cloud share_of(const Cloud& cloud, std::size_t which) {
  Cloud out;
  for (std::size_t i = which % kSharesOfSample; i < cloud.size(); i += kSharesOfSample) {
    out.points.push_back(cloud.points[i]);
    out.normals.push_back(cloud.normals[i]);
  }
  return out;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> overlapping_pairs(
    const std::vector<PreparedScan>& scans, const std::vector<Eigen::Isometry3d>& T_reference_scan,
    const std::vector<bool>& placed, double min_overlap, int num_threads) {
  std::vector<std::pair<std::size_t, std::size_t>> candidates;
  for (std::size_t a = 0; a < scans.size(); ++a) {
    for (std::size_t b = a + 1; b < scans.size(); ++b) {
      if (placed[a] && placed[b]) candidates.emplace_back(a, b);
    }
  }
  std::vector<char> keep(candidates.size(), 0);
  parallel_for(num_threads, candidates.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = candidates[i];
      const PyramidLevel& level_a = scans[a].pyramid.level(1);
      const PyramidLevel& level_b = scans[b].pyramid.level(1);
      const double share = overlap({level_a.cloud.points, level_a.index}, {level_b.cloud.points, level_b.index},
                                   T_reference_scan[a].inverse() * T_reference_scan[b], level_a.voxel_size_m);
      keep[i] = share >= min_overlap ? 1 : 0;
    }
  });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (keep[i] != 0) pairs.push_back(candidates[i]);
  }
  return pairs;
}

void adjust_poses(const std::vector<PreparedScan>& scans,
                  const std::vector<std::pair<std::size_t, std::size_t>>& pairs, std::size_t reference,
                  const Resolutions& resolutions, const PipelineOptions& options, const RunContext& context,
                  std::vector<Eigen::Isometry3d>& T_reference_scan) {
  std::vector<std::vector<std::size_t>> neighbors(scans.size());
  for (const auto& [a, b] : pairs) {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  const double first = kFirstGate * resolutions.coarse_m, last = kLastGate * resolutions.fine_m;
  const int sweeps = options.placement.adjustment_sweeps;
  std::size_t done = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const double share = sweeps > 1 ? static_cast<double>(sweep) / (sweeps - 1) : 1;
    const CorrespondenceGate gate{first * std::pow(last / first, share), kNormalAngle};
    for (std::size_t j = 0; j < scans.size(); ++j) {
      context.report("adjusting", done++, static_cast<std::size_t>(sweeps) * scans.size());
      if (j == reference || neighbors[j].empty()) continue;
      std::vector<std::vector<Correspondence>> found(neighbors[j].size());
      parallel_for(context.num_threads, neighbors[j].size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          const std::size_t i = neighbors[j][k];
          found[k] = find_correspondences(share_of(scans[j].fine_sample, k),
                                          T_reference_scan[i].inverse() * T_reference_scan[j], scans[i].fine, gate);
          for (auto& c : found[k]) {
            c.source = T_reference_scan[i] * c.source;
            c.target = T_reference_scan[i] * c.target;
            c.normal = T_reference_scan[i].linear() * c.normal;
          }
        }
      });
      std::vector<Correspondence> matches;
      for (const auto& f : found) matches.insert(matches.end(), f.begin(), f.end());
      if (matches.size() < 50) continue;
      LpFigures figures;
      double step_m = 0;
      lp_point_to_plane_step(matches, options.lp, T_reference_scan[j], figures, step_m);
    }
  }
}

}  // namespace tcm_icp
