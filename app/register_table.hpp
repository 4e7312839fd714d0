#pragma once
// What a registration came to, one line a scan.

#include <iosfwd>

#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp::app {

/// Verdict, shares and residual of the evidence, standard deviations of position [unit of the scans] and rotation
/// [deg]; the reason where a scan is not accepted. Then, where there are any, the links that fit far worse than the
/// others.
void print_register_table(const PipelineResult& result, std::ostream& out);

}  // namespace tcm_icp::app
