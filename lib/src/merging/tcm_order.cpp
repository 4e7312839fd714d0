#include "merging/tcm_order.hpp"

#include <string>

#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

bool uses_paper_tcm(const MergeOptions& options) {
  if (options.order == MergeOrder::kPaperTcm) return true;
  return options.paper_tcm && options.order == MergeOrder::kTcm;
}

}  // namespace

TcmOrder::TcmOrder(const std::vector<PreparedScan>& scans, const MergeOptions& options, const RunContext& context)
    : scans_(scans), options_(options), context_(context), clouds_(scans.size()) {}

std::vector<TcmTerms> TcmOrder::measure(const ScanPyramid& s, const std::vector<MergeChoice>& choices) {
  std::vector<TcmTerms> terms(choices.size());
  if (uses_paper_tcm(options_)) {
    const TcmCloud cloud(s.level(0).cloud.points);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      terms[k] = tcm_terms(cloud, TcmCloud(scans_[choices[k].scan].pyramid.level(0).cloud.points),
                           choices[k].T_reference_scan);
    }
    return terms;
  }
  // Each scan once: no two threads fill in the same cloud.
  if (!s_cloud_) s_cloud_.emplace(s.level(1).cloud.points, options_.tcm);
  parallel_for(context_.num_threads, choices.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::optional<RobustTcmCloud>& cloud = clouds_[choices[k].scan];
      if (!cloud) cloud.emplace(scans_[choices[k].scan].tcm_points, options_.tcm);
      terms[k] = robust_tcm_terms(*s_cloud_, *cloud, choices[k].T_reference_scan);
    }
  });
  return terms;
}

TcmOrder::Next TcmOrder::next(const ScanPyramid& s, const std::vector<MergeChoice>& choices) {
  const std::vector<TcmTerms> terms = measure(s, choices);
  std::size_t position = 0;
  if (options_.order == MergeOrder::kFile) {
    position = 0;
  } else if (options_.order == MergeOrder::kRandom) {
    Rng rng = make_stream(context_.seed, "merge order", std::to_string(num_random_++));
    position = uniform_index(rng, choices.size());
  } else if (options_.order == MergeOrder::kOverlap) {
    const PyramidLevel& level = s.level(1);
    double most = -1;
    for (std::size_t k = 0; k < choices.size(); ++k) {
      const PyramidLevel& scan = scans_[choices[k].scan].pyramid.level(1);
      const double share = overlap({level.cloud.points, level.index}, {scan.cloud.points, scan.index},
                                   choices[k].T_reference_scan, 2 * level.voxel_size_m);
      if (share > most) most = share, position = k;
    }
  } else {
    std::vector<MergeCandidate> candidates;
    for (std::size_t k = 0; k < choices.size(); ++k) candidates.push_back({choices[k].scan, terms[k]});
    const std::size_t scan = next_scan_to_merge(candidates);
    while (choices[position].scan != scan) ++position;
  }
  return {position, terms[position]};
}

}  // namespace tcm_icp
