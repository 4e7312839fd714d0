#pragma once
// How likely a pose of a pair is right, from what was measured there.

#include "tcm_icp/links/link_measurements.hpp"

namespace tcm_icp {

/// Log-odds of a pose that a search came up with, all features; 0 is a coin toss. Logistic model, fitted by
/// scripts/calibrate.py to simulated scans (link_model.inc; docs/decisions/0011-link-model.md).
double hypothesis_log_odds(const LinkFeatures& features);

/// Log-odds of a pose that other scans led to, by its pose features alone.
double pose_log_odds(const LinkFeatures& features);

}  // namespace tcm_icp
