#include "pose_graph.hpp"

#include <algorithm>
#include <cmath>

#include "link_score.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {

void PoseGraph::add(const CandidateLink& link) {
  CandidateLink& known = links_.try_emplace({link.a, link.b}, CandidateLink{link.a, link.b, {}}).first->second;
  known.hypotheses.insert(known.hypotheses.end(), link.hypotheses.begin(), link.hypotheses.end());
  std::stable_sort(known.hypotheses.begin(), known.hypotheses.end(),
                   [](const LinkHypothesis& x, const LinkHypothesis& y) { return x.log_odds > y.log_odds; });
}

void PoseGraph::add(const CandidateLink& link, const PointMoments& points_b, double voxel_m) {
  add(link);
  links_.at({link.a, link.b}).rank(points_b, voxel_m);
}

std::vector<StartPose> PoseGraph::start_poses(std::size_t scan, const std::vector<bool>& placed,
                                              const std::vector<Eigen::Isometry3d>& T_reference_scan,
                                              const PointMoments& points, double same_m) const {
  std::vector<std::pair<double, Eigen::Isometry3d>> singles;
  for_each_link(scan, placed, [&](std::size_t other, const CandidateLink& link) {
    for (const auto& h : link.hypotheses)
      singles.emplace_back(-link.log_odds(h), T_reference_scan[other] * link.T_other(scan, h));
  });
  std::stable_sort(singles.begin(), singles.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<StartPose> poses;  // each as its likeliest link has it
  std::vector<Eigen::Isometry3d> T = T_reference_scan;
  for (const auto& [minus_log_odds, pose] : singles) {
    const bool known = std::any_of(poses.begin(), poses.end(), [&, &pose = pose](const StartPose& p) {
      return rms_displacement(p.T_reference_scan.inverse() * pose, points) < same_m;
    });
    if (known) continue;
    T[scan] = pose;
    poses.push_back(support(scan, placed, T, points, same_m));
  }
  std::stable_sort(poses.begin(), poses.end(),
                   [](const StartPose& x, const StartPose& y) { return x.log_odds > y.log_odds; });
  return poses;
}

StartPose PoseGraph::support(std::size_t scan, const std::vector<bool>& placed,
                             const std::vector<Eigen::Isometry3d>& T_reference_scan, const PointMoments& points,
                             double same_m) const {
  StartPose out{T_reference_scan[scan], 0, 0};
  for_each_link(scan, placed, [&](std::size_t other, const CandidateLink& link) {
    double here = 0, elsewhere = 0;
    bool leads_here = false;
    for (const auto& h : link.hypotheses) {
      const Eigen::Isometry3d T = T_reference_scan[other] * link.T_other(scan, h);
      const bool same = rms_displacement(out.T_reference_scan.inverse() * T, points) < same_m;
      leads_here = leads_here || same;
      double& side = same ? here : elsewhere;
      side = std::max(side, link.log_odds(h));
    }
    out.log_odds += here - std::max(0.0, elsewhere - std::max(here, kDoubtLogOdds));
    out.num_links += leads_here ? 1 : 0;
  });
  return out;
}

std::size_t PoseGraph::num_hypotheses(std::size_t scan, const std::vector<bool>& placed) const {
  std::size_t count = 0;
  for_each_link(scan, placed, [&](std::size_t, const CandidateLink& link) { count += link.hypotheses.size(); });
  return count;
}

std::vector<bool> PoseGraph::outside_of_largest_group() const {
  const auto n = static_cast<Eigen::Index>(num_scans_);
  Eigen::MatrixXd measure = Eigen::MatrixXd::Ones(n, n);
  for (const auto& [pair, link] : links_) {
    const bool clear = !link.hypotheses.empty() && link.hypotheses.front().log_odds >= kClearLogOdds;
    const auto row = static_cast<Eigen::Index>(pair.first), column = static_cast<Eigen::Index>(pair.second);
    if (clear) measure(row, column) = measure(column, row) = 0;
  }
  const CorrespondenceGraph groups = build_correspondence_graph(measure, 1.0);
  std::vector<std::size_t> sizes(groups.num_components, 0);
  for (const std::size_t c : groups.component) ++sizes[c];
  const auto largest = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<bool> outside(num_scans_);
  for (std::size_t i = 0; i < num_scans_; ++i) outside[i] = groups.component[i] != largest;
  return outside;
}

CorrespondenceGraph PoseGraph::correspondence_graph(const std::vector<bool>& wanted) const {
  const auto n = static_cast<Eigen::Index>(num_scans_);
  Eigen::MatrixXd measure = Eigen::MatrixXd::Ones(n, n);
  for (const auto& [pair, link] : links_) {
    const auto [a, b] = pair;
    if (!wanted[a] || !wanted[b] || link.hypotheses.empty() || link.log_odds(link.hypotheses.front()) <= 0) continue;
    const double probability = 1 / (1 + std::exp(-link.log_odds(link.hypotheses.front())));
    const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
    measure(row, column) = measure(column, row) = 1 - probability;
  }
  return build_correspondence_graph(measure, 1.0);
}

}  // namespace tcm_icp
