// Nearest neighbours of a street scan: NeighborIndex against nanoflann and PCL's KdTreeFLANN, on one thread.
//
// Arguments are the number of points. A query benchmark asks 100,000 queries an iteration; its counters are the time of
// one query and the mean distance of what was found, which must agree between the libraries.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "neighbor_adapters.hpp"
#include "street_scan.hpp"
#include "tcm_icp/core/grid_index.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kNumQueries = 100'000, kNumNeighbors = 16;

struct Workload {
  Points points;
  Points near_queries;   ///< points moved by noise of 5 cm an axis: a registration that has nearly converged
  Points moved_queries;  ///< points moved rigidly by 5 degrees and 0.5 m: a registration that begins
};

Workload make_workload(std::size_t count) {
  Eigen::Isometry3d T_world_scanner = Eigen::Isometry3d::Identity();
  T_world_scanner.translation().z() = 2;
  Workload out;
  out.points = street_scan(T_world_scanner, count, 1);
  Rng rng = make_stream(2, "benchmark queries");
  const double angle_rad = 5 * std::acos(-1.0) / 180;
  Twist start;
  start << Eigen::Vector3d(1, -2, 3).normalized() * angle_rad, Eigen::Vector3d(2, 2, 1).normalized() * 0.5;
  const Eigen::Isometry3d T = isometry_from_twist(start);
  for (const std::size_t i : sample_indices(rng, out.points.size(), kNumQueries)) {
    const Eigen::Vector3d noise(standard_normal(rng), standard_normal(rng), standard_normal(rng));
    out.near_queries.push_back(out.points[i] + 0.05 * noise);
    out.moved_queries.push_back(T * out.points[i]);
  }
  return out;
}

const Workload& workload(std::size_t count) {
  static std::map<std::size_t, Workload> made;
  const auto it = made.find(count);
  return it != made.end() ? it->second : made.emplace(count, make_workload(count)).first->second;
}

// Asks every query, `ask` giving the distance [m] of its answer, negative where it found none.
template <typename Ask>
void run_queries(benchmark::State& state, const Points& queries, Ask ask) {
  double sum_m = 0;
  std::size_t found = 0;
  for (auto _ : state) {
    sum_m = 0;
    found = 0;
    for (const auto& q : queries) {
      const double distance_m = ask(q);
      if (distance_m < 0) continue;
      sum_m += distance_m;
      ++found;
    }
  }
  const auto asked = static_cast<double>(queries.size());
  state.counters["mean_distance_mm"] = 1000 * sum_m / static_cast<double>(std::max<std::size_t>(found, 1));
  state.counters["found"] = static_cast<double>(found) / asked;
  state.counters["time_per_query"] =
      benchmark::Counter(asked, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <typename Index>
void build(benchmark::State& state) {
  const Points& points = workload(static_cast<std::size_t>(state.range(0))).points;
  for (auto _ : state) {
    Index index(points);
    benchmark::DoNotOptimize(&index);
  }
}

template <typename Index>
void nearest(benchmark::State& state) {
  const Workload& work = workload(static_cast<std::size_t>(state.range(0)));
  const Index index(work.points);
  run_queries(state, work.near_queries, [&](const auto& q) { return index.nearest(q); });
}

template <typename Index>
void nearest_of_moved(benchmark::State& state) {
  const Workload& work = workload(static_cast<std::size_t>(state.range(0)));
  const Index index(work.points);
  run_queries(state, work.moved_queries, [&](const auto& q) { return index.nearest(q); });
}

template <typename Index>
void nearest_within_0_3_m_of_moved(benchmark::State& state) {
  const Workload& work = workload(static_cast<std::size_t>(state.range(0)));
  const Index index(work.points);
  run_queries(state, work.moved_queries, [&](const auto& q) { return index.nearest_within(q, 0.3); });
}

template <typename Index>
void nearest_16(benchmark::State& state) {
  const Workload& work = workload(static_cast<std::size_t>(state.range(0)));
  Index index(work.points);
  run_queries(state, work.near_queries, [&](const auto& q) { return index.farthest_of_nearest_k(q, kNumNeighbors); });
}

constexpr double kVoxel_m = 0.25;

// As a pair is fitted and measured: among voxel-sampled points, where the scans lie near and where they do not yet.
template <typename Search>
void within_two_voxels(benchmark::State& state, const Points& of, const Search& search) {
  run_queries(state, voxel_downsample({of, {}}, kVoxel_m).points, [&](const auto& q) {
    const Neighbor found = search.nearest_within(q, 2 * kVoxel_m);
    return found.found() ? std::sqrt(found.squared_distance_m2) : -1;
  });
}

Points voxel_sample() { return voxel_downsample({workload(1'000'000).points, {}}, kVoxel_m).points; }

void near_in_voxels_by_tree(benchmark::State& state) {
  within_two_voxels(state, workload(1'000'000).near_queries, NeighborIndex(voxel_sample()));
}
void near_in_voxels_by_grid(benchmark::State& state) {
  within_two_voxels(state, workload(1'000'000).near_queries, GridIndex(voxel_sample(), 5 * kVoxel_m));
}
void moved_in_voxels_by_tree(benchmark::State& state) {
  within_two_voxels(state, workload(1'000'000).moved_queries, NeighborIndex(voxel_sample()));
}
void moved_in_voxels_by_grid(benchmark::State& state) {
  within_two_voxels(state, workload(1'000'000).moved_queries, GridIndex(voxel_sample(), 5 * kVoxel_m));
}
void build_tree_of_voxels(benchmark::State& state) {
  const Points points = voxel_sample();
  for (auto _ : state) {
    NeighborIndex index(points);
    benchmark::DoNotOptimize(&index);
  }
}
void build_grid_of_voxels(benchmark::State& state) {
  const Points points = voxel_sample();
  for (auto _ : state) {
    GridIndex index(points, 5 * kVoxel_m);
    benchmark::DoNotOptimize(&index);
  }
}
BENCHMARK(near_in_voxels_by_tree)->Unit(benchmark::kMillisecond);
BENCHMARK(near_in_voxels_by_grid)->Unit(benchmark::kMillisecond);
BENCHMARK(moved_in_voxels_by_tree)->Unit(benchmark::kMillisecond);
BENCHMARK(moved_in_voxels_by_grid)->Unit(benchmark::kMillisecond);
BENCHMARK(build_tree_of_voxels)->Unit(benchmark::kMillisecond);
BENCHMARK(build_grid_of_voxels)->Unit(benchmark::kMillisecond);

void sizes(benchmark::internal::Benchmark* b) { b->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond); }

#define TCM_ICP_COMPARE(Index)                               \
  BENCHMARK_TEMPLATE(build, Index)->Apply(sizes);            \
  BENCHMARK_TEMPLATE(nearest, Index)->Apply(sizes);          \
  BENCHMARK_TEMPLATE(nearest_of_moved, Index)->Apply(sizes); \
  BENCHMARK_TEMPLATE(nearest_16, Index)->Apply(sizes)

TCM_ICP_COMPARE(TcmIcpIndex);
BENCHMARK_TEMPLATE(nearest_within_0_3_m_of_moved, TcmIcpIndex)->Apply(sizes);
#ifdef TCM_ICP_HAVE_NANOFLANN
TCM_ICP_COMPARE(NanoflannIndex);
BENCHMARK_TEMPLATE(nearest_within_0_3_m_of_moved, NanoflannIndex)->Apply(sizes);
#endif
#ifdef TCM_ICP_HAVE_PCL
TCM_ICP_COMPARE(PclIndex);
#endif

}  // namespace
}  // namespace tcm_icp
