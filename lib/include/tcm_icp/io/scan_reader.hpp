#pragma once
// Reads a scan from a file, block by block (docs/formats.md lists the formats).

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/io/point_block.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

/// Whether a point's attributes are read beside its coordinates.
enum class ReadAttributes {
  kNo,  ///< coordinates only
  kYes  ///< attributes, too
};

/// Streams the points of one scan in file order. Memory is bounded (about 2 MiB and the block), whatever the file's
/// size. What is in the file decides the format, and its extension where that does not tell; gzip'd files are unpacked.
class ScanReader {
 public:
  /// Opens the file and reads its header.
  /// @param path             a file of one scan, or one scan of a file: "hall.ptx#2"; with the unit of its coordinates
  ///                         where they are not metres: "hall.ptx#2#ft" (scan_path.hpp). Points come in metres.
  /// @param read_attributes  kNo: coordinates only, attributes() is empty. What stands in a text file's other columns
  ///                         is checked all the same, so that a first pass over the coordinates finds every damaged
  ///                         line.
  /// @throws InputError  naming file, place, problem and remedy
  explicit ScanReader(const std::filesystem::path& path, ReadAttributes read_attributes = ReadAttributes::kYes);

  /// The same of a scan from any source. What a source of one's own throws comes through.
  explicit ScanReader(const ScanInput& scan, ReadAttributes read_attributes = ReadAttributes::kYes);
  ~ScanReader();
  /// Goes on where the other was, which may only be destroyed or assigned to.
  ScanReader(ScanReader&&) noexcept;
  /// The same.
  ScanReader& operator=(ScanReader&&) noexcept;

  /// In the order of the file. Names are unique, not empty and without blanks.
  const std::vector<Attribute>& attributes() const;
  std::size_t attribute_stride() const;  ///< bytes of one point's attributes

  /// Replaces `block` by the next 1 to `max_points` finite points; false (and an empty block) at the end of the file.
  /// @throws InputError      where the file is damaged or truncated
  /// @throws InvalidOptions  if max_points is 0
  bool read(PointBlock& block, std::size_t max_points = 65536);

  std::uint64_t num_points() const;  ///< finite points so far
  /// Records so far that were left out: a NaN or infinite coordinate, an empty cell of a grid, marked as invalid.
  std::uint64_t num_dropped() const;

  /// What the file says of the scan's place: maps raw coordinates into the frame of the file (PTX, E57). Not applied to
  /// any point. nullopt where the format has none, or the file does not say.
  /// @throws InputError  if it is not rigid to 1e-3
  std::optional<Eigen::Isometry3d> header_pose() const;

  /// What the file says of the coordinate system its points are in (LAS, E57): "EPSG:26917", well-known text, or what
  /// else stands there. Empty where the file says nothing.
  std::string coordinate_system() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
