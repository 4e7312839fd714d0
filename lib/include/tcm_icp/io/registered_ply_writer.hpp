#pragma once
// The merged cloud, streamed into one binary PLY (docs/formats.md).

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// Writes registered.ply: double x y z in the reference scan's frame, the scan's index, a colour by scan, then the
/// union of the inputs' attributes. Memory is that of a block. Until finish() the header says 0 vertices.
class RegisteredPlyWriter {
 public:
  /// @param scan_attributes  the attributes of every scan that may be written, by scan index. Attributes of one name
  /// share
  ///                         a column, wide enough for each scan's type. Names this file uses itself (red green blue
  ///                         alpha scan) get "input_" in front.
  /// @param reference        name of the reference scan, for a comment in the header
  /// @throws OutputError     if the file cannot be opened or written
  RegisteredPlyWriter(std::filesystem::path path, std::vector<std::vector<Attribute>> scan_attributes,
                      const std::string& reference);
  ~RegisteredPlyWriter();
  RegisteredPlyWriter(RegisteredPlyWriter&&) noexcept;
  RegisteredPlyWriter& operator=(RegisteredPlyWriter&&) noexcept;

  /// Appends a block of raw points of one scan, moved by T_reference_scan; attributes nx ny nz are rotated. Attributes
  /// the scan does not have are 0. A NaN or infinite attribute value becomes 0 and is counted.
  /// @throws InvalidInput  if the scan index, the attributes or the size of the block are not those announced, or a
  ///                       coordinate is not finite
  /// @throws OutputError   if the file cannot be written (disk full)
  void write(std::size_t scan_index, const PointBlock& block, const std::vector<Attribute>& attributes,
             const Eigen::Isometry3d& T_reference_scan);

  /// Writes the number of points into the header and closes the file. Call once.
  /// @throws OutputError  if the file cannot be written
  void finish();

  std::uint64_t num_points() const;
  std::uint64_t num_replaced() const;  ///< attribute values that were not finite and are 0 now

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
