#pragma once
// The clouds of a result: the merged one, and each scan by itself.

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

/// Voxels of --voxel that are remembered at once; where there are more, the scans are read several times.
constexpr std::uint64_t kMostVoxels = std::uint64_t{1} << 24U;

/// Sees the raw points of registered scans as they are written, outliers left out: number of the scan, points [m].
using PointWatcher = std::function<void(std::size_t scan, std::span<const Eigen::Vector3d> points)>;

/// Writes registered.EXT and, where asked for, scans/NAME.EXT into `folder`. The raw points stream by: once, once more
/// before for formats that must know how far they reach, and for --voxel once for each `most_voxels` voxels.
/// @throws InputError, OutputError, Cancelled
void write_registered_clouds(const std::filesystem::path& folder, std::span<const ScanInput> inputs,
                             const PipelineResult& result, const OutputOptions& options, const RunContext& context,
                             std::uint64_t most_voxels = kMostVoxels, const PointWatcher& watcher = {});

/// The raw points of one scan for whoever watches, outliers left out, with nothing written: of scans that are not
/// registered. @throws InputError, Cancelled
void watch_scan(std::span<const ScanInput> inputs, std::size_t scan, const PipelineResult& result,
                const RunContext& context, const PointWatcher& watcher);

/// Writes scans/NAME.EXT of one registered scan into `folder`, bit by bit as the function above does where `each` is
/// set (but for LAS, whose intensities are scaled by the scan's own range, and E57, which names no coordinate system
/// where the options do not). @return the file, beneath `folder`
/// @param result  of all scans: their poses; of this one also the summary
/// @throws InputError, OutputError, Cancelled
std::filesystem::path write_registered_scan(const std::filesystem::path& folder, const ScanInput& input,
                                            std::size_t scan, const PipelineResult& result,
                                            const OutputOptions& options, const RunContext& context);

/// The same of scans in files.
inline void write_registered_clouds(const std::filesystem::path& folder,
                                    const std::vector<std::filesystem::path>& paths, const PipelineResult& result,
                                    const OutputOptions& options, const RunContext& context,
                                    std::uint64_t most_voxels = kMostVoxels) {
  write_registered_clouds(folder, scans_in_files(paths), result, options, context, most_voxels);
}

}  // namespace tcm_icp
