#include "command.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {

int cmd_register(const Arguments&) { throw InvalidOptions("register is not there yet"); }

}  // namespace tcm_icp::app
