#include "consensus.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rigid_fit.hpp"

namespace tcm_icp {
namespace {

constexpr int kRefits = 2;
constexpr float kMinNormalCosine = 0.866F;  // 30 degrees: the normals of coarse voxels are no better
constexpr std::size_t kMinMembers = 3;

struct Edge {
  std::uint32_t other;
  int common;
};

// Calls visit(match) for those that hold, and gives their votes.
template <typename Visit>
float for_each_holding(const MatchedPoints& matches, const Eigen::Isometry3f& T, const ConsensusOptions& options,
                       Visit visit) {
  const Eigen::Matrix3f R = T.linear();
  const Eigen::Vector3f t = T.translation();
  const float tolerance2 = options.tolerance * options.tolerance;
  float votes = 0;
  for (Eigen::Index m = 0; m < matches.size(); ++m) {
    const float squared = (R * matches.source.col(m) + t - matches.target.col(m)).squaredNorm();
    if (squared > tolerance2) continue;
    if (std::abs((R * matches.source_normal.col(m)).dot(matches.target_normal.col(m))) < kMinNormalCosine) continue;
    votes += 1 - squared / tolerance2;
    visit(m);
  }
  return votes;
}

class Search {
 public:
  Search(const MatchedPoints& matches, const ConsensusOptions& options)
      : matches_(matches),
        options_(options),
        graph_(matches, options.tolerance, options.min_length, options.normal_tolerance) {}

  std::vector<ConsensusPose> run() {
    count_triangles();
    std::vector<std::uint32_t> seeds(graph_.size());
    std::iota(seeds.begin(), seeds.end(), 0U);
    std::sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
      return triangles_[a] != triangles_[b] ? triangles_[a] > triangles_[b] : a < b;
    });
    std::vector<char> used(graph_.size(), 0);
    std::vector<ConsensusPose> poses;
    for (const std::uint32_t seed : seeds) {
      if (poses.size() == options_.max_poses || triangles_[seed] == 0) break;
      if (used[seed]) continue;
      used[seed] = 1;
      ConsensusPose pose;
      if (!pose_of(seed, pose)) continue;
      for (const std::uint32_t m : holding_) used[m] = 1;
      poses.push_back(pose);
    }
    std::stable_sort(poses.begin(), poses.end(),
                     [](const ConsensusPose& a, const ConsensusPose& b) { return a.votes > b.votes; });
    return poses;
  }

 private:
  void count_triangles() {
    triangles_.assign(graph_.size(), 0);
    for (std::size_t i = 0; i < graph_.size(); ++i) {
      graph_.for_each_neighbor(i, [&](std::size_t j) {
        if (j <= i) return;
        const int common = graph_.num_common(i, j);
        triangles_[i] += common;
        triangles_[j] += common;
      });
    }
  }

  // Those that close triangles, the most first. Counted again for the few that are asked, not kept for all.
  std::vector<Edge> edges_of(std::uint32_t match) const {
    std::vector<Edge> edges;
    graph_.for_each_neighbor(match, [&](std::size_t other) {
      const int common = graph_.num_common(match, other);
      if (common > 0) edges.push_back({static_cast<std::uint32_t>(other), common});
    });
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return a.common != b.common ? a.common > b.common : a.other < b.other;
    });
    return edges;
  }

  bool pose_of(std::uint32_t seed, ConsensusPose& pose) {
    const std::vector<Edge> edges = edges_of(seed);
    std::vector<std::uint32_t> members{seed};
    std::vector<float> weights{static_cast<float>(edges.empty() ? 1 : edges.front().common)};
    for (const Edge& e : edges) {
      if (members.size() == options_.max_members || 2 * e.common < edges.front().common) break;
      members.push_back(e.other);
      weights.push_back(static_cast<float>(e.common));
    }
    if (members.size() < kMinMembers) return false;
    pose.T_target_source = fit_rigid(matches_, members, weights);
    collect_holding(pose);
    for (int k = 0; k < kRefits && holding_.size() >= kMinMembers; ++k) {
      ConsensusPose next{fit_rigid(matches_, holding_, {}), 0};
      const std::vector<std::uint32_t> before = holding_;
      collect_holding(next);
      if (next.votes <= pose.votes) {
        holding_ = before;
        break;
      }
      pose = next;
    }
    return holding_.size() >= kMinMembers;
  }

  void collect_holding(ConsensusPose& pose) {
    holding_.clear();
    pose.votes = for_each_holding(matches_, pose.T_target_source, options_,
                                  [&](Eigen::Index m) { holding_.push_back(static_cast<std::uint32_t>(m)); });
  }

  const MatchedPoints& matches_;
  const ConsensusOptions& options_;
  CompatibilityGraph graph_;
  std::vector<int> triangles_;
  std::vector<std::uint32_t> holding_;
};

}  // namespace

float count_votes(const MatchedPoints& matches, const Eigen::Isometry3f& T_target_source,
                  const ConsensusOptions& options) {
  return for_each_holding(matches, T_target_source, options, [](Eigen::Index) {});
}

std::vector<ConsensusPose> find_consensus(const MatchedPoints& matches, const ConsensusOptions& options) {
  if (matches.size() < static_cast<Eigen::Index>(kMinMembers)) return {};
  return Search(matches, options).run();
}

}  // namespace tcm_icp
