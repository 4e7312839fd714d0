#include "tcm_icp/core/normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/tie.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// A neighbourhood whose second axis is shorter than this share of its first is a line: one ring of a spinning scanner.
constexpr double kMinAxisRatio = 0.2;
constexpr std::size_t kSpacingSamples = 2000;

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double roughness_m = 0;
  double variation = 0;
  bool is_line = true;
};

Plane fit_plane(const Points& points, const std::vector<Neighbor>& neighbors) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& n : neighbors) mean += points[n.index];
  mean /= static_cast<double>(neighbors.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& n : neighbors) {
    const Eigen::Vector3d d = points[n.index] - mean;
    covariance += d * d.transpose();
  }
  covariance /= static_cast<double>(neighbors.size());
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);  // closed form; ascending eigenvalues
  const Eigen::Vector3d values = solver.eigenvalues().cwiseMax(0);
  Plane plane;
  plane.is_line = !(values[1] > kMinAxisRatio * kMinAxisRatio * values[2]);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.allFinite()) plane.normal = normal.normalized();
  plane.roughness_m = std::sqrt(values[0]);
  plane.variation = values[0] / values.sum();
  return plane;
}

// A query whose neighbours are known: those of the next lie no farther from it than from here to there and back.
struct Queried {
  Eigen::Vector3d query;
  double radius_m = std::numeric_limits<double>::infinity();
};

// The k nearest, and those as far as the last of them: which of equals is taken would turn the normal.
void nearest_k_and_ties(const NeighborIndex& index, const Eigen::Vector3d& query, std::size_t k, Queried& before,
                        std::vector<Neighbor>& out) {
  if (std::isfinite(before.radius_m)) {
    index.nearest_k_within(query, k + 1, (before.radius_m + (query - before.query).norm()) * (1 + kTieShare), out);
  } else {
    index.nearest_k(query, k + 1, out);
  }
  if (out.size() <= k) return;
  before = {query, std::sqrt(out[k].squared_distance_m2)};
  const double last = out[k - 1].squared_distance_m2;
  if (clearly_less(last, out[k].squared_distance_m2)) {
    out.pop_back();
  } else if (last > 0) {  // copies of the point itself are all the same
    index.within(query, std::sqrt(last * (1 + kTieShare)), out);
  }
}

}  // namespace

void NormalOptions::validate() const {
  if (min_neighbors < 3) {
    throw InvalidOptions("min_neighbors is " + std::to_string(min_neighbors) + "; it must be at least 3");
  }
  if (max_neighbors < min_neighbors) {
    throw InvalidOptions("max_neighbors is " + std::to_string(max_neighbors) + "; it must be at least min_neighbors (" +
                         std::to_string(min_neighbors) + ")");
  }
}

NormalEstimate estimate_normals_at(const Points& queries, const Points& points, const NeighborIndex& index,
                                   const NormalOptions& options, int num_threads) {
  options.validate();
  NormalEstimate out{Points(queries.size(), Eigen::Vector3d::Zero()), std::vector<double>(queries.size(), 0.0),
                     std::vector<double>(queries.size(), 0.0)};
  parallel_for(num_threads, queries.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> neighbors;
    std::map<int, Queried> before;  // by k
    for (std::size_t i = begin; i < end; ++i) {
      Plane plane;
      for (int k = options.min_neighbors; plane.is_line; k = std::min(2 * k, options.max_neighbors)) {
        nearest_k_and_ties(index, queries[i], static_cast<std::size_t>(k), before[k], neighbors);
        if (neighbors.size() < 3) break;
        plane = fit_plane(points, neighbors);
        if (k == options.max_neighbors) break;
      }
      if (plane.is_line) continue;
      out.normals[i] = plane.normal;
      out.roughness_m[i] = plane.roughness_m;
      out.variation[i] = plane.variation;
    }
  });
  return out;
}

NormalEstimate estimate_normals(const Points& points, const NeighborIndex& index, const NormalOptions& options,
                                int num_threads) {
  return estimate_normals_at(points, points, index, options, num_threads);
}

double median_spacing(const Points& points, const NeighborIndex& index) {
  if (points.size() < 2) return 0;
  std::vector<double> distances;
  std::vector<Neighbor> neighbors;
  for (const auto& p : even_sample(points, kSpacingSamples)) {
    index.nearest_k(p, 2, neighbors);
    distances.push_back(std::sqrt(neighbors.back().squared_distance_m2));
  }
  return median(distances);
}

}  // namespace tcm_icp
