#pragma once
// Residuals of control points and scanners' positions on the terminal.

#include <cstddef>
#include <iosfwd>

#include "tcm_icp/survey/survey_record.hpp"

namespace tcm_icp::app {

/// Nothing where the run had none.
void print_survey_table(const SurveyRecord& survey, std::size_t width, std::ostream& out);

}  // namespace tcm_icp::app
