#pragma once
// Lengths of a set that scans are added to: kept, so that its pairs need not be compared anew.

#include <cstdint>
#include <string>
#include <vector>

#include "scans/prepared_scan.hpp"
#include "scans/scan_sampling.hpp"
#include "tcm_icp/steps/step_store.hpp"

namespace tcm_icp {

struct KeptSet {
  Resolutions resolutions;
  /// Digests of the samples, in their order, of the set that the resolutions are kept from; empty: they are this set's
  /// own.
  std::vector<std::string> base;
};

/// Resolutions are medians over the scans of a set, so that one scan more would change each pair a little, and all that
/// was done of it. So they stay those of the largest set in the work folder whose scans are all in this one, as long as
/// they are within a tenth of its own. A set that was worked on before has what it had then.
/// @param scans  with digests, in their order
/// @param own    choose_resolutions() of the same
/// @throws OutputError
KeptSet keep_resolutions(const StepStore& store, const std::vector<SampledScan>& scans, const SamplingOptions& options,
                         const Resolutions& own);

/// The digests that scans of these samples are prepared with.
std::vector<std::string> prepared_digests(const std::vector<std::string>& samples, const Resolutions& resolutions,
                                          const SampleSizes& sizes, std::uint64_t seed);

}  // namespace tcm_icp
