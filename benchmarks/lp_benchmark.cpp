// The linear program of one registration step: six unknowns, one row a correspondence.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <string>

#include "tcm_icp/core/random.hpp"
#include "tcm_icp/registration/l1_fit.hpp"

namespace tcm_icp {
namespace {

enum Scene { kNoisy, kFine, kCleanGrid };

// Rows [p x n, n] of ground, two walls and clutter within 40 m; residuals of a small motion with noise of 10 mm, 0.1 mm
// or none, and one row in ten a gross outlier of up to 2 m.
void fill_rows(Scene scene, Eigen::MatrixXd& A, Eigen::VectorXd& d) {
  Rng rng = make_stream(1, "lp benchmark");
  Eigen::Matrix<double, 6, 1> twist;
  twist << 0.02, -0.01, 0.03, 0.2, -0.1, 0.05;
  if (scene == kFine) twist *= 1e-3;
  const double noise_m = scene == kNoisy ? 0.01 : scene == kFine ? 1e-4 : 0;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const std::uint64_t kind = uniform_index(rng, 4);
    Eigen::Vector3d p(40 * uniform01(rng) - 20, 40 * uniform01(rng) - 20, 8 * uniform01(rng) - 2);
    Eigen::Vector3d n(standard_normal(rng), standard_normal(rng), standard_normal(rng));
    if (scene == kCleanGrid) p = p.array().round();
    n = kind < 3 ? Eigen::Vector3d::Unit(static_cast<Eigen::Index>(kind)) : n.normalized();
    A.row(i) << p.cross(n).transpose(), n.transpose();
    d[i] = A.row(i).dot(twist) + noise_m * standard_normal(rng);
    if (uniform01(rng) < 0.1) d[i] += 4 * uniform01(rng) - 2;
  }
}

void fit_rows(benchmark::State& state, LpSolver solver, Scene scene, double tie_breaking) {
  Eigen::MatrixXd A(state.range(0), 6);
  Eigen::VectorXd d(state.range(0));
  fill_rows(scene, A, d);
  L1FitOptions options;
  options.lp.solver = solver;
  options.lp.cgal_max_columns = 20'000;
  options.lp.max_seconds = 20;
  options.tie_breaking = tie_breaking;
  L1FitResult result;
  for (auto _ : state) {
    result = fit_l1(A, d, options);
    benchmark::DoNotOptimize(result.x.data());
  }
  state.SetLabel(std::string(to_string(result.status)));
  state.counters["pivots"] = result.pivots;
  state.counters["gap"] = result.duality_gap;
}

constexpr double kTieBreaking = 1e-6;

void sizes_of_glpk(benchmark::internal::Benchmark* b) {
  b->Arg(1'000)->Arg(5'000)->Arg(20'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
}
void sizes_of_cgal(benchmark::internal::Benchmark* b) {
  b->Arg(1'000)->Arg(2'000)->Arg(5'000)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(fit_rows, glpk_noisy, LpSolver::kGlpk, kNoisy, kTieBreaking)->Apply(sizes_of_glpk);
BENCHMARK_CAPTURE(fit_rows, glpk_fine, LpSolver::kGlpk, kFine, kTieBreaking)->Apply(sizes_of_glpk);
BENCHMARK_CAPTURE(fit_rows, glpk_clean_grid, LpSolver::kGlpk, kCleanGrid, kTieBreaking)->Apply(sizes_of_glpk);
BENCHMARK_CAPTURE(fit_rows, glpk_clean_grid_with_ties, LpSolver::kGlpk, kCleanGrid, 0.0)
    ->Arg(1'000)
    ->Arg(20'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit_rows, cgal_noisy, LpSolver::kCgal, kNoisy, kTieBreaking)->Apply(sizes_of_cgal);
BENCHMARK_CAPTURE(fit_rows, cgal_clean_grid, LpSolver::kCgal, kCleanGrid, kTieBreaking)->Apply(sizes_of_cgal);

}  // namespace
}  // namespace tcm_icp
