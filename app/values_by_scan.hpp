#pragma once
// Options that are given as VALUE for all scans, or as SCAN=VALUE for one.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run_setup.hpp"

namespace tcm_icp::app {

/// The value of each scan: of the last option that names it, and where none does, of the last that stands for all;
/// nothing where there is none either. SCAN is a scan's name, number, path, or the file it is in.
/// @param name   of the option, as "--unit"
/// @param parse  (option, value) -> T, for each that is given; may throw
/// @throws InvalidOptions  no scan is called that
template <typename T, typename Parse>
std::vector<std::optional<T>> values_by_scan(const std::vector<std::string>& options, const std::string& name,
                                             const std::vector<std::filesystem::path>& scans, const Parse& parse) {
  std::vector<std::optional<T>> values(scans.size());
  std::vector<bool> is_named(scans.size(), false);
  for (const auto& option : options) {
    const std::size_t mark = option.rfind('=');
    const bool is_for_all = mark == std::string::npos;
    const T value = parse(option, is_for_all ? option : option.substr(mark + 1));
    if (is_for_all) {
      for (std::size_t i = 0; i < scans.size(); ++i) {
        if (!is_named[i]) values[i] = value;
      }
      continue;
    }
    for (const std::size_t i : scans_called(option.substr(0, mark), scans, name + ' ' + option)) {
      values[i] = value;
      is_named[i] = true;
    }
  }
  return values;
}

}  // namespace tcm_icp::app
