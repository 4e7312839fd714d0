#pragma once
// One point of the merged cloud as bytes: x y z, scan, colour, then the union of the scans' attributes.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

class MergedRecord {
 public:
  explicit MergedRecord(const std::vector<std::vector<Attribute>>& scan_attributes);

  std::size_t size() const { return size_; }  ///< [bytes]
  std::size_t num_scans() const { return layouts_.size(); }
  std::size_t stride(std::size_t scan) const { return layouts_[scan].stride; }  ///< [bytes] of its points' attributes
  std::string header_properties() const;                                        ///< the lines of the PLY header

  /// Fills `size()` zeroed bytes, little-endian, with a raw point of a scan and its attributes.
  /// @throws InvalidInput  if the moved point is not finite
  void fill(std::size_t scan, const Eigen::Vector3d& point, const std::byte* attributes,
            const Eigen::Isometry3d& T_reference_scan, std::byte* record);

  std::uint64_t num_replaced() const { return num_replaced_; }  ///< attribute values that were not finite and are 0

 private:
  /// Where one of a scan's attributes is read from and goes to.
  struct Copy {
    ScalarType from_type, to_type;
    std::size_t from, to;  ///< [bytes] in the point's attributes, in the record
  };
  struct ScanLayout {
    std::vector<Copy> copies;
    std::optional<std::array<Copy, 3>> normal;  ///< where nx, ny and nz are all there
    std::size_t stride = 0;
  };

  ScanLayout lay_out_scan(const std::vector<Attribute>& attributes, const std::vector<std::size_t>& columns,
                          const std::vector<std::size_t>& column_offsets) const;
  double finite_or_zero(double value, ScalarType type);

  std::vector<Attribute> columns_;
  ScalarType scan_type_;
  std::size_t colour_offset_ = 0, size_ = 0;
  std::vector<ScanLayout> layouts_;
  std::uint64_t num_replaced_ = 0;
};

}  // namespace tcm_icp
