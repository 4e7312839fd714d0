#include "merging/tcm_order.hpp"

#include <limits>
#include <string>

#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"

namespace tcm_icp {
namespace {

// Of what lies in one voxel: merged last.
constexpr TcmTerms kTooSmall{std::numeric_limits<double>::infinity(), 1, 1};

bool uses_paper_tcm(const MergeOptions& options) {
  if (options.order == MergeOrder::kPaperTcm) return true;
  return options.paper_tcm && options.order == MergeOrder::kTcm;
}

}  // namespace

TcmOrder::TcmOrder(const std::vector<PreparedScan>& scans, const MergeOptions& options, const RunContext& context)
    : scans_(scans), options_(options), context_(context) {}

std::size_t TcmOrder::level() const { return uses_paper_tcm(options_) ? 0 : options_.fits ? 1 : 2; }

std::vector<MergeMeasure> TcmOrder::measure(const PyramidLevel& s, const std::vector<MergeChoice>& choices) const {
  std::vector<MergeMeasure> out(choices.size());
  const auto for_each_choice = [&](const auto& measured) {
    parallel_for(context_.num_threads, choices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) measured(choices[k], out[k]);
    });
  };
  if (uses_paper_tcm(options_)) {
    const TcmCloud cloud(s.cloud.points);
    for_each_choice([&](const MergeChoice& choice, MergeMeasure& m) {
      m.terms = tcm_terms(cloud, TcmCloud(scans_[choice.scan].pyramid.level(0).cloud.points), choice.T_reference_scan);
    });
  } else if (s.cloud.size() < 2) {
    for_each_choice([&](const MergeChoice&, MergeMeasure& m) { m.terms = kTooSmall; });
  } else {
    const RobustTcmCloud cloud(s.cloud.points, options_.tcm);
    for_each_choice([&](const MergeChoice& choice, MergeMeasure& m) { m.terms = terms(cloud, choice); });
  }
  if (options_.order == MergeOrder::kOverlap) {
    for_each_choice([&](const MergeChoice& choice, MergeMeasure& m) {
      const PyramidLevel& scan = scans_[choice.scan].pyramid.level(level());
      m.overlap = overlap(s, scan, choice.T_reference_scan, 2 * s.voxel_size_m);
    });
  }
  return out;
}

TcmTerms TcmOrder::terms(const RobustTcmCloud& s, const MergeChoice& choice) const {
  const Points& points = scans_[choice.scan].pyramid.level(level()).cloud.points;
  if (points.size() < 2) return kTooSmall;
  return robust_tcm_terms(s, RobustTcmCloud(points, options_.tcm), choice.T_reference_scan);
}

std::size_t TcmOrder::next(const std::vector<MergeChoice>& choices, const std::vector<MergeMeasure>& measures) {
  if (options_.order == MergeOrder::kFile) return 0;
  if (options_.order == MergeOrder::kRandom) {
    Rng rng = make_stream(context_.seed, "merge order", std::to_string(num_random_++));
    return uniform_index(rng, choices.size());
  }
  if (options_.order == MergeOrder::kOverlap) {
    std::size_t most = 0;
    for (std::size_t k = 1; k < choices.size(); ++k) {
      if (measures[k].overlap > measures[most].overlap) most = k;
    }
    return most;
  }
  std::vector<MergeCandidate> candidates;
  for (std::size_t k = 0; k < choices.size(); ++k) candidates.push_back({choices[k].scan, measures[k].terms});
  const std::size_t scan = next_scan_to_merge(candidates);
  std::size_t position = 0;
  while (choices[position].scan != scan) ++position;
  return position;
}

}  // namespace tcm_icp
