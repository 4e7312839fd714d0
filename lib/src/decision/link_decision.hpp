#pragma once
// Whether a pair of scans bears its pose out by itself.

#include "tcm_icp/links/link_record.hpp"

namespace tcm_icp {

/// The record of a link at its final pose, judged by the model of hypotheses without what a search says; accepted from
/// 0.95 on, rejected below a half. Without a strength.
LinkRecord judge_link(std::size_t a, std::size_t b, const LinkMeasurements& measurements, const SetReference& set);

}  // namespace tcm_icp
