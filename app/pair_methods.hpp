#pragma once
// The conventional methods this executable was built with.

#include <string>

#include "register_options.hpp"
#include "tcm_icp/baselines/pair_fit.hpp"

namespace tcm_icp::app {

std::string name_of(Method method);

/// @throws InvalidOptions  where the method needs PCL and this executable was built without it
void check_built_in(Method method);

/// @pre check_built_in(method) did not throw
PairMethod pair_method(Method method);

}  // namespace tcm_icp::app
