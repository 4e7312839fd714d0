#include "plan_layout.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tcm_icp::html {
namespace {

// Lengths in units of the drawing, which is as wide as a page has room for.
constexpr double kWidth = 720, kMargin = 26, kMinHeight = 180, kMaxHeight = 460;
constexpr double kGap = 3;       // between discs
constexpr int kMaxRounds = 200;  // of moving discs apart; few are needed unless all stand in one place

double disc_radius(std::size_t n) { return n <= 20 ? 11 : n <= 60 ? 9 : 7; }

// Pairs that are too near give way to each other; where they stand in one place, in directions of their own.
bool move_apart(std::vector<Eigen::Vector2d>& at, double distance) {
  bool any = false;
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      Eigen::Vector2d between = at[j] - at[i];
      const double apart = between.norm();
      if (apart >= distance) continue;
      any = true;
      const double angle = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(at.size());
      between = apart > distance / 1000 ? Eigen::Vector2d(between / apart)
                                        : Eigen::Vector2d(std::cos(angle), std::sin(angle));
      at[i] -= (distance - apart) / 2 * between;
      at[j] += (distance - apart) / 2 * between;
    }
  }
  return any;
}

}  // namespace

PlanLayout lay_out_plan(const std::vector<Eigen::Vector2d>& middles, const std::vector<double>& extents_m) {
  PlanLayout plan;
  Eigen::AlignedBox2d box, covered;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    box.extend(middles[i]);
    for (const double side : {-1.0, 1.0}) covered.extend(middles[i] + Eigen::Vector2d::Constant(side * extents_m[i]));
  }
  // The middles fill half of the drawing, unless the scans are of one object, so that their middles all but coincide.
  const double extent_m = extents_m.empty() ? 0 : *std::max_element(extents_m.begin(), extents_m.end());
  const double around_m = std::max(box.isEmpty() ? 0 : box.sizes().maxCoeff() / 2, extent_m / 4);
  const Eigen::Vector2d around = Eigen::Vector2d::Constant(around_m);
  if (around_m > 0) covered = covered.intersection(Eigen::AlignedBox2d(box.min() - around, box.max() + around));
  const Eigen::Vector2d size = covered.sizes();
  const double usable_height = kMaxHeight - 2 * kMargin, usable_width = kWidth - 2 * kMargin;
  if (size.maxCoeff() > 0) plan.scale = 1 / std::max(size.x() / usable_width, size.y() / usable_height);
  plan.width = kWidth;
  plan.height = std::clamp(size.y() * plan.scale + 2 * kMargin, kMinHeight, kMaxHeight);
  plan.disc = disc_radius(middles.size());
  const Eigen::Vector2d centre(plan.width / 2, plan.height / 2);
  if (!covered.isEmpty()) plan.centre_m = covered.center();
  for (const auto& m : middles) {
    const Eigen::Vector2d p = plan.scale * (m - plan.centre_m);
    plan.at.emplace_back(centre.x() + p.x(), centre.y() - p.y());
  }
  for (int round = 0; round < kMaxRounds && move_apart(plan.at, 2 * plan.disc + kGap); ++round) plan.moved = true;
  for (auto& p : plan.at) {
    p.x() = std::clamp(p.x(), plan.disc + 1, plan.width - plan.disc - 1);
    p.y() = std::clamp(p.y(), plan.disc + 1, plan.height - plan.disc - 1);
  }
  return plan;
}

double round_length(double length_m) {
  const double power = std::pow(10, std::floor(std::log10(length_m)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= length_m) return factor * power;
  }
  return power;
}

}  // namespace tcm_icp::html
