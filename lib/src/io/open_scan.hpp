#pragma once
// From the name of a scan to the source of its records.

#include <cstddef>
#include <filesystem>
#include <memory>

#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

/// Opens the one scan that `path` names. @throws InputError
std::unique_ptr<ScanSource> open_scan(const std::filesystem::path& path, ReadAttributes read_attributes);

/// Scans in a file, at least 1. @throws InputError  if it cannot be read, is of no known format, or holds none
std::size_t count_scans(const std::filesystem::path& file);

}  // namespace tcm_icp
