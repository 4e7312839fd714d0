#include "tcm_icp/core/version.hpp"

#include <CGAL/version.h>
#include <fftw3.h>
#include <glpk.h>
#include <tbb/version.h>
#include <zlib.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "build_commit.hpp"

namespace tcm_icp {
namespace {

std::string dotted(int a, int b, int c) {
  return std::to_string(a) + "." + std::to_string(b) + "." + std::to_string(c);
}

// "fftw-3.3.10-sse2-avx": the number alone.
std::string fftw_number() {
  const std::string text = fftwf_version;
  const std::size_t begin = text.find('-') + 1;
  return text.substr(begin, text.find('-', begin) - begin);
}

std::string pugixml_number() {
  return std::to_string(PUGIXML_VERSION / 1000) + "." + std::to_string(PUGIXML_VERSION % 1000 / 10);
}

}  // namespace

std::string version() { return kVersion; }

std::string commit() { return kCommit; }

std::vector<LinkedLibrary> linked_libraries() {
  return {
      {"CGAL", CGAL_VERSION_STR},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"FFTW", fftw_number()},
      {"GLPK", glp_version()},
      {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"oneTBB", dotted(TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH)},
      {"pugixml", pugixml_number()},
      {"zlib", zlibVersion()}};
}

}  // namespace tcm_icp
