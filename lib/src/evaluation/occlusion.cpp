#include "evaluation/occlusion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

class Occlusion {
 public:
  explicit Occlusion(const Points& points) : points_(points), is_visible_(points.size(), true) {
    for (const auto& p : points) middle_ += p / static_cast<double>(points.size());
  }

  void hide_sector(std::size_t number, Rng& rng) {
    constexpr double kTurn = 2 * std::numbers::pi;
    const double begin = kTurn * uniform01(rng);
    hide_least(number, [&](const Vector3d& p) {
      const double angle = std::atan2(p.y() - middle_.y(), p.x() - middle_.x()) - begin;
      return angle - kTurn * std::floor(angle / kTurn);
    });
  }

  void hide_box(std::size_t number, Rng& rng) {
    const Points places = visible_places();
    const Vector3d& centre = places[uniform_index(rng, places.size())];
    hide_least(number, [&](const Vector3d& p) { return (p - centre).cwiseAbs().maxCoeff(); });
  }

  std::vector<bool> result() && { return std::move(is_visible_); }

 private:
  std::vector<std::size_t> visible() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_visible_[i]) indices.push_back(i);
    return indices;
  }

  /// One point a cell, so that where points lie densest, near the scanner, is no likelier a place than another.
  Points visible_places() const {
    constexpr double kCellInMedianDistances = 0.1;
    Cloud left;
    std::vector<double> distances_m;
    for (const std::size_t i : visible()) {
      left.points.push_back(points_[i]);
      distances_m.push_back((points_[i] - middle_).norm());
    }
    const double cell_m = kCellInMedianDistances * median(distances_m);
    return cell_m > 0 ? voxel_downsample(left, cell_m).points : left.points;
  }

  /// Hides the visible points with the least keys; of equal ones those that come first.
  template <typename Key>
  void hide_least(std::size_t number, const Key& key) {
    std::vector<std::pair<double, std::size_t>> order;
    for (const std::size_t i : visible()) order.emplace_back(key(points_[i]), i);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < number; ++i) is_visible_[order[i].second] = false;
  }

  const Points& points_;
  std::vector<bool> is_visible_;
  Vector3d middle_ = Vector3d::Zero();
};

}  // namespace

std::vector<bool> visible_points(const Points& points, std::size_t num_hidden, Rng& rng) {
  constexpr std::size_t kParts = 4;
  Occlusion occlusion(points);
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t number = num_hidden * (part + 1) / kParts - num_hidden * part / kParts;
    part % 2 == 0 ? occlusion.hide_sector(number, rng) : occlusion.hide_box(number, rng);
  }
  return std::move(occlusion).result();
}

}  // namespace tcm_icp
