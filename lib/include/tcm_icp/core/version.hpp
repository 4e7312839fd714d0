#pragma once
// Which build of the library this is.

#include <string>
#include <vector>

/// The library: registration of many LiDAR scans by TCM-ICP.
namespace tcm_icp {

/// Version by semantic versioning, "0.1.0".
std::string version();

/// The commit it was built from, with "+" where files had been changed; "unknown" outside a repository.
std::string commit();

/// A library that this one is built on.
struct LinkedLibrary {
  std::string name;     ///< "CGAL"
  std::string version;  ///< of the headers it was compiled with, or of the shared library that runs
};

/// All libraries it is built on, in alphabetical order.
std::vector<LinkedLibrary> linked_libraries();

}  // namespace tcm_icp
