#include <algorithm>
#include <vector>

#include "line_pieces.hpp"
#include "place_grid.hpp"
#include "place_search.hpp"
#include "sweep_fit.hpp"
#include "tcm_icp/visibility/viewpoint_by_lines.hpp"
#include "unit_frame.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMinPieces = 100;
constexpr std::size_t kFramePoints = 5000, kMinFramePoints = 200;

constexpr double kStartPlaces = 4000;
constexpr std::size_t kFirstPatches = 50, kGridPatches = 100, kFitPatches = 1000, kFitPieces = 2000;
constexpr std::size_t kLookedAtAgain = 500;  // of the places, those that the first patches speak for
constexpr std::size_t kStarts = 12, kKept = 4;
constexpr int kRounds = 12;
constexpr double kLastMove = 0.0002, kMostOfLast = 0.9;

// Angles of pieces with lines. Of places those are compared that come close; sweeps of a scanner that moves are bent by
// up to 0.1. From a place of the grid lines are off by a few tenths; Geman-McClure's scale begins there.
constexpr double kCloseTolerance = 0.02, kTolerance = 0.1, kGridTolerance = 0.2;
constexpr double kGridScale = 0.2, kFittedScale = 0.03;
constexpr double kRivalDistance = 0.06;

// Of scans, real and simulated, whole, cut and thinned, right centres have 0.986 and more. Of 93 pairs of scans made
// one two have 0.989 and 0.992, the others 0.974 and less.
constexpr double kMinShare = 0.98, kMaxRivalShare = 0.85;
constexpr double kSigmas = 3;

std::size_t stride_for(std::size_t size, std::size_t count) { return std::max<std::size_t>(1, size / count); }

struct Candidate {
  Sweep sweep;
  SweepSupport support;
};

void sort_by_support(std::vector<Candidate>& found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.support.rows > b.support.rows; });
}

// Where noise hides lines, more pieces are seen from near the centre; where there is little, as many from anywhere, but
// they agree on an axis from there alone. Few patches tell which places to look from again.
std::vector<Candidate> search_grid_of_centres(const std::vector<FlatPatch>& patches, const Eigen::AlignedBox3d& box) {
  const PlaceGrid<double> grid = grid_of_places(box, kStartPlaces);
  const auto seen_from = [&](const Eigen::Vector3d& place, std::size_t num_patches) {
    const LinePieces pieces = find_line_pieces(patches, place, stride_for(patches.size(), num_patches));
    const Sweep sweep{place, likely_axis(place, pieces), 0};
    return Candidate{sweep, support_of_sweep(sweep, pieces, kGridTolerance)};
  };
  std::vector<Candidate> found;
  for (const Eigen::Vector3d& place : grid.places) found.push_back(seen_from(place, kFirstPatches));
  sort_by_support(found);
  if (found.size() > kLookedAtAgain) found.resize(kLookedAtAgain);
  for (Candidate& c : found) c = seen_from(c.sweep.centre, kGridPatches);
  sort_by_support(found);
  return first_apart(found, kStarts, kNotNextSteps * grid.step, [](const Candidate& c) { return c.sweep.centre; });
}

// Pieces of lines move as their points do, along their rays: so they are found again from each better place.
Sweep fitted(Sweep from, const std::vector<FlatPatch>& patches, std::size_t stride, double scale) {
  const LinePieces pieces = find_line_pieces(patches, from.centre, stride);
  from.axis = likely_axis(from.centre, pieces);
  return fit_sweep(from, pieces, stride_for(pieces.middles.size(), kFitPieces), scale);
}

// Along the axis each round may move by a part of what is left alone: two equal parts tell all that is (Aitken).
Sweep settled(Sweep at, const std::vector<FlatPatch>& patches, std::size_t stride) {
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Vector3d before = at.centre;
    at = fitted(at, patches, stride, kFittedScale);
    const Eigen::Vector3d move = at.centre - before;
    if (move.norm() < kLastMove) break;
    const double share = last.isZero() ? 0 : move.dot(last) / last.squaredNorm();
    const bool goes_on = share > 0 && share < kMostOfLast && round + 1 < kRounds;
    if (goes_on) at.centre += share / (1 - share) * move;
    last = goes_on ? Eigen::Vector3d(0, 0, 0) : move;
  }
  return at;
}

Candidate with_support(const Sweep& sweep, const std::vector<FlatPatch>& patches, std::size_t stride) {
  return {sweep, support_of_sweep(sweep, find_line_pieces(patches, sweep.centre, stride), kCloseTolerance)};
}

bool has_rival(const std::vector<Candidate>& found) {
  const Candidate& best = found.front();
  return std::any_of(found.begin(), found.end(), [&](const Candidate& c) {
    const bool is_elsewhere = (c.sweep.centre - best.sweep.centre).norm() > kRivalDistance;
    return is_elsewhere &&
           static_cast<double>(c.support.rows) > kMaxRivalShare * static_cast<double>(best.support.rows);
  });
}

std::optional<Sweep> find_sweep(const std::vector<FlatPatch>& patches, const Eigen::AlignedBox3d& box) {
  const std::size_t stride = stride_for(patches.size(), kFitPatches);
  std::vector<Candidate> found;
  for (const Candidate& start : search_grid_of_centres(patches, box)) {
    const Sweep sweep = fitted(start.sweep, patches, stride, kGridScale);
    if (box.contains(sweep.centre)) found.push_back(with_support(sweep, patches, stride));
  }
  sort_by_support(found);
  found = first_apart(found, kKept, kRivalDistance, [](const Candidate& c) { return c.sweep.centre; });
  for (Candidate& c : found) c = with_support(settled(c.sweep, patches, stride), patches, stride);
  sort_by_support(found);
  if (found.empty() || has_rival(found)) return std::nullopt;
  const Sweep best = settled(found.front().sweep, patches, 1);
  if (!box.contains(best.centre)) return std::nullopt;
  return best;
}

}  // namespace

std::optional<Viewpoint> find_viewpoint_by_lines(const Cloud& cloud, const NeighborIndex& index, Rng& rng) {
  const std::optional<UnitFrame> frame = find_unit_frame(cloud, kFramePoints, kMinFramePoints, rng);
  if (!frame) return std::nullopt;
  const std::vector<FlatPatch> patches = find_flat_patches(cloud.points, index, *frame);
  if (patches.size() < kMinPieces) return std::nullopt;
  const std::optional<Sweep> sweep = find_sweep(patches, search_box(frame->box).cast<double>());
  if (!sweep) return std::nullopt;
  const LinePieces pieces = find_line_pieces(patches, sweep->centre, 1);
  const SweepSupport support = support_of_sweep(*sweep, pieces, kTolerance);
  if (support.rows < kMinPieces || support.share() < kMinShare) return std::nullopt;

  Viewpoint out;
  out.evidence = ViewpointEvidence::kScanLines;
  out.place = frame->from_axes(sweep->centre);
  out.line_share = support.share();
  out.radius_m = kSigmas * sweep->sigma * frame->unit_m;
  out.extent_m = frame->unit_m;
  if (!out.determined()) return std::nullopt;
  return out;
}

}  // namespace tcm_icp
