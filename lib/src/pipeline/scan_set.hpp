#pragma once
// The scans of one run, from their files to the correspondence graph: what happens before the first scan is placed.

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "core/acceptance.hpp"
#include "scans/prepared_scan.hpp"
#include "scans/scan_sampling.hpp"
#include "tcm_icp/core/run_context.hpp"
#include "tcm_icp/graph/correspondence_graph.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

/// What results call the scans: files as scan_names() has it, others by their names.
std::vector<std::string> input_names(std::span<const ScanInput> inputs);

/// The scan named by --reference: by its path or its name in results. @throws InvalidOptions  if there is none
std::size_t find_scan(std::span<const ScanInput> inputs, const std::string& name);

/// @throws InvalidInput    a scan named twice, a name that cannot be one of a file in a result
/// @throws InvalidOptions  another number of initial poses than of scans
void check_inputs(std::span<const ScanInput> inputs, const InitialPoses& initial_poses);

/// @throws InvalidOptions  a scan that there is none of, one that is fixed or weighed without an initial pose; a survey
/// frame in the paper's profile
void check_survey(std::span<const ScanInput> inputs, const InitialPoses& initial_poses, const Survey& survey,
                  bool paper);

/// sample_scan() for each scan, as many at once as there are threads. Reports "reading".
/// @param steps  has the samples of scans that were read before, and keeps the others; nullptr: nothing is kept
/// @throws InputError, InvalidInput, Cancelled
std::vector<SampledScan> read_scans(std::span<const ScanInput> inputs, const PipelineOptions& options,
                                    const RunContext& context, ScanDetail detail, const StepStore* steps = nullptr);

ScanSummary summarize(const SampledScan& scan);

/// prepare_scan() for each scan. The working clouds are given up: the samples stand for them from here on. Reports
/// "preparing". Scans that have a digest are prepared with one. @throws Cancelled
std::vector<PreparedScan> prepare_scans(std::vector<SampledScan>& scans, const Resolutions& resolutions,
                                        const SampleSizes& options, const RunContext& context);

/// For each scan T_common_local: initial pose times the shift to the raw coordinates. Where there is none: nothing, or,
/// `as_they_lie`, the identity times that shift.
InitialPoses initial_local_poses(const InitialPoses& initial_poses, const std::vector<SampledScan>& scans,
                                 bool as_they_lie);

/// The poses of a set in which every scan has one.
std::vector<Eigen::Isometry3d> values_of(const InitialPoses& poses);

/// correspondence() for every pair in the frames of the initial poses, and the reference it picks. Reports "comparing".
/// @param T_common_local  local frames into a common one
/// @throws Cancelled
CorrespondenceGraph compare_scans(const std::vector<PreparedScan>& scans,
                                  const std::vector<Eigen::Isometry3d>& T_common_local, const PipelineOptions& options,
                                  const RunContext& context);

}  // namespace tcm_icp
