#include "tcm_icp/visibility/viewpoint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hidden_share.hpp"
#include "place_search.hpp"
#include "unit_frame.hpp"

namespace tcm_icp {
namespace {

// A scanner sees all its points, but noise, mixed pixels and what moved leave some amid what others hide, the more the
// wider the bins are: the fewer points. Simulated scans of 60,000 points had up to 0.0102 of them, and two scans that
// were made one 0.0113 and more.
constexpr double kMaxHiddenShare = 0.0105, kMostHiddenShare = 0.02;
// Of the middle edge. From places farther apart, what lies behind a door differs by more than a bin and a voxel hide;
// the side of a wall that faces the scanner does not.
constexpr double kMaxRadius = 0.06, kMaxRoughRadius = 0.12;
constexpr std::size_t kMinPoints = 200;

// Each look takes more points and narrower bins, from fewer places. With one bin a point the basin about a place is
// wide, with two its bottom is sharp.
struct Look {
  std::size_t points;
  double bins_per_point;
  double first_step, last_step;  // of the middle edge
  std::size_t kept;              // places that the next look starts from
};
constexpr Look kGridLook{1500, 1, 0, 0, 8};
constexpr Look kLooks[] = {{5000, 1, 0.08, 0.04, 3}, {20000, 2, 0.04, 0.02, 1}};
constexpr Look kLastLook{60000, 2, 0.04, 0.0025, 1};
constexpr int kMaxRounds = 3;  // of the last look
// Where the second look still hides as many, or moves as long make no difference, there is no place to be found.
constexpr double kHopelessShare = 0.03, kHopelessMove = 0.18;

constexpr std::size_t kMaxAlternatives = 6;

double radius(const std::vector<Place>& good, const Found& best) {
  double longest = 0;
  for (const Place& p : good) longest = std::max(longest, static_cast<double>((p - best.place).norm()));
  return longest;
}

// The one farthest from those chosen, again and again.
std::vector<Place> spread_out(const std::vector<Place>& good, const Found& best) {
  std::vector<Place> chosen{best.place};
  const auto distance = [&](const Place& p) {
    float nearest = std::numeric_limits<float>::max();
    for (const Place& c : chosen) nearest = std::min(nearest, (c - p).norm());
    return nearest;
  };
  for (std::size_t k = 0; k < std::min(kMaxAlternatives, good.size()); ++k) {
    chosen.push_back(*std::max_element(good.begin(), good.end(),
                                       [&](const Place& a, const Place& b) { return distance(a) < distance(b); }));
  }
  chosen.erase(chosen.begin());
  return chosen;
}

double allowed_share(std::size_t num_points) {
  const double width = std::sqrt(static_cast<double>(kLastLook.points) / static_cast<double>(num_points));
  return std::min(kMostHiddenShare, kMaxHiddenShare * width);
}

// Chance may stop a descent; what lies around shows it.
std::vector<Place> finish(HiddenShare& hidden, const Look& look, Rng& rng, Found& best) {
  for (int round = 1;; ++round) {
    descend(hidden, look.first_step, look.last_step, best);
    const std::vector<Found> around = look_around(hidden, best, rng);
    const Found& other = *std::min_element(around.begin(), around.end(),
                                           [](const Found& a, const Found& b) { return a.hidden < b.hidden; });
    if (other.hidden >= best.hidden || round == kMaxRounds) return as_good(around, best);
    best = other;
  }
}

}  // namespace

bool Viewpoint::within(double share_of_extent) const {
  const bool sees_all = evidence == ViewpointEvidence::kScanLines || hidden_share <= allowed_hidden_share;
  return sees_all && radius_m <= share_of_extent * extent_m;
}

bool Viewpoint::determined() const { return within(kMaxRadius); }

bool Viewpoint::roughly_determined() const { return within(kMaxRoughRadius); }

std::optional<Viewpoint> find_viewpoint(const Cloud& cloud, std::span<const Eigen::Vector3d> guesses, Rng& rng) {
  const std::optional<UnitFrame> frame = find_unit_frame(cloud, kLastLook.points, kMinPoints, rng);
  if (!frame) return std::nullopt;
  const UnitCloud few = frame->cloud.thinned(kGridLook.points);
  HiddenShare coarse(few, kGridLook.bins_per_point);
  const Eigen::AlignedBox3f box = search_box(frame->box);
  std::vector<Found> found = search_grid(coarse, box, kGridLook.kept);
  for (const auto& guess : guesses) {
    // From far away all points lie in a few bins, at nearly one range: none hides another.
    if (const Place place = frame->to_unit(guess); box.contains(place)) found.push_back({0, place});
  }

  std::vector<Place> good;
  double inner = 1;
  for (const Look& look : kLooks) {
    const UnitCloud points = frame->cloud.thinned(look.points);
    HiddenShare hidden(points, look.bins_per_point);
    for (Found& f : found) descend(hidden, look.first_step, look.last_step, f);
    found = best_of(found, look.kept, look.first_step);
    if (look.kept != 1) continue;
    good = as_good(look_around(hidden, found.front(), rng), found.front());
    inner = hidden.inner(found.front().place);
  }
  Found& best = found.front();
  std::vector<Place> others;
  const double allowed = allowed_share(frame->cloud.size());
  if (inner < kHopelessShare && radius(good, best) < kHopelessMove) {
    HiddenShare hidden(frame->cloud, kLastLook.bins_per_point);
    good = finish(hidden, kLastLook, rng, best);
    inner = hidden.inner(best.place);
    if (inner <= allowed && radius(good, best) <= kMaxRadius) {
      others = look_for_others(hidden, best, kMaxRadius, kMaxRoughRadius);
    }
  }

  Viewpoint out;
  out.place = frame->from_unit(best.place);
  out.hidden_share = inner;
  out.allowed_hidden_share = allowed;
  const double radius_of_others = radius(others, best);
  out.radius_m =
      std::max(radius(good, best), radius_of_others > kMaxRoughRadius ? radius_of_others : 0) * frame->unit_m;
  out.extent_m = frame->unit_m;
  good.insert(good.end(), others.begin(), others.end());
  for (const Place& p : spread_out(good, best)) out.alternatives.push_back(frame->from_unit(p));
  return out;
}

}  // namespace tcm_icp
