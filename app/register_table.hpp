#pragma once
// What a registration came to, one line a scan, and the whole in one line.

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp::app {

/// Number, as the report has it, verdict, shares and residual of the evidence, standard deviations of position and
/// rotation, with their units; below it, the reason where a scan is not accepted. Then, where there are any, the links
/// that fit far worse than the others. Lines of the table have at most `width` characters: names are shortened in the
/// middle.
void print_register_table(const PipelineResult& result, std::size_t width, std::ostream& out);

/// "13 of 13 registered, worst 1 sigma 2.1 mm (scan7.las), open out/report.html".
/// @param verified  false: the poses are those of a method that verifies none
std::string register_summary(const PipelineResult& result, bool verified, const std::filesystem::path& report);

}  // namespace tcm_icp::app
