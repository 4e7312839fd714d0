#pragma once
// Scans as Python hands them over: file names, and NumPy arrays that are read where they are.

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp::python {

/// N x 3, double, row by row. An array that is so already is not copied.
using PointArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Scans with the arrays they are read from, which have to live as long.
struct PythonScans {
  std::vector<PointArray> arrays;
  std::vector<ScanInput> inputs;

  void add_file(const std::string& file);
  /// @throws InvalidInput  if the array is not N x 3
  void add_array(const std::string& name, const PointArray& points);
};

}  // namespace tcm_icp::python
