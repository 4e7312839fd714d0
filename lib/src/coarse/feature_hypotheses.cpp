#include "feature_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "consensus.hpp"
#include "tcm_icp/coarse/feature_matching.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

// Poses closer than this lead to the same place: the basin of the fine registration, generously.
constexpr double kSameRotation_rad = 0.26;
constexpr double kSameDisplacementVoxels = 4;
// Agreement of a checked point, in voxels of the level it is checked at.
constexpr double kCheckGateVoxels = 2;
constexpr double kCheckToleranceVoxels = 0.5;
constexpr double kCheckNormalCosine = 0.94;

// Matches of one level in voxels, each scan about its own middle, so that floats hold the coordinates.
struct LevelMatches {
  double voxel_m = 0;
  MatchedPoints points;
  ConsensusOptions options;
  Eigen::Vector3d target_middle = Eigen::Vector3d::Zero(), source_middle = Eigen::Vector3d::Zero();

  Eigen::Isometry3d to_frames(const Eigen::Isometry3f& T) const {
    Eigen::Isometry3d in_metres = T.cast<double>();
    in_metres.translation() *= voxel_m;
    return Eigen::Translation3d(target_middle) * in_metres * Eigen::Translation3d(-source_middle);
  }
  Eigen::Isometry3f to_middles(const Eigen::Isometry3d& T) const {
    Eigen::Isometry3d in_voxels = Eigen::Translation3d(-target_middle) * T * Eigen::Translation3d(source_middle);
    in_voxels.translation() /= voxel_m;
    return in_voxels.cast<float>();
  }
};

Eigen::Vector3d middle(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return points.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(points.size()));
}

LevelMatches match_level(const ScanFeatures& target, const ScanFeatures& source,
                         const FeatureAlignmentOptions& options) {
  const auto matches = match_features(target.descriptors, source.descriptors);
  const auto count = static_cast<Eigen::Index>(matches.size());
  LevelMatches out;
  out.voxel_m = target.voxel_size_m;
  out.target_middle = middle(target.keypoints.points);
  out.source_middle = middle(source.keypoints.points);
  out.options.tolerance = static_cast<float>(options.tolerance_voxels);
  out.options.min_length = static_cast<float>(options.min_length_voxels);
  out.options.normal_tolerance = static_cast<float>(options.max_normal_cosine_difference);
  out.options.max_poses = static_cast<std::size_t>(options.max_hypotheses);
  for (auto* m : {&out.points.target, &out.points.source, &out.points.target_normal, &out.points.source_normal}) {
    m->resize(3, count);
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const FeatureMatch& m = matches[static_cast<std::size_t>(k)];
    out.points.target.col(k) = ((target.keypoints.points[m.target] - out.target_middle) / out.voxel_m).cast<float>();
    out.points.source.col(k) = ((source.keypoints.points[m.source] - out.source_middle) / out.voxel_m).cast<float>();
    out.points.target_normal.col(k) = target.keypoints.normals[m.target].cast<float>();
    out.points.source_normal.col(k) = source.keypoints.normals[m.source].cast<float>();
  }
  return out;
}

struct CheckCounts {
  std::size_t near = 0, agreeing = 0;
};

CheckCounts check_one_way(const Cloud& sample, const PyramidLevel& target, const Eigen::Isometry3d& T) {
  CheckCounts counts;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Eigen::Vector3d p = T * sample.points[i];
    const Neighbor q = target.index.nearest_within(p, kCheckGateVoxels * target.voxel_size_m);
    if (!q.found()) continue;
    ++counts.near;
    const Eigen::Vector3d& normal = target.cloud.normals[q.index];
    if (std::abs((T.linear() * sample.normals[i]).dot(normal)) >= kCheckNormalCosine &&
        std::abs(normal.dot(p - target.cloud.points[q.index])) <= kCheckToleranceVoxels * target.voxel_size_m) {
      ++counts.agreeing;
    }
  }
  return counts;
}

void check(const FeatureView& target, const FeatureView& source, FeatureHypothesis& h) {
  const Cloud& a = target.described.check_sample;
  const Cloud& b = source.described.check_sample;
  const CheckCounts to = check_one_way(b, target.pyramid.level(1), h.T_target_source);
  const CheckCounts fro = check_one_way(a, source.pyramid.level(1), h.T_target_source.inverse());
  const auto near = static_cast<double>(to.near + fro.near);
  h.overlap = near / static_cast<double>(std::max<std::size_t>(1, a.size() + b.size()));
  h.agreement = near > 0 ? static_cast<double>(to.agreeing + fro.agreeing) / near : 0;
}

// Keeps the first of those that lead to the same place.
std::vector<FeatureHypothesis> distinct(std::vector<FeatureHypothesis> sorted, const Points& source, double voxel_m) {
  std::vector<FeatureHypothesis> out;
  for (auto& h : sorted) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const FeatureHypothesis& other) {
      const Eigen::Isometry3d E = other.T_target_source.inverse() * h.T_target_source;
      return rotation_angle_rad(E.linear()) < kSameRotation_rad &&
             rms_displacement(E, source) < kSameDisplacementVoxels * voxel_m;
    });
    if (!known) out.push_back(std::move(h));
  }
  return out;
}

}  // namespace

double FeatureHypothesis::total_votes() const { return std::accumulate(votes.begin(), votes.end(), 0.0); }

double FeatureHypothesis::score() const { return total_votes() * std::sqrt(agreement * overlap); }

std::vector<FeatureHypothesis> feature_hypotheses(const FeatureView& target, const FeatureView& source,
                                                  const FeatureAlignmentOptions& options) {
  std::vector<LevelMatches> levels;
  for (std::size_t l = 0; l < options.levels.size(); ++l) {
    levels.push_back(match_level(target.described.levels[l], source.described.levels[l], options));
  }
  std::vector<FeatureHypothesis> all;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    for (const auto& pose : find_consensus(levels[l].points, levels[l].options)) {
      FeatureHypothesis h;
      h.T_target_source = levels[l].to_frames(pose.T_target_source);
      h.level = l;
      for (const auto& m : levels) h.votes.push_back(count_votes(m.points, m.to_middles(h.T_target_source), m.options));
      all.push_back(std::move(h));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.total_votes() > b.total_votes(); });
  const double coarsest_m = target.described.levels.front().voxel_size_m;
  all = distinct(std::move(all), source.described.check_sample.points, coarsest_m);
  all.resize(std::min(all.size(), 2 * static_cast<std::size_t>(options.max_candidates)));
  for (auto& h : all) check(target, source, h);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score() > b.score(); });
  return all;
}

}  // namespace tcm_icp
