#pragma once
// Reads a scan from a file, block by block: PLY and text files of points (docs/formats.md).

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

enum class ReadAttributes { kNo, kYes };

/// Streams the points of one file in file order. Memory is bounded (about 2 MiB and the block), whatever the file's
/// size. The extension decides the format: .ply, or .xyz .txt .asc .pts .csv for text; case does not matter.
class ScanReader {
 public:
  /// Opens the file and reads its header.
  /// @param read_attributes  kNo: coordinates only, attributes() is empty. What stands in a text file's other columns
  /// is
  ///                         checked all the same, so that a first pass over the coordinates finds every damaged line.
  /// @throws InputError  naming file, place, problem and remedy
  explicit ScanReader(const std::filesystem::path& path, ReadAttributes read_attributes = ReadAttributes::kYes);
  ~ScanReader();
  ScanReader(ScanReader&&) noexcept;
  ScanReader& operator=(ScanReader&&) noexcept;

  /// In the order of the file. Names are unique, not empty and without blanks.
  const std::vector<Attribute>& attributes() const;
  std::size_t attribute_stride() const;

  /// Replaces `block` by the next 1 to `max_points` finite points; false (and an empty block) at the end of the file.
  /// @throws InputError      where the file is damaged or truncated
  /// @throws InvalidOptions  if max_points is 0
  bool read(PointBlock& block, std::size_t max_points = 65536);

  std::uint64_t num_points() const;   ///< finite points so far
  std::uint64_t num_dropped() const;  ///< points so far with a NaN or infinite coordinate, left out

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
