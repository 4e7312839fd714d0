#include "pose_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/registration/alignment_objective.hpp"
#include "tcm_icp/registration/refinement.hpp"

namespace tcm_icp {
namespace {

constexpr int kReach = 6;  // grid steps to either side: 24 coarse voxels
constexpr int kSide = 2 * kReach + 1;
constexpr std::size_t kGridPoints = 200, kMaxMinima = 3;
constexpr std::size_t kWalkPoints = 300;
constexpr double kFirstWalkStep = 8, kLastWalkStep = 0.5;  // in coarse voxels

/// Costs over the grid, by steps along its two axes.
class CostGrid {
 public:
  double& at(int i, int j) { return costs_[static_cast<std::size_t>((i + kReach) * kSide + (j + kReach))]; }

  bool is_local_minimum(int i, int j) {
    for (int di = -1; di <= 1; ++di) {
      for (int dj = -1; dj <= 1; ++dj) {
        const bool inside = std::abs(i + di) <= kReach && std::abs(j + dj) <= kReach;
        if (inside && at(i + di, j + dj) < at(i, j)) return false;
      }
    }
    return true;
  }

 private:
  std::array<double, static_cast<std::size_t>(kSide* kSide)> costs_{};
};

std::pair<Eigen::Vector3d, Eigen::Vector3d> weakest_translations(const Cloud& surfaces, const Eigen::Isometry3d& T) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& n : surfaces.normals) {
    const Eigen::Vector3d moved = T.linear() * n;
    sum += moved * moved.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(sum);
  return {axes.eigenvectors().col(0), axes.eigenvectors().col(1)};
}

}  // namespace

std::vector<Eigen::Isometry3d> other_minima(const Cloud& points, const Cloud& surfaces, const ScanPyramid& merged,
                                            const Eigen::Isometry3d& T) {
  const double voxel_m = merged.level(0).voxel_size_m, step_m = kSearchGridStep * voxel_m;
  const Cloud sample = even_sample(points, kGridPoints);
  const AlignmentObjective objective(sample, merged.level_for(2 * voxel_m), voxel_m, step_m);
  const auto [u, v] = weakest_translations(surfaces, T);
  const auto pose = [&, u = u, v = v](int i, int j) {
    return Eigen::Isometry3d(Eigen::Translation3d(step_m * (i * u + j * v)) * T);
  };
  CostGrid grid;
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) grid.at(i, j) = objective.cost(pose(i, j));
  }
  std::vector<std::pair<double, Eigen::Isometry3d>> minima;
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      const bool own = std::abs(i) <= 1 && std::abs(j) <= 1;
      if (!own && grid.is_local_minimum(i, j)) minima.emplace_back(grid.at(i, j), pose(i, j));
    }
  }
  std::stable_sort(minima.begin(), minima.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::Isometry3d> out;
  for (std::size_t k = 0; k < std::min(minima.size(), kMaxMinima); ++k) out.push_back(minima[k].second);
  return out;
}

Eigen::Isometry3d search_by_annealing(const Cloud& points, const Cloud& held_out, const ScanPyramid& merged,
                                      const Eigen::Isometry3d& T_init, const PipelineOptions& options, Rng& rng) {
  const double voxel_m = merged.level(0).voxel_size_m;
  const Cloud walked = even_sample(points, kWalkPoints), kept = even_sample(held_out, kWalkPoints);
  const PyramidLevel& level = merged.level_for(2 * voxel_m);
  const AlignmentObjective cost(walked, level, voxel_m, kSearchGridStep * voxel_m);
  const AlignmentObjective held_out_cost(kept, level, voxel_m, kSearchGridStep * voxel_m);
  AnnealingOptions annealing;
  annealing.initial_step_m = kFirstWalkStep * voxel_m;
  annealing.final_step_m = kLastWalkStep * voxel_m;
  annealing.num_steps = options.placement.search_steps;
  annealing.initial_temperature = options.refinement.initial_temperature;
  annealing.final_temperature = options.refinement.final_temperature;
  return anneal([&](const Eigen::Isometry3d& T) { return cost.cost(T); },
                [&](const Eigen::Isometry3d& T) { return held_out_cost.cost(T); }, twist_frame(walked.points, T_init),
                T_init, annealing, rng)
      .T_target_source;
}

}  // namespace tcm_icp
