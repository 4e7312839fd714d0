#include "command.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {

int cmd_evaluate(const Arguments&) { throw InvalidOptions("evaluate is not there yet"); }

}  // namespace tcm_icp::app
