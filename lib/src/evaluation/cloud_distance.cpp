#include "tcm_icp/evaluation/cloud_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Estimates = std::vector<std::optional<Isometry3d>>;

void append_moved(const Points& points, const Isometry3d& T, Points& out) {
  for (const auto& p : points) out.push_back(T * p);
}

double rms_of_some(const Points& a, const Points& b, std::size_t count, Rng& rng) {
  const auto chosen = sample_indices(rng, a.size(), count);
  double sum = 0;
  for (const std::size_t i : chosen) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(chosen.size()));
}

}  // namespace

DirectedDistance directed_distance(const Points& from, const Points& to, int num_threads) {
  if (from.empty() || to.empty()) throw InvalidInput("cloud distance: a cloud has no points");
  const NeighborIndex index(to);
  std::vector<double> distances_m(from.size());
  parallel_for(num_threads, from.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) distances_m[i] = std::sqrt(index.nearest(from[i]).squared_distance_m2);
  });
  const double n = static_cast<double>(from.size());
  DirectedDistance out;
  out.num_points = from.size();
  out.mean_m = std::accumulate(distances_m.begin(), distances_m.end(), 0.0) / n;
  double squares = 0;
  for (const double d : distances_m) squares += (d - out.mean_m) * (d - out.mean_m);
  out.std_dev_m = std::sqrt(squares / n);
  out.max_m = *std::max_element(distances_m.begin(), distances_m.end());
  if (!std::isfinite(out.max_m)) throw InvalidInput("cloud distance: a coordinate is not finite");
  return out;
}

CloudComparison compare_clouds(const Truth& truth, const Estimates& estimates, std::size_t reference,
                               const std::vector<Points>& points, std::size_t rms_points, Rng& rng, int num_threads) {
  const std::size_t n = truth.scans.size();
  if (estimates.size() != n || points.size() != n) throw InvalidInput("cloud distance: lists differ in length");
  if (reference >= n || !estimates[reference]) throw InvalidInput("cloud distance: the reference scan has no pose");
  const Isometry3d T_reference_world = truth.scans[reference].T_world_scan.inverse(Eigen::Affine);
  const Isometry3d T_reference_any = estimates[reference]->inverse(Eigen::Affine);
  Points registered, belonging, truth_cloud;
  for (std::size_t i = 0; i < n; ++i) {
    if (truth.scans[i].group != truth.scans[reference].group) continue;
    const Isometry3d T_true = T_reference_world * truth.scans[i].T_world_scan;
    append_moved(points[i], T_true, truth_cloud);
    if (!estimates[i]) continue;
    append_moved(points[i], T_true, belonging);
    append_moved(points[i], T_reference_any * *estimates[i], registered);
  }
  CloudComparison out;
  out.num_points = std::min(rms_points, registered.size());
  out.registered_to_truth = directed_distance(registered, truth_cloud, num_threads);
  out.truth_to_registered = directed_distance(truth_cloud, registered, num_threads);
  out.rms_m = rms_of_some(registered, belonging, rms_points, rng);
  return out;
}

std::vector<std::size_t> share_out(std::size_t total, const std::vector<std::uint64_t>& num_points) {
  const double sum = static_cast<double>(std::accumulate(num_points.begin(), num_points.end(), std::uint64_t{0}));
  std::vector<std::size_t> counts(num_points.begin(), num_points.end());
  if (sum <= static_cast<double>(total)) return counts;
  std::vector<std::pair<double, std::size_t>> fractions;  // negative: the largest comes first, of equal ones the first
  std::size_t given = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double exact = static_cast<double>(total) * static_cast<double>(num_points[i]) / sum;
    counts[i] = static_cast<std::size_t>(exact);
    given += counts[i];
    fractions.emplace_back(static_cast<double>(counts[i]) - exact, i);
  }
  std::sort(fractions.begin(), fractions.end());
  for (std::size_t i = 0; given < total && i < fractions.size(); ++i, ++given) ++counts[fractions[i].second];
  return counts;
}

}  // namespace tcm_icp
