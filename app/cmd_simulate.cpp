#include "command.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {

int cmd_simulate(const Arguments&) { throw InvalidOptions("simulate is not there yet"); }

}  // namespace tcm_icp::app
