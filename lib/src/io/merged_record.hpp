#pragma once
// One point of a registered cloud as bytes: x y z, scan, colour, then the union of the scans' attributes.

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloud_sink.hpp"
#include "merged_columns.hpp"

namespace tcm_icp {

class MergedRecord {
 public:
  MergedRecord(const std::vector<std::vector<Attribute>>& scan_attributes, CloudColour colour, bool one_scan);

  const RecordLayout& layout() const { return layout_; }
  std::size_t stride(std::size_t scan) const { return layouts_[scan].stride; }  ///< [bytes] of its points' attributes

  /// Fills the zeroed bytes of a record with a raw point of a scan and its attributes.
  /// @throws InvalidInput  if the moved point is not finite
  void fill(std::size_t scan, const Eigen::Vector3d& point, const std::byte* attributes,
            const Eigen::Isometry3d& T_reference_scan, std::byte* record);

  std::uint64_t num_replaced() const { return num_replaced_; }  ///< attribute values that were not finite and are 0

 private:
  /// Where one of a scan's attributes is read from and goes to.
  struct Copy {
    ScalarType from_type, to_type;
    std::size_t from, to;  ///< [bytes] in the point's attributes, in the record
    double factor = 1;
  };
  struct ScanLayout {
    std::vector<Copy> copies;
    std::optional<std::array<Copy, 3>> normal;  ///< where nx, ny and nz are all there
    std::size_t stride = 0;
  };

  void add_column(const std::string& name, ScalarType type);
  ScanLayout lay_out_scan(const std::vector<Attribute>& attributes, const std::vector<std::size_t>& columns) const;
  double finite_or_zero(double value, ScalarType type);

  RecordLayout layout_;
  std::size_t first_column_ = 0;  ///< of the scans' own
  std::vector<ScanLayout> layouts_;
  std::uint64_t num_replaced_ = 0;
};

}  // namespace tcm_icp
