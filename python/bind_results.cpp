#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>

#include "bindings.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

namespace tcm_icp::python {
namespace {

namespace py = pybind11;

std::optional<Eigen::Matrix4d> pose_of(const RegisteredScan& scan) {
  if (!scan.is_registered()) return std::nullopt;
  return scan.T_reference_scan.matrix();
}

std::optional<Eigen::Matrix4d> pose_in_component_of(const RegisteredScan& scan) {
  if (!scan.T_component_scan) return std::nullopt;
  return scan.T_component_scan->matrix();
}

py::str repr(const RegisteredScan& scan) {
  return py::str("<tcm_icp.Scan '{}': {}, {}, probability {:.3f}>")
      .format(scan.name, std::string(to_string(scan.status)), std::string(to_string(scan.verdict)), scan.probability);
}

}  // namespace

void bind_results(py::module_& m) {
  py::class_<RegisteredScan>(m, "Scan", "What became of one scan.")
      .def_readonly("name", &RegisteredScan::name, "File name, or the name it was given.")
      .def_readonly("status", &RegisteredScan::status, "Whether it has a pose.")
      .def_readonly("verdict", &RegisteredScan::verdict, "Whether the pose can be trusted.")
      .def_readonly("reason", &RegisteredScan::reason, "What decided about it.")
      .def_readonly("text", &RegisteredScan::text, "The reason for a person, with its figures.")
      .def_readonly("probability", &RegisteredScan::probability, "That its place is right, 0 to 1.")
      .def_property_readonly("pose", &pose_of,
                             "4 x 4, raw coordinates into the common frame; None where it is unregistered.")
      .def_property_readonly("pose_in_component", &pose_in_component_of,
                             "4 x 4 into the frame of scans that hold together without the reference, or None.")
      .def_readonly("component", &RegisteredScan::component,
                    "Scans of one number hold together; 0: with the reference.")
      .def_readonly("num_points", &RegisteredScan::num_points, "Finite points.")
      .def_readonly("overlap", &RegisteredScan::overlap,
                    "Share of its points with a neighbour in other scans, or None.")
      .def_readonly("inlier_share", &RegisteredScan::inlier_share,
                    "Share of these that agree within the noise, or None.")
      .def_readonly("residual_m", &RegisteredScan::residual_m, "[m] Median distance to other scans' surfaces, or None.")
      .def_readonly("sigma_position_m", &RegisteredScan::sigma_position_m,
                    "[m] Standard deviation of its middle, or None.")
      .def_readonly("sigma_rotation_rad", &RegisteredScan::sigma_rotation_rad,
                    "[rad] Standard deviation of its rotation, or None.")
      .def("__repr__", &repr);

  py::class_<RegisteredLink>(m, "Link", "Two scans that overlap at their final poses, judged by themselves.")
      .def_readonly("a", &RegisteredLink::a, "Position of one scan in the list.")
      .def_readonly("b", &RegisteredLink::b, "Position of the other.")
      .def_readonly("verdict", &RegisteredLink::verdict, "Whether the pair supports its pose.")
      .def_readonly("probability", &RegisteredLink::probability, "That the pose is right, by the pair alone.")
      .def_readonly("overlap", &RegisteredLink::overlap, "0 to 1, of the direction that overlaps more.")
      .def_readonly("inlier_share", &RegisteredLink::inlier_share, "Share of these points that agree within the noise.")
      .def_readonly("residual_m", &RegisteredLink::residual_m, "[m] Median distance to the other scan's surfaces.")
      .def_readonly("text", &RegisteredLink::text, "The same for a person.");

  py::class_<Registration>(m, "RegistrationCore", "What a registration found.")
      .def_readonly("reference", &Registration::reference)
      .def_readonly("scans", &Registration::scans)
      .def_readonly("links", &Registration::links)
      .def_readonly("warnings", &Registration::warnings)
      .def("all_registered", &Registration::all_registered);
}

}  // namespace tcm_icp::python
