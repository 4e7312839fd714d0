#pragma once
// Looking for the places from which the fewest points are hidden. Lengths are in units of a UnitFrame.

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "hidden_share.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

using Place = Eigen::Vector3f;

struct Found {
  double hidden = 1;  ///< share
  Place place = Place::Zero();
};

/// The `count` best, none nearer to a better one than `apart`.
std::vector<Found> best_of(std::vector<Found> found, std::size_t count, double apart);

/// Where places are looked for: the box of the points and room about it.
Eigen::AlignedBox3f search_box(const Eigen::AlignedBox3f& of_points);

/// The best of a grid of 1,200 places, or somewhat more, in the box. None are next to one another.
std::vector<Found> search_grid(HiddenShare& hidden, const Eigen::AlignedBox3f& box, std::size_t count);

/// Compass search: a step that helps is taken again; where none of six does, steps half as long.
/// @param allowed  places that may be looked at; empty: all
void descend(HiddenShare& hidden, double first_step, double last_step, Found& at,
             const std::function<bool(const Place&)>& allowed = {});

/// Places at random distances of up to 0.2 in random directions, and along the line of the best of them. The shares of
/// those not as good are not exact: each is more than one as good may have.
std::vector<Found> look_around(HiddenShare& hidden, const Found& from, Rng& rng);

/// Places as good, not nearer to it than `apart`, by descents from 26 sides: they may lie along a narrow valley, which
/// random moves miss. One beyond `too_far` ends the search.
std::vector<Place> look_for_others(HiddenShare& hidden, const Found& from, double apart, double too_far);

/// Of the places found around the best, those as good.
std::vector<Place> as_good(const std::vector<Found>& around, const Found& best);

}  // namespace tcm_icp
