#pragma once
// The paper's rivals through PCL: conventional ICP, and features with sample consensus. Built where PCL is found.

#include "tcm_icp/baselines/pair_fit.hpp"

namespace tcm_icp {

/// Point-to-point ICP (Besl and McKay, 1992) of every pair: all nearest neighbours from the initial poses or, without
/// them, from centroids and principal axes, then those within a reach alone.
/// Cost: 50 ms to a few seconds a pair of 30,000 points.
PairFits icp_pairs(const PairInput& input, const RunContext& context);

/// FPFH (Rusu et al., 2009), sample consensus with a look at edge lengths first (Buch et al., 2013), ICP. Voxels for
/// the features are tried at several multiples of the point spacing; the best tree wins.
/// @throws InvalidOptions  where there are initial poses: it has no use for them
/// @note PCL draws from std::rand, which is seeded here: one such run at a time.
PairFits features_pairs(const PairInput& input, const RunContext& context);

}  // namespace tcm_icp
