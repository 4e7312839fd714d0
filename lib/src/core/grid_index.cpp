#include "tcm_icp/core/grid_index.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::uint32_t kAxisMask = (1U << 10U) - 1;
constexpr double kSlack = 1e-6;  // of a cell; far above the rounding of its walls
constexpr int kFirstBits = 8;    // of the number of slots

std::uint32_t packed(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (static_cast<std::uint32_t>(x) & kAxisMask) << 20U | (static_cast<std::uint32_t>(y) & kAxisMask) << 10U |
         (static_cast<std::uint32_t>(z) & kAxisMask);
}

// The cells about one, those that share a face first: what is nearest is likeliest there.
struct Around {
  std::array<std::array<std::int8_t, 3>, 27> steps{};
  std::array<std::array<std::uint32_t, 2>, 3> beyond{};  ///< bits of those below and above along an axis
  constexpr Around() {
    std::size_t n = 0;
    for (int walls = 0; walls <= 3; ++walls) {
      for (int k = 0; k < 27; ++k) {
        const std::array<int, 3> step{k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1};
        if ((step[0] != 0) + (step[1] != 0) + (step[2] != 0) != walls) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          steps[n][axis] = static_cast<std::int8_t>(step[axis]);
          if (step[axis] != 0) beyond[axis][step[axis] < 0 ? 0 : 1] |= 1U << n;
        }
        ++n;
      }
    }
  }
};
constexpr Around kAround;

}  // namespace

GridIndex::GridIndex(std::span<const Eigen::Vector3d> points, double cell_m)
    : cell_m_(cell_m), cells_per_m_(1 / cell_m) {
  constexpr std::size_t kMost = 4'000'000'000;  // what 32 bits count, with room for marks
  if (points.size() > kMost) {
    throw InvalidInput("a grid index holds at most 4,000,000,000 points, not " + std::to_string(points.size()));
  }
  if (!(cell_m > 0 && std::isfinite(cell_m) && std::isfinite(cells_per_m_))) {
    throw InvalidOptions("cell_m must be above 0 m and finite, not " + std::to_string(cell_m));
  }
  if (points.empty()) return;
  low_ = points.front();
  Eigen::Vector3d high = low_;
  for (const auto& p : points) {
    if (!p.allFinite()) throw InvalidInput("a grid index cannot hold a point that is not finite");
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  extent_ = high - low_;
  slack_m_ = kSlack * cell_m + 8 * std::numeric_limits<double>::epsilon() *
                                   std::max(low_.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());

  // Cells as they come, points counted; then cells in the order of the table, points sorted by them.
  shift_ = 32 - kFirstBits;
  cells_.resize(std::size_t{1} << kFirstBits);
  std::vector<std::uint32_t> place(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Place p = place_of(points[i] - low_);
    place[i] = packed(p[0], p[1], p[2]);
    ++add(place[i]).end;
  }
  std::vector<std::uint32_t> occupied;
  occupied.reserve(num_cells_);
  std::uint32_t begin = 0;
  for (Cell& cell : cells_) {
    if (cell.occupied == 0) continue;
    occupied.push_back(cell.place);
    cell.begin = begin;
    begin += cell.end;
    cell.end = cell.begin;
  }
  keys_.resize(points.size());
  for (auto& column : coordinates_) column.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t to = cells_[slot_of(place[i])].end++;
    keys_[to] = static_cast<std::uint32_t>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) coordinates_[axis][to] = points[i][static_cast<int>(axis)];
  }
  for (const std::uint32_t from : occupied) {
    const std::int64_t x = from >> 20U, y = from >> 10U & kAxisMask, z = from & kAxisMask;
    for (std::size_t k = 1; k < kAround.steps.size(); ++k) {
      const auto& step = kAround.steps[k];
      add(packed(x - step[0], y - step[1], z - step[2])).occupied |= 1U << k;
    }
  }
  for (Cell& cell : cells_) {
    if (cell.begin == cell.end) cell.occupied &= ~1U;
  }
}

GridIndex::Place GridIndex::place_of(const Eigen::Vector3d& offset) const {
  constexpr double kFarthest = 1e15;  // cells; beyond, doubles do not tell them apart
  Place place;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::clamp(offset[axis] * cells_per_m_, -kFarthest, kFarthest);
    const auto towards_0 = static_cast<std::int64_t>(cells);  // std::floor is a call on processors without SSE 4
    place[static_cast<std::size_t>(axis)] = towards_0 - (static_cast<double>(towards_0) > cells ? 1 : 0);
  }
  return place;
}

// Where the cell is, or would be.
std::size_t GridIndex::slot_of(std::uint32_t place) const {
  std::size_t i = place * 0x9E3779B1U >> shift_;
  while (cells_[i].occupied != 0 && cells_[i].place != place) i = (i + 1) & (cells_.size() - 1);
  return i;
}

// Its own bit is set where it is new.
GridIndex::Cell& GridIndex::add(std::uint32_t place) {
  std::size_t i = slot_of(place);
  if (cells_[i].occupied == 0) {
    if (4 * (std::size_t{num_cells_} + 1) > 3 * cells_.size()) {
      grow();
      i = slot_of(place);
    }
    cells_[i] = {place, 1, 0, 0};
    ++num_cells_;
  }
  return cells_[i];
}

void GridIndex::grow() {
  decltype(cells_) old(2 * cells_.size());
  old.swap(cells_);
  --shift_;
  for (const Cell& cell : old) {
    if (cell.occupied != 0) cells_[slot_of(cell.place)] = cell;
  }
}

// Distances first, the least of them, and then whose it is: without a branch for each point, two at a time.
void GridIndex::look_into(const Cell& cell, const Eigen::Vector3d& query, Neighbor& best) const {
  constexpr std::uint32_t kAtOnce = 64;
  std::array<double, kAtOnce> squared_m2;
  for (std::uint32_t begin = cell.begin; begin < cell.end; begin += kAtOnce) {
    const std::uint32_t count = std::min(kAtOnce, cell.end - begin);
    const double *x = &coordinates_[0][begin], *y = &coordinates_[1][begin], *z = &coordinates_[2][begin];
    for (std::uint32_t k = 0; k < count; ++k) {
      const double dx = query.x() - x[k], dy = query.y() - y[k], dz = query.z() - z[k];
      squared_m2[k] = dx * dx + dy * dy + dz * dz;
    }
    std::array<double, 4> least;
    least.fill(std::numeric_limits<double>::infinity());
    std::uint32_t k = 0;
    for (; k + 4 <= count; k += 4) {
      for (std::uint32_t lane = 0; lane < 4; ++lane) least[lane] = std::min(least[lane], squared_m2[k + lane]);
    }
    for (; k < count; ++k) least[0] = std::min(least[0], squared_m2[k]);
    const double nearest_m2 = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
    if (nearest_m2 > best.squared_distance_m2) continue;
    for (k = 0; k < count; ++k) {
      if (squared_m2[k] != nearest_m2) continue;
      const std::uint32_t key = keys_[begin + k];
      if (nearest_m2 < best.squared_distance_m2 || key < best.index) best = {key, nearest_m2};
    }
  }
}

Neighbor GridIndex::nearest_within(const Eigen::Vector3d& query, double radius_m) const {
  constexpr std::uint32_t kNone = Neighbor{}.index;
  const Eigen::Vector3d offset = query - low_;
  const double reach_m = radius_m + slack_m_;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(offset[axis] >= -reach_m && offset[axis] <= extent_[axis] + reach_m)) return {};
  }
  if (keys_.empty() || !query.allFinite()) return {};
  Neighbor best{kNone, radius_m * radius_m};
  const Place own = place_of(offset);
  const Cell& cell = cells_[slot_of(packed(own[0], own[1], own[2]))];
  if ((cell.occupied & 1U) != 0) look_into(cell, query, best);

  std::array<std::array<double, 3>, 3> squared_gaps;  // along an axis, to the cells below, here and above
  std::uint32_t asked = cell.occupied & ~1U;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double within_m = offset[static_cast<int>(axis)] - static_cast<double>(own[axis]) * cell_m_;
    const double below_m = std::max(within_m - slack_m_, 0.0), above_m = std::max(cell_m_ - within_m - slack_m_, 0.0);
    squared_gaps[axis] = {below_m * below_m, 0, above_m * above_m};
    if (squared_gaps[axis][0] > best.squared_distance_m2) asked &= ~kAround.beyond[axis][0];
    if (squared_gaps[axis][2] > best.squared_distance_m2) asked &= ~kAround.beyond[axis][1];
  }
  for (; asked != 0; asked &= asked - 1) {
    const auto& step = kAround.steps[static_cast<std::size_t>(std::countr_zero(asked))];
    double bound = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) bound += squared_gaps[axis][static_cast<std::size_t>(step[axis] + 1)];
    if (bound > best.squared_distance_m2) continue;
    look_into(cells_[slot_of(packed(own[0] + step[0], own[1] + step[1], own[2] + step[2]))], query, best);
  }
  if (reach_m > cell_m_ && std::sqrt(best.squared_distance_m2) > cell_m_ - slack_m_) {
    look_farther(own, query, radius_m, best);
  }
  return best.index != kNone ? best : Neighbor{};
}

// All cells that reach within the radius but those about the own one.
void GridIndex::look_farther(const Place& own, const Eigen::Vector3d& query, double radius_m, Neighbor& best) const {
  const Eigen::Vector3d offset = query - low_;
  const double reach_m = std::min(radius_m, std::sqrt(best.squared_distance_m2)) + slack_m_;
  const Place first = place_of((offset.array() - reach_m).cwiseMax(0).matrix());
  const Place last = place_of((offset.array() + reach_m).min(extent_.array()).matrix());
  const auto squared_gap = [&](std::size_t axis, std::int64_t place) {
    const double at = offset[static_cast<int>(axis)];
    const double gap_m = place < own[axis]   ? at - static_cast<double>(place + 1) * cell_m_
                         : place > own[axis] ? static_cast<double>(place) * cell_m_ - at
                                             : 0;
    const double least_m = std::max(gap_m - slack_m_, 0.0);
    return least_m * least_m;
  };
  for (std::int64_t x = first[0]; x <= last[0]; ++x) {
    for (std::int64_t y = first[1]; y <= last[1]; ++y) {
      const double gap_xy = squared_gap(0, x) + squared_gap(1, y);
      if (gap_xy > best.squared_distance_m2) continue;
      for (std::int64_t z = first[2]; z <= last[2]; ++z) {
        if (std::max({std::abs(x - own[0]), std::abs(y - own[1]), std::abs(z - own[2])}) <= 1) continue;
        if (gap_xy + squared_gap(2, z) > best.squared_distance_m2) continue;
        look_into(cells_[slot_of(packed(x, y, z))], query, best);
      }
    }
  }
}

}  // namespace tcm_icp
