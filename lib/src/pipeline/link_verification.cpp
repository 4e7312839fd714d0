#include "link_verification.hpp"

#include "merged_cloud.hpp"
#include "scan_sight.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "verdict.hpp"

namespace tcm_icp {

AlignmentEvidence verify_against_neighbors(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                           std::size_t scan, const std::vector<Eigen::Isometry3d>& T_reference_scan) {
  const double voxel_m = scans[scan].pyramid.level(0).voxel_size_m;
  MergedCloud neighbors(voxel_m);
  bool any = false;
  for (const auto& [a, b] : pairs) {
    if (a != scan && b != scan) continue;
    const std::size_t other = a == scan ? b : a;
    neighbors.add(scans[other].pyramid.level(0).cloud, T_reference_scan[other]);
    any = true;
  }
  if (!any) return {};
  return verify_alignment(scans[scan].held_out_sample, neighbors.level(), T_reference_scan[scan],
                          verification_at(voxel_m));
}

std::vector<FreeSpaceEvidence> free_space_of_pairs(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                                   const std::vector<Eigen::Isometry3d>& T_reference_scan,
                                                   int num_threads) {
  std::vector<FreeSpaceEvidence> of_pairs(pairs.size());
  parallel_for(num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [a, b] = pairs[k];
      of_pairs[k] = free_space(scans[a], scans[b], T_reference_scan[a].inverse() * T_reference_scan[b]);
    }
  });
  return of_pairs;
}

std::vector<FreeSpaceEvidence> free_space_of_neighbors(std::size_t num_scans, const ScanPairs& pairs,
                                                       const std::vector<FreeSpaceEvidence>& of_pairs) {
  std::vector<FreeSpaceEvidence> of_scans(num_scans);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    of_scans[pairs[k].first] += of_pairs[k];
    of_scans[pairs[k].second] += of_pairs[k];
  }
  return of_scans;
}

std::vector<LinkRecord> verify_links(const std::vector<PreparedScan>& scans, const ScanPairs& pairs,
                                     const std::vector<FreeSpaceEvidence>& free_space,
                                     const std::vector<Eigen::Isometry3d>& T_reference_scan, int num_threads) {
  std::vector<LinkRecord> links(pairs.size());
  parallel_for(num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [a, b] = pairs[k];
      const Eigen::Isometry3d T_a_b = T_reference_scan[a].inverse() * T_reference_scan[b];
      const PyramidLevel& level_a = scans[a].pyramid.level(0);
      const PyramidLevel& level_b = scans[b].pyramid.level(0);
      VerificationOptions options = verification_at(level_a.voxel_size_m);
      // The direction that sees more of the other scan speaks for the link: only there is it worth the slides.
      options.with_slides = false;
      const double b_in_a = verify_alignment(scans[b].held_out_sample, level_a, T_a_b, options).overlap;
      const double a_in_b = verify_alignment(scans[a].held_out_sample, level_b, T_a_b.inverse(), options).overlap;
      options.with_slides = true;
      links[k].a = a;
      links[k].b = b;
      links[k].evidence = b_in_a >= a_in_b
                              ? verify_alignment(scans[b].held_out_sample, level_a, T_a_b, options)
                              : verify_alignment(scans[a].held_out_sample, level_b, T_a_b.inverse(), options);
      links[k].free_space = free_space[k];
      const Verdict verdict = judge(links[k].evidence, links[k].free_space);
      links[k].verdict = verdict.accepted ? "accepted" : "rejected";
      links[k].reason = verdict.reason;
    }
  });
  return links;
}

}  // namespace tcm_icp
