// Where each scan lies, in numbers a person reads; and how well loops of pairs close.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

#include "report_parts.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::size_t kMostLoops = 12;

struct Loop {
  std::array<std::size_t, 3> scans{};
  double distance_m = 0, angle_rad = 0;
};

// Of each pair the likeliest pose that the result bears out: found for the pair by itself.
using PairPoses = std::map<std::pair<std::size_t, std::size_t>, const LinkHypothesisRecord*>;

PairPoses confirmed_pairs(const PipelineResult& result) {
  PairPoses best;
  for (const auto& h : result.hypotheses) {
    if (h.status != HypothesisStatus::kConfirmed || h.log_odds <= 0) continue;
    const LinkHypothesisRecord*& entry = best[std::minmax(h.a, h.b)];
    if (entry == nullptr || h.log_odds > entry->log_odds) entry = &h;
  }
  return best;
}

Eigen::Isometry3d pose(const PairPoses& pairs, std::size_t a, std::size_t b) {
  const LinkHypothesisRecord& h = *pairs.at(std::minmax(a, b));
  return h.a == a ? h.T_a_b : h.T_a_b.inverse();
}

Loop close_loop(const PipelineResult& result, const PairPoses& pairs, std::size_t a, std::size_t b, std::size_t c) {
  const Eigen::Isometry3d round = pose(pairs, a, b) * pose(pairs, b, c) * pose(pairs, c, a);
  const Eigen::Vector3d middle = result.scans[a].origin + result.scans[a].middle;
  return {{a, b, c}, (round * middle - middle).norm(), Eigen::AngleAxisd(round.linear()).angle()};
}

}  // namespace

Json pose_json(const PipelineResult& result, std::size_t scan) {
  const ScanPose& pose = result.poses[scan];
  if (pose.status == ScanStatus::kUnregistered) return nullptr;
  const Eigen::Isometry3d& T = pose.T_reference_scan;
  const bool is_setup = !result.viewpoints.empty() && result.viewpoints[scan] && result.viewpoints[scan]->determined();
  const Eigen::Vector3d at = is_setup ? result.viewpoints[scan]->place : Eigen::Vector3d::Zero();
  return {{"position_m", vector(T * at)},
          {"is_setup", is_setup},
          {"heading_deg", kDegrees * std::atan2(T.linear()(1, 0), T.linear()(0, 0))},
          {"tilt_deg", kDegrees * std::acos(std::clamp(T.linear()(2, 2), -1.0, 1.0))}};
}

Json loops_json(const PipelineResult& result) {
  const PairPoses pairs = confirmed_pairs(result);
  std::vector<Loop> loops;
  for (auto first = pairs.begin(); first != pairs.end(); ++first) {
    const auto [a, b] = first->first;
    for (auto second = std::next(first); second != pairs.end() && second->first.first == a; ++second) {
      const std::size_t c = second->first.second;
      if (pairs.contains({b, c})) loops.push_back(close_loop(result, pairs, a, b, c));
    }
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const Loop& one, const Loop& other) { return one.distance_m > other.distance_m; });
  Json worst = Json::array();
  double squares = 0;
  for (const Loop& loop : loops) squares += loop.distance_m * loop.distance_m;
  for (std::size_t k = 0; k < std::min(kMostLoops, loops.size()); ++k) {
    Json scans = Json::array();
    for (const std::size_t i : loops[k].scans) scans.push_back(result.scans[i].file);
    worst.push_back(
        {{"scans", scans}, {"distance_m", loops[k].distance_m}, {"rotation_deg", kDegrees * loops[k].angle_rad}});
  }
  return {{"loops", loops.size()},
          {"rms_m", loops.empty() ? Json(nullptr) : Json(std::sqrt(squares / static_cast<double>(loops.size())))},
          {"worst", worst}};
}

}  // namespace tcm_icp
