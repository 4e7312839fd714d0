#include "scans/scan_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "tcm_icp/core/coverage.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/core/voxel_octaves.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/visibility/viewpoint_by_lines.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMinPoints = 3;
constexpr double kSupportShare = 0.5;  // of the coverage: several points of a ring for each to the next ring
constexpr double kNearlyAll = 0.7;
constexpr double kFinestShare = 1.0 / 4096;  // of the extent: points are single there

Eigen::Vector3d median_point(const Points& points) {
  std::vector<double> values(points.size());
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][axis];
    middle[axis] = median(values);
  }
  return middle;
}

// 90th percentile of the distance from the median point.
double robust_extent(const Points& points, const Eigen::Vector3d& middle) {
  std::vector<double> values(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) values[i] = (points[i] - middle).norm();
  return quantile(values, 0.9);
}

VoxelSample stream_into_sample(const ScanInput& input, Scan& scan, std::size_t max_points) {
  ScanReader reader(input, ReadAttributes::kNo);
  VoxelSampler sampler(max_points);
  PointBlock block;
  bool first = true;
  while (reader.read(block)) {
    if (first) scan.origin = block.points.front();
    first = false;
    for (auto& p : block.points) p -= scan.origin;
    sampler.add(block.points);
  }
  scan.num_raw_points = reader.num_points();
  scan.num_dropped_points = reader.num_dropped();
  if (scan.num_raw_points < kMinPoints) {
    throw InvalidInput(input.path.string() + ": " + std::to_string(scan.num_raw_points) +
                       " finite points; a scan needs at least 3; leave the file out or export it again");
  }
  VoxelSample sample = sampler.finish();
  scan.voxel_size_m = sampler.voxel_size_m();
  if (sample.points.size() < kMinPoints) {
    throw InvalidInput(input.path.string() + ": its points lie in " + std::to_string(sample.points.size()) +
                       (sample.points.size() == 1 ? " place" : " places") +
                       "; a scan needs at least 3 different points; check the file's columns");
  }
  return sample;
}

// Along a ring points are so dense that a point's nearest neighbours are of one ring, spread by the noise of its
// ranges: their plane is the scanner's, not the wall's. So planes are fitted to points as dense as surfaces are
// covered, and a point takes the plane of the nearest of those. Where nearly all are left, they are even as they are.
class EvenPoints {
 public:
  // Both have to outlive this.
  EvenPoints(const Points& all, const NeighborIndex& index_of_all, double support_m) {
    Points even = voxel_downsample({all, {}}, rounded_voxel_size(support_m)).points;
    if (static_cast<double>(even.size()) > kNearlyAll * static_cast<double>(all.size())) {
      points_ = &all;
      index_ = &index_of_all;
      return;
    }
    own_ = std::make_unique<Own>(std::move(even));
    points_ = &own_->points;
    index_ = &own_->index;
  }

  bool are_all() const { return own_ == nullptr; }
  const Points& points() const { return *points_; }
  const NeighborIndex& index() const { return *index_; }

 private:
  struct Own {
    explicit Own(Points even) : points(std::move(even)), index(points) {}

    Points points;
    NeighborIndex index;
  };

  std::unique_ptr<const Own> own_;
  const Points* points_;
  const NeighborIndex* index_;
};

constexpr std::size_t kPlanesCompared = 1000;
constexpr double kSmootherPlanes = 4;  // as much a bent surface is at half the distance; a noisy one is as smooth
constexpr double kOtherPlane = std::numbers::pi / 4;  // planes nearer to upright on one another than to parallel

// Where a ring's points are nearer one another than their ranges are noisy, they cover the cone that the scanner sweeps
// before they cover surfaces. Planes of the cone are far smoother than those of points half as dense, and other ones.
bool are_planes_of_a_cone(const NormalEstimate& here, const NormalEstimate& next) {
  std::vector<double> roughness_here, roughness_next, cosines;
  for (std::size_t i = 0; i < here.normals.size(); ++i) {
    if (here.normals[i].isZero() || next.normals[i].isZero()) continue;
    roughness_here.push_back(here.roughness_m[i]);
    roughness_next.push_back(next.roughness_m[i]);
    cosines.push_back(std::abs(here.normals[i].dot(next.normals[i])));
  }
  return !cosines.empty() && median(roughness_next) > kSmootherPlanes * median(roughness_here) &&
         median(cosines) < std::cos(kOtherPlane);
}

// Moves the scan's coverage to where points cover surfaces.
EvenPoints points_of_surfaces(Scan& scan, const NeighborIndex& index) {
  const Points& points = scan.cloud.points;
  const Points queries = even_sample(points, kPlanesCompared);
  const auto planes = [&](const EvenPoints& even) {
    return estimate_normals_at(queries, even.points(), even.index(), {}, 1);
  };
  EvenPoints here(points, index, kSupportShare * scan.coverage_m);
  NormalEstimate planes_here = planes(here);
  while (true) {
    EvenPoints next(points, index, 2 * kSupportShare * scan.coverage_m);
    NormalEstimate planes_next = planes(next);
    if (!are_planes_of_a_cone(planes_here, planes_next)) return here;
    here = std::move(next);
    planes_here = std::move(planes_next);
    scan.coverage_m *= 2;
  }
}

NormalEstimate normals_of_surfaces(Scan& scan, const NeighborIndex& index, int num_threads) {
  const Points& points = scan.cloud.points;
  if (!(scan.coverage_m > 0)) return estimate_normals(points, index, {}, num_threads);
  const EvenPoints even = points_of_surfaces(scan, index);
  NormalEstimate planes = estimate_normals(even.points(), even.index(), {}, num_threads);
  if (even.are_all()) return planes;
  NormalEstimate out{Points(points.size()), std::vector<double>(points.size()), std::vector<double>(points.size())};
  parallel_for(num_threads, points.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t nearest = even.index().nearest(points[i]).index;
      out.normals[i] = planes.normals[nearest];
      out.variation[i] = planes.variation[nearest];
      out.roughness_m[i] = planes.roughness_m[nearest];
    }
  });
  return out;
}

}  // namespace

SampledScan sample_scan(const ScanInput& input, const SamplingOptions& sampling, const OutlierOptions& outliers,
                        std::uint64_t seed, int num_threads, ScanDetail detail) {
  SampledScan out;
  Scan& scan = out.scan;
  scan.file = input.path.filename().string();
  if (input.is_file()) scan.unit = name_of(parse_scan_path(input.path).unit);
  const VoxelSample sample = stream_into_sample(input, scan, sampling.max_working_points);

  Rng rng = make_stream(seed, "outliers", stream_key(scan));
  out.outliers = learn_outlier_rule(sample.points, scan.voxel_size_m, outliers, rng, num_threads);
  std::uint32_t near = 0;
  std::vector<float> counts;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    if (out.outliers.is_outlier(sample.points[i], near)) continue;
    scan.cloud.points.push_back(sample.points[i]);
    counts.push_back(sample.counts[i]);
  }
  if (scan.cloud.size() < kMinPoints) {
    throw InvalidInput(input.path.string() + ": outlier removal left " + std::to_string(scan.cloud.size()) +
                       " points; choose another threshold or --outliers none");
  }
  const NeighborIndex index(scan.cloud.points);
  scan.spacing_m = median_spacing(scan.cloud.points, index);
  out.middle = median_point(scan.cloud.points);
  scan.extent_m = robust_extent(scan.cloud.points, out.middle);
  if (scan.extent_m > 0) {
    scan.coverage_m = coverage_m(VoxelOctaves(scan.cloud.points, out.middle, kFinestShare * scan.extent_m));
  }
  if (detail == ScanDetail::kPoints) return out;
  NormalEstimate estimate = normals_of_surfaces(scan, index, num_threads);
  std::vector<double> roughness;
  for (std::size_t i = 0; i < estimate.normals.size(); ++i) {
    if (!estimate.normals[i].isZero()) roughness.push_back(estimate.roughness_m[i]);
  }
  scan.noise_m = roughness.empty() ? 0 : median(roughness);
  for (std::size_t i = 0; i < estimate.normals.size(); ++i) {
    out.is_surface.push_back(estimate.variation[i] > sampling.max_surface_variation ? 0 : 1);
  }
  scan.cloud.normals = std::move(estimate.normals);
  if (detail == ScanDetail::kViewpointClues) {
    Rng for_densities = make_stream(seed, "point densities", stream_key(scan));
    out.clues.densities = sample_densities(scan.cloud.points, counts, index, for_densities);
    Rng for_lines = make_stream(seed, "scan lines", stream_key(scan));
    out.clues.by_lines = find_viewpoint_by_lines(scan.cloud, index, for_lines);
  }
  return out;
}

}  // namespace tcm_icp
