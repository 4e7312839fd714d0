#pragma once
// Whether a pair of scans bears its pose out by itself.

#include <string>

#include "tcm_icp/links/link_measurements.hpp"

namespace tcm_icp {

struct LinkDecision {
  double probability = 0;  ///< that the pose is right, by this pair alone
  std::string verdict;     ///< accepted, doubtful or rejected
  std::string text;
};

/// The model of hypotheses without what a search says; accepted from 0.95 on, rejected below a half.
LinkDecision decide_link(const LinkMeasurements& measurements, const SetReference& set);

}  // namespace tcm_icp
