#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>
#include <filesystem>
#include <variant>
#include <vector>

#include "array_source.hpp"
#include "bindings.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/survey/control_file.hpp"

namespace tcm_icp::python {
namespace {

namespace py = pybind11;

/// One for all axes, or one for each.
using Sigma = std::variant<double, Eigen::Vector3d>;

Eigen::Vector3d sigma(const Sigma& value, bool may_be_zero, const std::string& point) {
  const double* const one = std::get_if<double>(&value);
  const Eigen::Vector3d out = one != nullptr ? Eigen::Vector3d::Constant(*one) : std::get<Eigen::Vector3d>(value);
  const bool good = out.allFinite() && (may_be_zero ? out.minCoeff() >= 0 : out.minCoeff() > 0);
  if (good) return out;
  throw InvalidInput("control point " + point + ": " +
                     (may_be_zero ? "sigma_measured_m must be at least 0" : "sigma_m must be above 0") +
                     ", a number or one for each axis");
}

ControlPoint control_point(const std::string& name, const std::string& scan, const Eigen::Vector3d& measured,
                           const Eigen::Vector3d& given, const Sigma& sigma_m, const Sigma& sigma_measured_m,
                           bool is_check) {
  if (name.empty()) throw InvalidInput("a control point has no name; name it: reports do so");
  if (!measured.allFinite() || !given.allFinite()) {
    throw InvalidInput("control point " + name + ": a coordinate is not a finite number; leave the point out");
  }
  ControlPoint out;
  out.name = name;
  out.scan = scan;
  out.measured = measured;
  out.given = given;
  out.sigma_given_m = sigma(sigma_m, false, name);
  out.sigma_measured_m = sigma(sigma_measured_m, true, name);
  out.use = is_check ? PointUse::kCheck : PointUse::kControl;
  return out;
}

std::vector<std::filesystem::path> paths_of(const PythonScans& scans) {
  std::vector<std::filesystem::path> paths;
  for (const auto& input : scans.inputs) paths.push_back(input.path);
  return paths;
}

}  // namespace

void bind_survey(py::module_& m) {
  py::class_<ControlPoint>(m, "ControlPoint", "A point measured in a scan whose place in the survey frame is known.")
      .def(py::init(&control_point), py::arg("name"), py::arg("scan"), py::arg("measured"), py::arg("given"),
           py::arg("sigma_m"), py::arg("sigma_measured_m") = Sigma(0.0), py::arg("is_check") = false,
           "name: of the point. scan: name of the scan it was measured in (\"cloud_0\"); \"\": in the frame of the "
           "reference scan. measured, given: [m] there and in the survey frame. sigma_m, sigma_measured_m: [m] "
           "standard deviations of both, a number or one for each axis. is_check: compared only, not adjusted to.")
      .def_readonly("name", &ControlPoint::name, "Of the point.")
      .def_readonly("scan", &ControlPoint::scan, "Name of the scan.")
      .def_readonly("measured", &ControlPoint::measured, "[m] In the scan.")
      .def_readonly("given", &ControlPoint::given, "[m] In the survey frame.")
      .def_readonly("sigma_m", &ControlPoint::sigma_given_m, "[m] Standard deviations of the given coordinates.")
      .def_readonly("sigma_measured_m", &ControlPoint::sigma_measured_m, "[m] Of the measured ones.")
      .def_property_readonly(
          "is_check", [](const ControlPoint& p) { return p.use == PointUse::kCheck; }, "Whether it is compared only.");

  py::class_<Survey>(m, "Survey", "What defines the frame in place of the reference scan.")
      .def(py::init<>())
      .def_readwrite("fixed", &Survey::fixed)
      .def_readwrite("crs", &Survey::crs)
      .def_readwrite("sigma_level_rad", &Survey::sigma_level_rad)
      .def("add_point", [](Survey& s, const ControlPoint& p) { s.points.push_back(p); })
      .def("add_control_file",
           [](Survey& s, const std::string& file, const PythonScans& scans) {
             for (auto& p : read_control_file(file, paths_of(scans))) s.points.push_back(std::move(p));
           })
      .def("add_scanner_positions", [](Survey& s, const std::string& file, const PythonScans& scans) {
        for (auto& p : read_scanner_positions(file, paths_of(scans))) s.points.push_back(std::move(p));
      });
}

}  // namespace tcm_icp::python
