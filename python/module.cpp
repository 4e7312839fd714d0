// The module _core: what tcm_icp/__init__.py is made of. The GIL is released while the library works; the progress
// callback takes it, and asks Python for signals, so that Ctrl-C arrives.

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "array_source.hpp"
#include "bindings.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/version.hpp"
#include "tcm_icp/io/scan_inputs.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/pipeline/register_scans.hpp"

namespace tcm_icp::python {
namespace {

namespace py = pybind11;

/// Runs library code without the GIL, with a context whose callback calls Python's. What Python throws in it stops the
/// library and comes out here.
template <typename Work>
auto run_with_progress(const std::optional<py::function>& progress, int threads, std::uint64_t seed, const Work& work) {
  RunContext context;
  context.seed = seed;
  context.num_threads = threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::exception_ptr thrown;
  context.on_progress = [&](const Progress& p) {
    const py::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress) return Continue::kYes;
      const py::object answer = (*progress)(std::string(p.stage), p.done, p.total);
      return answer.is(py::bool_(false)) ? Continue::kStop : Continue::kYes;
    } catch (...) {
      thrown = std::current_exception();
      return Continue::kStop;
    }
  };
  try {
    const py::gil_scoped_release no_gil;
    return work(context);
  } catch (const Cancelled&) {
    if (thrown) std::rethrow_exception(thrown);
    throw;
  }
}

PointArray read_points(const std::string& file) {
  Points points;
  {
    const py::gil_scoped_release no_gil;
    ScanReader reader(std::filesystem::path(file), ReadAttributes::kNo);
    PointBlock block;
    while (reader.read(block)) points.insert(points.end(), block.points.begin(), block.points.end());
  }
  PointArray out({points.size(), std::size_t{3}});
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(out.mutable_data(static_cast<py::ssize_t>(i), 0), points[i].data(), 3 * sizeof(double));
  }
  return out;
}

std::vector<std::string> find_scan_names(const std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  for (const auto& path : find_scans(inputs).scans) names.push_back(path.string());
  return names;
}

py::dict libraries() {
  py::dict out;
  for (const auto& library : linked_libraries()) out[py::str(library.name)] = library.version;
  return out;
}

CloudFormat format_of(const std::string& name) {
  if (name == "ply") return CloudFormat::kPly;
  if (name == "las") return CloudFormat::kLas;
  if (name == "pcd") return CloudFormat::kPcd;
  if (name == "text") return CloudFormat::kText;
  if (name == "e57") return CloudFormat::kE57;
  if (name == "ptx") return CloudFormat::kPtx;
  throw InvalidOptions("format '" + name + "': choose one of ply, las, pcd, text, e57, ptx");
}

void bind_errors(py::module_& m) {
  const auto& error =
      py::register_exception<Error>(m, "Error", PyExc_RuntimeError);  // first: those derived go before it
  py::register_exception<InvalidOptions>(m, "InvalidOptions", error);
  py::register_exception<InvalidInput>(m, "InvalidInput", error);
  py::register_exception<InputError>(m, "InputError", error);
  py::register_exception<OutputError>(m, "OutputError", error);
  py::register_exception<Cancelled>(m, "Cancelled", error);
}

}  // namespace
}  // namespace tcm_icp::python

PYBIND11_MODULE(_core, m) {
  using namespace tcm_icp;
  using namespace tcm_icp::python;
  m.doc() = "Compiled part of tcm_icp; use the package.";
  bind_errors(m);
  bind_survey(m);
  bind_options(m);
  bind_results(m);
  namespace py = pybind11;
  py::class_<PythonScans>(m, "Scans", "Scans of a run.")
      .def(py::init<>())
      .def("add_file", &PythonScans::add_file)
      .def("add_array", &PythonScans::add_array)
      .def("__len__", [](const PythonScans& s) { return s.inputs.size(); });
  m.def("register", [](const PythonScans& scans, const RegistrationOptions& options, int threads, std::uint64_t seed,
                       const std::optional<py::function>& progress) {
    return run_with_progress(progress, threads, seed,
                             [&](const RunContext& context) { return register_scans(scans.inputs, options, context); });
  });
  m.def("write", [](const std::string& folder, bool overwrite, const std::string& format, bool each, double voxel_m,
                    const PythonScans& scans, const Registration& registration, const RegistrationOptions& options,
                    int threads, std::uint64_t seed, const std::optional<py::function>& progress) {
    const RegistrationFolder to{folder, overwrite, {format_of(format), CloudColour::kKeep, each, voxel_m}};
    run_with_progress(progress, threads, seed, [&](const RunContext& context) {
      write_registration(to, scans.inputs, registration, options, context);
      return true;
    });
  });
  m.def("read_points", &read_points);
  m.def("find_scans", &find_scan_names);
  m.def("version", &version);
  m.def("commit", &commit);
  m.def("linked_libraries", &libraries);
}
