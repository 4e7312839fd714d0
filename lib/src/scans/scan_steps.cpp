#include "scans/scan_steps.hpp"

#include "scans/scan_sight.hpp"
#include "steps/do_once.hpp"
#include "steps/input_digest.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {

// Each field by name, so that a field more does not compile before it is listed here.

template <typename Record, MaybeConst<VoxelKey> T>
void transfer(Record& record, T& value) {
  auto& [x, y, z] = value;
  record(x, y, z);
}

template <typename Record, MaybeConst<OutlierSummary> T>
void transfer(Record& record, T& value) {
  auto& [method, num_clusters, num_struck, radius_m, threshold, num_iterations, num_outliers] = value;
  record(method, num_clusters, num_struck, radius_m, threshold, num_iterations, num_outliers);
}

template <typename Record, MaybeConst<OutlierRuleState> T>
void transfer(Record& record, T& value) {
  auto& [keeps_all, centroids, threshold_m, voxels, voxel_size_m, summary] = value;
  record(keeps_all, centroids, threshold_m, voxels, voxel_size_m, summary);
}

template <typename Record, MaybeConst<DensitySamples> T>
void transfer(Record& record, T& value) {
  auto& [points, normals, log_area] = value;
  record(points, normals, log_area);
}

template <typename Record, MaybeConst<Cloud> T>
void transfer(Record& record, T& value) {
  auto& [points, normals] = value;
  record(points, normals);
}

template <typename Record, MaybeConst<Scan> T>
void transfer(Record& record, T& value) {
  auto& [file, unit, origin, cloud, voxel_size_m, spacing_m, noise_m, coverage_m, extent_m, num_raw, num_dropped] =
      value;
  record(unit, origin, cloud, voxel_size_m, spacing_m, noise_m, coverage_m, extent_m, num_raw, num_dropped);
}

template <typename Record, MaybeConst<Viewpoint> T>
void transfer(Record& record, T& value) {
  auto& [place, hidden_share, radius_m, extent_m, alternatives, evidence, line_share, allowed] = value;
  record(place, hidden_share, radius_m, extent_m, alternatives, evidence, line_share, allowed);
}

template <typename Record, MaybeConst<ViewpointClues> T>
void transfer(Record& record, T& value) {
  auto& [by_lines, densities] = value;
  record(by_lines, densities);
}

template <typename Record>
void transfer(Record& record, const SampledScan& scan) {
  record(scan.scan, scan.is_surface, scan.clues, scan.outliers.state(), scan.middle);
}

template <typename Record>
void transfer(Record& record, SampledScan& scan) {
  OutlierRuleState outliers;
  record(scan.scan, scan.is_surface, scan.clues, outliers, scan.middle);
  if (scan.is_surface.size() != scan.scan.cloud.normals.size()) throw BrokenRecord();
  scan.outliers = OutlierRule(outliers);
}

StepKey sample_key(const StepStore& store, const ScanInput& input, const SamplingOptions& sampling,
                   const OutlierOptions& outliers, std::uint64_t seed, ScanDetail detail) {
  const ScanPath path = parse_scan_path(input.path);
  // The format of some files is told by the ends of their names.
  const std::string ending = path.file.stem().extension().string() + path.file.extension().string();
  const auto& [max_points, coarse_voxels, fine_voxels, max_variation] = sampling;
  const auto& [method, clusters, radius_m, threshold_m, iterations, neighbors, distance_factor, lof_threshold] =
      outliers;
  return step_key("samples", input_digest(store, path.file), ending, path.number, path.bin, path.unit, max_points,
                  max_variation, method, clusters, radius_m, threshold_m, iterations, neighbors, distance_factor,
                  lof_threshold, seed, detail);
}

std::optional<SampledScan> find_sample(const StepStore& store, const StepKey& key) {
  std::optional<SampledScan> known = find_step<SampledScan>(store, key);
  if (known) known->digest = key.digest;
  return known;
}

SampledScan sample_scan_once(const StepStore& store, const ScanInput& input, const SamplingOptions& sampling,
                             const OutlierOptions& outliers, std::uint64_t seed, int num_threads, ScanDetail detail) {
  const auto sample = [&] { return sample_scan(input, sampling, outliers, seed, num_threads, detail); };
  if (!input.is_file()) {
    SampledScan scan = sample();
    RecordWriter record;
    record(scan);
    scan.digest = sha256_of(record.bytes());
    return scan;
  }
  const StepKey key = sample_key(store, input, sampling, outliers, seed, detail);
  auto scan = do_once<SampledScan>(store, key, sample);
  scan.digest = key.digest;
  return scan;
}

std::optional<Viewpoint> find_viewpoint_once(const StepStore& store, const SampledScan& scan, std::uint64_t seed) {
  return do_once<std::optional<Viewpoint>>(store, step_key("viewpoints", scan.digest, seed),
                                           [&] { return find_viewpoint_of(scan, seed); });
}

std::string prepared_digest(const std::string& sample, const Resolutions& resolutions, const SampleSizes& sizes,
                            std::uint64_t seed) {
  const auto& [coarse_points, fine_points, held_out_points] = sizes;
  return step_key("prepared", sample, resolutions.coarse_m, resolutions.fine_m, coarse_points, fine_points,
                  held_out_points, seed)
      .digest;
}

}  // namespace tcm_icp
