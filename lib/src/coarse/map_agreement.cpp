#include "map_agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tcm_icp {
namespace {

// Sums over the shared cells, for the nine shifts of up to one cell.
struct Sums {
  float n = 0;
  struct Channel {
    float t = 0, s = 0, tt = 0, ss = 0, ts = 0;
    void add(float target, float source, float seen) {
      t += target;
      s += seen * source;
      tt += target * target;
      ss += seen * source * source;
      ts += target * source;
    }
  } detail, structure;

  static double correlation(const Channel& c, double count) {
    const double t = c.t, s = c.s;
    const double covariance = c.ts - t * s / count;
    const double variances = (c.tt - t * t / count) * (c.ss - s * s / count);
    return variances > 0 ? covariance / std::sqrt(variances) : 0;
  }
  double score(double share, double min_shared) const {
    if (n < 2 || n < min_shared * share) return 0;
    return (correlation(detail, n) + correlation(structure, n)) * std::sqrt(n / share / 2);
  }
};

struct Turned {
  float c, s, x, y;

  Turned(const MapPeak& pose, int target_size)
      : c(static_cast<float>(std::cos(pose.heading_rad))),
        s(static_cast<float>(std::sin(pose.heading_rad))),
        x(static_cast<float>(pose.x + target_size / 2 + 0.5)),
        y(static_cast<float>(pose.y + target_size / 2 + 0.5)) {}
  // In cells of the target, not negative inside the map.
  float column(const Eigen::Vector2f& p) const { return c * p.x() - s * p.y() + x; }
  float row(const Eigen::Vector2f& p) const { return s * p.x() + c * p.y() + y; }
};

constexpr int kReach = 1, kShifts = 2 * kReach + 1;

// Three shifts side by side, and a fourth that nobody asks for: vector instructions take four floats.
using Lanes = Eigen::Array4f;

Lanes lanes_from(const std::vector<float>& image, std::size_t first) {
  if (first + 4 <= image.size()) return Eigen::Map<const Lanes>(image.data() + first);
  return {image[first], image[first + 1], image[first + 2], 0};
}

struct SumLanes {
  Lanes n = Lanes::Zero();
  struct Channel {
    Lanes t = Lanes::Zero(), s = Lanes::Zero(), tt = Lanes::Zero(), ss = Lanes::Zero(), ts = Lanes::Zero();
    void add(const Lanes& target, float source, const Lanes& seen) {
      const Lanes seen_source = seen * source;
      t += target;
      s += seen_source;
      tt += target * target;
      ss += seen_source * source;
      ts += target * source;
    }
    Sums::Channel of(Eigen::Index i) const { return {t[i], s[i], tt[i], ss[i], ts[i]}; }
  } detail, structure;

  Sums of(Eigen::Index i) const { return {n[i], detail.of(i), structure.of(i)}; }
};

std::array<Sums, kShifts * kShifts> sums_around(const HeightMap& target, const MapCells& source, const MapPeak& pose) {
  static_assert(kShifts == 3);
  struct Cell {
    std::size_t first;  // of the target's cells beside it, one row up
    float detail, structure;
  };
  std::vector<Cell> cells;
  cells.reserve(source.position.size());
  const Turned turned(pose, target.size);
  const auto last = static_cast<float>(target.size - kReach);
  for (std::size_t i = 0; i < source.position.size(); ++i) {
    const float u = turned.column(source.position[i]), v = turned.row(source.position[i]);
    if (!(u >= kReach && v >= kReach && u < last && v < last)) continue;
    const int first = (static_cast<int>(v) - kReach) * target.size + static_cast<int>(u) - kReach;
    cells.push_back({static_cast<std::size_t>(first), source.detail[i], source.structure[i]});
  }
  std::array<Sums, kShifts * kShifts> sums;
  for (std::size_t row = 0; row < kShifts; ++row) {
    SumLanes lanes;  // stays in registers
    for (const Cell& cell : cells) {
      const std::size_t first = cell.first + row * static_cast<std::size_t>(target.size);
      const Lanes seen = lanes_from(target.mask, first);
      lanes.n += seen;
      lanes.detail.add(lanes_from(target.detail, first), cell.detail, seen);
      lanes.structure.add(lanes_from(target.structure, first), cell.structure, seen);
    }
    for (std::size_t k = 0; k < kShifts; ++k) sums[row * kShifts + k] = lanes.of(static_cast<Eigen::Index>(k));
  }
  return sums;
}

// Middle of the shared cells in the source map: turning about it leaves the shared area in place.
Eigen::Vector2d shared_middle(const HeightMap& target, const MapCells& source, const MapPeak& pose) {
  const Turned turned(pose, target.size);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double n = 0;
  for (const auto& p : source.position) {
    const float u = turned.column(p), v = turned.row(p);
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(target.size) && v < static_cast<float>(target.size))) continue;
    const std::size_t k =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(target.size) + static_cast<std::size_t>(u);
    if (target.mask[k] == 0) continue;
    sum += p.cast<double>();
    ++n;
  }
  return n > 0 ? Eigen::Vector2d(sum / n) : Eigen::Vector2d::Zero();
}

}  // namespace

MapCells list_cells(const HeightMap& map, std::size_t max_cells) {
  MapCells out;
  const auto seen = static_cast<std::size_t>(map.num_seen), kept = std::min(max_cells, seen);
  std::size_t i = 0;
  for (std::size_t k = 0; k < map.mask.size(); ++k) {
    if (map.mask[k] == 0) continue;
    // Every cell whose place in the list of `kept` differs from that of the cell before.
    if (i * kept / seen != (i + 1) * kept / seen) {
      const auto n = static_cast<std::size_t>(map.size);
      out.position.emplace_back(static_cast<float>(k % n) - static_cast<float>(map.size / 2),
                                static_cast<float>(k / n) - static_cast<float>(map.size / 2));
      out.detail.push_back(map.detail[k]);
      out.structure.push_back(map.structure[k]);
      out.height.push_back(map.height[k]);
    }
    ++i;
  }
  out.share = seen == 0 ? 1 : static_cast<double>(kept) / static_cast<double>(seen);
  return out;
}

double agreement(const HeightMap& target, const MapCells& source, const MapPeak& pose, double min_shared) {
  const auto sums = sums_around(target, source, pose);
  return sums[sums.size() / 2].score(source.share, min_shared);
}

MapPeak refine_peak(const HeightMap& target, const MapCells& source, const MapPeak& start, double heading_step_rad,
                    double min_shared) {
  const Eigen::Vector2d middle = shared_middle(target, source, start);
  const Eigen::Vector2d fixed = Eigen::Rotation2Dd(start.heading_rad) * middle + Eigen::Vector2d(start.x, start.y);
  MapPeak best = start;
  best.score = 0;
  for (const double step : {0.0, -1.0, 1.0}) {
    MapPeak pose = start;
    pose.heading_rad += step * heading_step_rad;
    const Eigen::Vector2d shift = fixed - Eigen::Rotation2Dd(pose.heading_rad) * middle;
    pose.x = shift.x();
    pose.y = shift.y();
    const auto sums = sums_around(target, source, pose);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const double score = sums[k].score(source.share, min_shared);
      if (score <= best.score) continue;
      best = pose;
      best.score = score;
      best.x += static_cast<double>(k % kShifts) - kReach;
      best.y += static_cast<double>(k / kShifts) - kReach;
    }
  }
  return best;
}

SharedCells shared_cells(const HeightMap& target, const HeightMap& source, const MapCells& cells, const MapPeak& pose) {
  SharedCells out;
  const Turned turned(pose, target.size);
  for (std::size_t i = 0; i < cells.position.size(); ++i) {
    const float u = turned.column(cells.position[i]), v = turned.row(cells.position[i]);
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(target.size) && v < static_cast<float>(target.size))) continue;
    const auto column = static_cast<int>(u), row = static_cast<int>(v);
    const std::size_t k =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(target.size) + static_cast<std::size_t>(column);
    if (target.mask[k] == 0) continue;
    out.target.emplace_back((column - target.size / 2) * target.cell_m, (row - target.size / 2) * target.cell_m,
                            target.height[k] * target.cell_m);
    out.source.emplace_back(cells.position[i].x() * source.cell_m, cells.position[i].y() * source.cell_m,
                            cells.height[i] * source.cell_m);
  }
  return out;
}

}  // namespace tcm_icp
