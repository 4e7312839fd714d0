#include "tcm_icp/coarse/slide_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "tcm_icp/coarse/slide_axes.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

constexpr double kMinAcrossCosine = 0.7;  // 45 degrees: what faces along the slide rather than aside
constexpr std::int64_t kLongest = 4096;   // voxels either way
constexpr std::int64_t kAbout = 15;       // voxels either way: the lengths about one
constexpr std::int64_t kDistinct = 4;     // voxels between two candidates
constexpr std::int64_t kSame = 2;         // voxels from the pose that is known
constexpr double kMinScore = 5, kLeastVotes = 4;

// What lies across the slide.
struct Across {
  double along;     ///< [voxels]
  VoxelKey column;  ///< x: what it is, and the side that was seen
};

constexpr double kBorder = 2;  // columns of borders are not those of surfaces

void add_across(const Points& points, const Points& directions, const Eigen::Isometry3d& T, const Eigen::Matrix3d& axes,
                double voxel_m, double kind, bool sided, std::vector<Across>& out) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double cosine = (T.linear() * directions[i]).dot(axes.col(0));
    if (std::abs(cosine) < kMinAcrossCosine) continue;
    const Eigen::Vector3d p = axes.transpose() * (T * points[i]) / voxel_m;
    out.push_back({p.x(), voxel_key({kind + (sided && cosine < 0 ? 1 : 0), p.y(), p.z()}, 1)});
  }
}

std::vector<Across> across(const SlideMarks& marks, const Eigen::Isometry3d& T, const Eigen::Matrix3d& axes,
                           double voxel_m, bool sided) {
  std::vector<Across> out;
  add_across(marks.surfaces.points, marks.surfaces.normals, T, axes, voxel_m, 0, sided, out);
  add_across(marks.borders.points, marks.borders.normals, T, axes, voxel_m, kBorder, true, out);
  return out;
}

// Votes by the length of the slide in voxels, from -kLongest on.
std::vector<double> count_votes(const std::vector<Across>& target, const std::vector<Across>& source) {
  std::unordered_map<VoxelKey, std::vector<double>, VoxelKeyHash> columns;
  for (const auto& p : target) columns[p.column].push_back(p.along);
  std::vector<double> votes(static_cast<std::size_t>(2 * kLongest + 1), 0.0);
  for (const auto& p : source) {
    for (std::int64_t near = 0; near < 9; ++near) {
      const auto column = columns.find({p.column.x, p.column.y + near % 3 - 1, p.column.z + near / 3 - 1});
      if (column == columns.end()) continue;
      for (const double x : column->second) {
        const double length = x - p.along;
        // A vote is shared by the two whole lengths about it.
        const double low = std::floor(length), part = length - low;
        if (!(std::abs(low) < kLongest - 1)) continue;
        const auto k = static_cast<std::size_t>(static_cast<std::int64_t>(low) + kLongest);
        votes[k] += 1 - part;
        votes[k + 1] += part;
      }
    }
  }
  return votes;
}

// How far each length stands out from those about it.
std::vector<double> stand_out(const std::vector<double>& votes) {
  std::vector<double> sums(votes.size() + 1, 0.0);
  for (std::size_t k = 0; k < votes.size(); ++k) sums[k + 1] = sums[k] + votes[k];
  std::vector<double> scores(votes.size(), 0.0);
  const auto size = static_cast<std::int64_t>(votes.size());
  for (std::int64_t k = 0; k < size; ++k) {
    const auto first = static_cast<std::size_t>(std::max<std::int64_t>(0, k - kAbout));
    const auto end = static_cast<std::size_t>(std::min(size, k + kAbout + 1));
    const double about = (sums[end] - sums[first]) / static_cast<double>(end - first);
    const auto at = static_cast<std::size_t>(k);
    scores[at] = (votes[at] - about) / std::sqrt(about + kLeastVotes);
  }
  return scores;
}

}  // namespace

std::vector<PoseCandidate> slide_candidates(const SlideMarks& target, const SlideMarks& source,
                                            const Eigen::Isometry3d& T_target_source, double voxel_m,
                                            std::size_t max_candidates) {
  const Eigen::Matrix3d axes = slide_axes(target.surfaces.normals, source.surfaces.normals, T_target_source.linear());
  const bool sided = target.sides == NormalSides::kSeen && source.sides == NormalSides::kSeen;
  const std::vector<double> scores =
      stand_out(count_votes(across(target, Eigen::Isometry3d::Identity(), axes, voxel_m, sided),
                            across(source, T_target_source, axes, voxel_m, sided)));

  std::vector<std::int64_t> lengths;
  for (std::int64_t length = -kLongest; length <= kLongest; ++length) {
    const double score = scores[static_cast<std::size_t>(length + kLongest)];
    if (std::abs(length) > kSame && score >= kMinScore) lengths.push_back(length);
  }
  const auto score_of = [&](std::int64_t length) { return scores[static_cast<std::size_t>(length + kLongest)]; };
  std::stable_sort(lengths.begin(), lengths.end(),
                   [&](std::int64_t a, std::int64_t b) { return score_of(a) > score_of(b); });
  std::vector<std::int64_t> kept;
  for (const std::int64_t length : lengths) {
    if (kept.size() == max_candidates) break;
    if (std::none_of(kept.begin(), kept.end(),
                     [&](std::int64_t other) { return std::abs(other - length) < kDistinct; })) {
      kept.push_back(length);
    }
  }
  std::vector<PoseCandidate> out;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Eigen::Vector3d shift = static_cast<double>(kept[k]) * voxel_m * axes.col(0);
    const double rival = kept.size() == 1 ? kMinScore : score_of(kept[k == 0 ? 1 : 0]);
    out.push_back({Eigen::Translation3d(shift) * T_target_source, CoarseMethod::kSlide, score_of(kept[k]),
                   score_of(kept[k]) / rival});
  }
  return out;
}

}  // namespace tcm_icp
