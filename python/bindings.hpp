#pragma once
// The parts of the module, each in its own file.

#include <pybind11/pybind11.h>

namespace tcm_icp::python {

void bind_options(pybind11::module_& module);  ///< enums and RegistrationOptions
void bind_survey(pybind11::module_& module);   ///< ControlPoint, Survey
void bind_results(pybind11::module_& module);  ///< RegisteredScan, RegisteredLink, Registration

}  // namespace tcm_icp::python
