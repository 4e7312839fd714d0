#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <optional>
#include <vector>

#include "bindings.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

namespace tcm_icp::python {
namespace {

namespace py = pybind11;

using Matrices = std::vector<std::optional<Eigen::Matrix4d>>;

InitialPoses initial_poses(const Matrices& matrices) {
  constexpr double kRigid = 1e-3;  // as those of files: few digits pass, a scale does not
  InitialPoses poses;
  for (const auto& matrix : matrices) {
    poses.emplace_back();
    if (!matrix) continue;
    if (!is_rigid(*matrix, kRigid)) {
      throw InvalidInput("initial pose " + std::to_string(poses.size() - 1) + " is not a rigid 4 x 4 matrix");
    }
    poses.back() = Eigen::Isometry3d::Identity();
    poses.back()->linear() = project_onto_so3(matrix->topLeftCorner<3, 3>());
    poses.back()->translation() = matrix->topRightCorner<3, 1>();
  }
  return poses;
}

}  // namespace

void bind_options(py::module_& m) {
  py::enum_<Profile>(m, "Profile", "Which method registers.")
      .value("ROBUST", Profile::kRobust, "the paper's steps made robust, with inference and decisions")
      .value("PAPER", Profile::kPaper, "the paper to the letter: needs initial poses, verifies nothing");
  py::enum_<OutlierMethod>(m, "OutlierMethod", "What counts as an outlier of a scan.")
      .value("KMEANS", OutlierMethod::kKMeans, "far from every k-means centroid, as in the paper")
      .value("DISTANCE", OutlierMethod::kDistance, "far from its nearest neighbours")
      .value("LOF", OutlierMethod::kLof, "much sparser than its neighbours' neighbourhoods")
      .value("NONE", OutlierMethod::kNone, "no point is removed");
  py::enum_<ScanStatus>(m, "Status", "Whether a scan has a pose.")
      .value("REFERENCE", ScanStatus::kReference, "it defines the frame")
      .value("REGISTERED", ScanStatus::kRegistered, "it has a pose")
      .value("UNREGISTERED", ScanStatus::kUnregistered, "it has none");
  py::enum_<Verdict>(m, "Verdict", "Whether a pose can be trusted.")
      .value("ACCEPTED", Verdict::kAccepted, "what was measured supports it")
      .value("DOUBTFUL", Verdict::kDoubtful, "nothing confirms it, or not clearly")
      .value("REJECTED", Verdict::kRejected, "what was measured speaks against it");
  py::enum_<Reason>(m, "Reason", "What decided about a scan.")
      .value("NOT_DECIDED", Reason::kNotDecided, "nothing was decided")
      .value("REFERENCE", Reason::kReference, "the reference scan")
      .value("ACCEPTED", Reason::kAccepted, "its place is probable enough")
      .value("NO_LINK", Reason::kNoLink, "nothing joins it to another scan")
      .value("AMBIGUOUS", Reason::kAmbiguous, "another place fits about as well")
      .value("MISFIT", Reason::kMisfit, "its points agree less than those of the other scans do")
      .value("SLIDES", Reason::kSlides, "it can slide without losing agreement")
      .value("SEEN_THROUGH", Reason::kSeenThrough, "scans would have seen through walls")
      .value("INEXACT", Reason::kInexact, "its pose is too uncertain")
      .value("TOO_FEW_POINTS", Reason::kTooFewPoints, "too few of its points lie on surfaces");

  py::class_<RegistrationOptions>(m, "Options", "What may be asked of a registration.")
      .def(py::init<>())
      .def_readwrite("profile", &RegistrationOptions::profile)
      .def_readwrite("confidence", &RegistrationOptions::confidence)
      .def_readwrite("reference", &RegistrationOptions::reference)
      .def_readwrite("level", &RegistrationOptions::level)
      .def_readwrite("outliers", &RegistrationOptions::outliers)
      .def_property(
          "coarse_voxels", [](const RegistrationOptions& o) { return o.sampling.coarse_voxels; },
          [](RegistrationOptions& o, std::size_t n) { o.sampling.coarse_voxels = n; })
      .def_property(
          "fine_voxels", [](const RegistrationOptions& o) { return o.sampling.fine_voxels; },
          [](RegistrationOptions& o, std::size_t n) { o.sampling.fine_voxels = n; })
      .def("set_initial_poses",
           [](RegistrationOptions& o, const Matrices& matrices) { o.initial_poses = initial_poses(matrices); })
      .def("set_survey", [](RegistrationOptions& o, const Survey& survey) { o.survey = survey; });
}

}  // namespace tcm_icp::python
