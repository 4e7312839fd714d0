#pragma once
// The steps of one scan, with a work folder: taken from there where they are, else done and kept.

#include <cstdint>
#include <optional>
#include <string>

#include "scans/prepared_scan.hpp"
#include "scans/scan_sampling.hpp"
#include "steps/step_key.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "tcm_icp/steps/step_store.hpp"
#include "tcm_icp/visibility/viewpoint.hpp"

namespace tcm_icp {

/// What the sample of a scan in a file depends on: the file's bytes, how they are read, and the options. Neither name
/// nor place of the file counts. @throws InputError
StepKey sample_key(const StepStore& store, const ScanInput& input, const SamplingOptions& sampling,
                   const OutlierOptions& outliers, std::uint64_t seed, ScanDetail detail);

/// A sample by its key alone; nothing where there is none.
std::optional<SampledScan> find_sample(const StepStore& store, const StepKey& key);

/// sample_scan() with its digest, and kept where the scan comes from a file.
SampledScan sample_scan_once(const StepStore& store, const ScanInput& input, const SamplingOptions& sampling,
                             const OutlierOptions& outliers, std::uint64_t seed, int num_threads, ScanDetail detail);

/// find_viewpoint_of() of a scan that has a digest.
std::optional<Viewpoint> find_viewpoint_once(const StepStore& store, const SampledScan& scan, std::uint64_t seed);

/// Check sum over all that a prepared scan and its sight depend on.
/// @param sample  digest of the sample
std::string prepared_digest(const std::string& sample, const Resolutions& resolutions, const SampleSizes& sizes,
                            std::uint64_t seed);

}  // namespace tcm_icp
