#include <algorithm>
#include <vector>

#include "place_grid.hpp"
#include "place_search.hpp"
#include "sweep_fit.hpp"
#include "tcm_icp/visibility/scan_lines.hpp"
#include "unit_frame.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMinPieces = 100;
constexpr std::size_t kFramePoints = 5000, kMinFramePoints = 200;

// From a grid place, lines are off by a few tenths; from the centre by noise.
constexpr double kGridTolerance = 0.2, kTolerance = 0.02;
constexpr double kStartPlaces = 4000;
constexpr std::size_t kGridPieces = 400, kFitPieces = 2000, kStarts = 12;
constexpr double kRivalDistance = 0.06;

// On real and simulated scans of spinning scanners, whole and thinned, right centres have 0.95 and more, wrong ones
// 0.83 and less.
constexpr double kMinShare = 0.9, kMaxRivalShare = 0.85;
constexpr double kSigmas = 3;

std::size_t stride_for(const LinePieces& pieces, std::size_t count) {
  return std::max<std::size_t>(1, pieces.middles.size() / count);
}

LinePieces in_units(const LinePieces& pieces, const UnitFrame& frame) {
  const Eigen::Isometry3d T_axes_cloud = frame.T_cloud_axes.inverse();
  LinePieces out;
  for (const auto& p : pieces.middles) out.middles.push_back(T_axes_cloud * p / frame.unit_m);
  for (const auto& t : pieces.directions) out.directions.push_back(T_axes_cloud.linear() * t);
  return out;
}

struct Scored {
  double share;
  Sweep sweep;
};

void sort_by_share(std::vector<Scored>& found) {
  std::stable_sort(found.begin(), found.end(), [](const Scored& a, const Scored& b) { return a.share > b.share; });
}

std::vector<Scored> search_grid_of_centres(const LinePieces& pieces, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d axis = likely_axis(pieces);
  const std::size_t stride = stride_for(pieces, kGridPieces);
  const PlaceGrid<double> grid = grid_of_places(box, kStartPlaces);
  std::vector<Scored> found;
  for (const Eigen::Vector3d& place : grid.places) {
    const Sweep sweep{place, axis, 0};
    found.push_back({share_of_sweep(sweep, pieces, kGridTolerance, stride), sweep});
  }
  sort_by_share(found);
  return first_apart(found, kStarts, kNotNextSteps * grid.step, [](const Scored& f) { return f.sweep.centre; });
}

}  // namespace

std::optional<Viewpoint> find_viewpoint_by_lines(const Cloud& cloud, const LinePieces& pieces, Rng& rng) {
  if (pieces.middles.size() < kMinPieces) return std::nullopt;
  const std::optional<UnitFrame> frame = find_unit_frame(cloud, kFramePoints, kMinFramePoints, rng);
  if (!frame) return std::nullopt;
  const LinePieces units = in_units(pieces, *frame);
  const Eigen::AlignedBox3d box = search_box(frame->box).cast<double>();

  std::vector<Scored> fitted;
  for (const Scored& start : search_grid_of_centres(units, box)) {
    const Sweep sweep = fit_sweep(start.sweep, units, stride_for(units, kFitPieces));
    fitted.push_back({share_of_sweep(sweep, units, kTolerance, 1), sweep});
  }
  sort_by_share(fitted);
  const Scored& best = fitted.front();
  double rival = 0;
  for (const Scored& f : fitted) {
    if ((f.sweep.centre - best.sweep.centre).norm() > kRivalDistance) rival = std::max(rival, f.share);
  }
  if (!box.contains(best.sweep.centre) || best.share < kMinShare || rival > kMaxRivalShare * best.share) {
    return std::nullopt;
  }
  Viewpoint out;
  out.evidence = ViewpointEvidence::kScanLines;
  out.place = frame->from_axes(best.sweep.centre);
  out.line_share = best.share;
  out.radius_m = kSigmas * best.sweep.sigma * frame->unit_m;
  out.extent_m = frame->unit_m;
  if (!out.determined()) return std::nullopt;
  return out;
}

}  // namespace tcm_icp
