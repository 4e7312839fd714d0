#pragma once
// Where a scan's points come from: a file, a cloud in memory, or a reader of one's own.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// One pass over a scan, one record after the other. The readers of all file formats are such sources; derive from it
/// to read scans from elsewhere.
class ScanSource {
 public:
  virtual ~ScanSource() = default;

  /// What next() fills in beside the coordinates. Names are unique, not empty and without blanks.
  virtual const std::vector<Attribute>& attributes() const = 0;

  /// The next record, finite or not; false at the end. A record that holds no point (an empty cell of a grid, one
  /// marked as invalid) has NaN for coordinates.
  /// @param point       [unit of the source]
  /// @param attributes  attribute_stride() bytes to fill, or nullptr where they are not wanted
  /// @throws InputError  where the points cannot be read
  virtual bool next(Eigen::Vector3d& point, std::byte* attributes) = 0;

  /// What the file says of the scan's place: maps its coordinates into a frame common to the scans of the file. As it
  /// stands there, rigid or not.
  virtual std::optional<Eigen::Matrix4d> header_pose() const { return std::nullopt; }

  /// What the file says of the coordinate system its points are in; empty where it says nothing.
  virtual std::string coordinate_system() const { return {}; }
};

/// A scan to be registered. Its points are read once for the poses and again for the clouds of a result.
struct ScanInput {
  /// Begins a pass over the points: the same points in the same order each time. Called from several threads at once
  /// for different scans.
  using Opener = std::function<std::unique_ptr<ScanSource>()>;

  /// A scan of a file, as ScanReader takes it: "hall.ptx", "hall.ptx#2", "hall.ptx#2#ft".
  ScanInput(std::filesystem::path file) : path(std::move(file)) {}  // NOLINT: a path names a scan

  /// A scan from a source of one's own. Coordinates are in metres.
  /// @param name    what results call it; a relative path without "..", unique among the scans
  /// @param opener  begins a pass
  ScanInput(std::string name, Opener opener) : path(std::move(name)), open(std::move(opener)) {}

  /// Whether it is a file's scan, and not of a source of one's own.
  bool is_file() const { return !open; }

  std::filesystem::path path;  ///< of the file; else the name
  Opener open;                 ///< empty: the file is read
};

/// The points of `cloud`, which are not copied: it has to outlive the input. Normals are not used.
/// @param name   as ScanInput's
/// @param cloud  [m]
ScanInput scan_in_memory(std::string name, const Cloud& cloud);

/// Files as inputs, in their order.
std::vector<ScanInput> scans_in_files(std::span<const std::filesystem::path> files);

}  // namespace tcm_icp
