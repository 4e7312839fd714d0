#pragma once
// Where scans go that keep their own frames: a file of a format that has a pose for each.

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "cloud_sink.hpp"

namespace tcm_icp {

class PosedScansSink {
 public:
  PosedScansSink() = default;
  virtual ~PosedScansSink() = default;
  PosedScansSink(const PosedScansSink&) = delete;
  PosedScansSink& operator=(const PosedScansSink&) = delete;

  /// Ends the scan before. @throws OutputError  if the file cannot be written, or its format cannot hold such points
  virtual void begin_scan(const std::string& name, const Eigen::Isometry3d& T_file_scan,
                          const RecordLayout& layout) = 0;

  /// Appends points of the present scan: records of its layout, with coordinates in its own frame. @throws OutputError
  virtual void write(const std::byte* records, std::size_t count) = 0;

  /// Ends the last scan and closes the file. Call once. @throws OutputError
  /// @param description        of every scan, for a person
  /// @param coordinate_system  well-known text; empty: not told
  virtual void finish(const std::string& description, const std::string& coordinate_system) = 0;
};

/// @throws OutputError  if the file cannot be opened
std::unique_ptr<PosedScansSink> open_ptx(std::filesystem::path path);

}  // namespace tcm_icp
