#include "scans/prepared_scan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/pick.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/place_sampling.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"
#include "tcm_icp/registration/normal_space_sampling.hpp"

namespace tcm_icp {
namespace {

// A voxel's quarter is what counts as the noise of the distance between two surfaces: sqrt(2) times that of one, twice.
constexpr double kCoarseByNoise = 8, kFineByNoise = 4;
constexpr double kFineByCoverage = 0.5;

// `cloud` is sampled with `voxel_size_m`.
Cloud draw(const Cloud& cloud, double voxel_size_m, int count, std::uint64_t seed, std::string_view stage,
           const std::string& key) {
  Rng rng = make_stream(seed, stage, key);
  const auto priorities = place_priorities(cloud.points, voxel_size_m, rng);
  return pick(cloud, normal_space_sample(cloud, static_cast<std::size_t>(count), priorities));
}

// Splits one draw so that no held-out point is in the fit. Where a scan has fewer points than both ask for, a pose is
// judged by those of the fit as well: a fit of six unknowns takes next to nothing from hundreds of points, and a
// hundred alone leave it to the draw which place looks best.
void draw_fit_and_verification(const PyramidLevel& level, const SampleSizes& options, std::uint64_t seed,
                               const std::string& key, PreparedScan& out) {
  Rng rng = make_stream(seed, "fit and held-out points", key);
  const auto wanted = static_cast<std::size_t>(options.fine_points + options.held_out_points);
  const Cloud& cloud = level.cloud;
  const auto drawn = normal_space_sample(cloud, wanted, place_priorities(cloud.points, level.voxel_size_m, rng));
  // In the proportion asked for, also where the cloud has fewer points than that.
  const std::size_t num_held_out = drawn.size() * static_cast<std::size_t>(options.held_out_points) / wanted;
  // Other numbers than those that decided what is drawn.
  const auto priorities = place_priorities(cloud.points, level.voxel_size_m, rng);
  const auto chosen = least_priorities(drawn, priorities, num_held_out);
  std::vector<std::size_t> in_fit;
  std::set_difference(drawn.begin(), drawn.end(), chosen.begin(), chosen.end(), std::back_inserter(in_fit));
  out.fit_sample = pick(cloud, in_fit);
  out.held_out_sample = pick(cloud, chosen);
  const std::size_t num_verifying = std::min(drawn.size(), static_cast<std::size_t>(options.held_out_points));
  out.verification_sample = pick(cloud, least_priorities(drawn, priorities, num_verifying));
}

// Rough places without a normal.
Cloud surfaces_of(const SampledScan& scan) {
  Cloud out = scan.scan.cloud;
  for (std::size_t i = 0; i < scan.is_surface.size(); ++i) {
    if (scan.is_surface[i] == 0) out.normals[i].setZero();
  }
  return out;
}

}  // namespace

Ball::Ball(const Points& points) {
  if (points.empty()) return;
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(p);
  centre = box.center();
  double squared_m2 = 0;
  for (const auto& p : points) squared_m2 = std::max(squared_m2, (p - centre).squaredNorm());
  radius_m = std::sqrt(squared_m2);
}

bool may_meet(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b, double distance_m) {
  const double reach_m = a.ball.radius_m + b.ball.radius_m + distance_m;
  return (T_a_b * b.ball.centre - a.ball.centre).squaredNorm() <= reach_m * reach_m;
}

Resolutions choose_resolutions(const std::vector<SampledScan>& scans, const SamplingOptions& options, int num_threads) {
  std::vector<double> coarse(scans.size()), fine(scans.size());
  parallel_for(num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Points& points = scans[i].scan.cloud.points;
      coarse[i] = voxel_size_for(points, options.coarse_voxels);
      // With fewer points both are as fine as those allow.
      const bool is_same = points.size() / 2 <= options.coarse_voxels;
      fine[i] = is_same ? coarse[i] : voxel_size_for(points, options.fine_voxels);
    }
  });
  std::vector<double> coverage, noise;
  for (const auto& s : scans) {
    coverage.push_back(s.scan.coverage_m);
    noise.push_back(s.scan.noise_m);
  }
  const double covered_m = median(coverage), noise_m = median(noise);
  const double coarse_m = std::max({median(coarse), covered_m, kCoarseByNoise * noise_m});
  const double fine_m = std::max({median(fine), kFineByCoverage * covered_m, kFineByNoise * noise_m});
  return {rounded_voxel_size(coarse_m), rounded_voxel_size(std::min(coarse_m, fine_m))};
}

PreparedScan prepare_scan(const SampledScan& scan, const Resolutions& resolutions, const SampleSizes& options,
                          std::uint64_t seed) {
  const Cloud surfaces = surfaces_of(scan);
  PreparedScan out{ScanPyramid(surfaces, resolutions.coarse_m, kNumPyramidLevels),
                   {resolutions.fine_m, voxel_downsample(surfaces, resolutions.fine_m)},
                   {},
                   {},
                   {},
                   {},
                   {},
                   {},
                   {},
                   {},
                   {}};
  const std::string key = stream_key(scan.scan);
  out.coarse_sample = draw(voxel_downsample(scan.scan.cloud, resolutions.coarse_m), resolutions.coarse_m,
                           options.coarse_points, seed, "coarse points", key);
  draw_fit_and_verification(out.pyramid.level(0), options, seed, key, out);
  out.moments = out.verification_sample.points;
  out.fine_sample = draw(out.fine.cloud, resolutions.fine_m, options.fine_points, seed, "fine points", key);
  out.key = key;
  out.ball = Ball(scan.scan.cloud.points);
  return out;
}

}  // namespace tcm_icp
