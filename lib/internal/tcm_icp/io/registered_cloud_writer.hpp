#pragma once
// Points of registered scans, streamed into a file of some format (docs/formats.md).

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tcm_icp/io/output_options.hpp"
#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// ".ply", ".las", ".pcd", ".xyz", ".e57", ".ptx".
std::string_view extension_of(CloudFormat format);

/// Whether a file of this format has each scan in its own frame with its pose.
bool keeps_scans_apart(CloudFormat format);

/// Whether a file of this format must be told before its first point how far its points reach.
bool needs_box(CloudFormat format);

struct RegisteredCloudOptions {
  CloudFormat format = CloudFormat::kPly;
  CloudColour colour = CloudColour::kKeep;
  std::string reference = {};  ///< name of the reference scan, for a comment in the header
  std::string frame = {};      ///< what defines the frame where it is not the reference scan, for the same
  /// Coordinate system of the frame: a comment in PLY; in LAS and E57 where its well-known text is given or known.
  std::string crs = {};
  /// The file is for one scan alone: no column for its index, and with kKeep no colour that it does not have.
  bool one_scan = false;
  std::uint16_t point_source_id = 0;  ///< LAS, one_scan: where the scan has no column of that name
  /// LAS, PCD: of the points as they will be written; empty where there are none.
  Eigen::AlignedBox3d box = Eigen::AlignedBox3d();
  /// [unit of the scans] How coarsely coordinates may be rounded: LAS refuses, PCD turns from floats to doubles.
  double largest_step = std::numeric_limits<double>::infinity();
  /// LAS: what becomes 0 and 65535 in the field of that name where intensities are not its type.
  double least_intensity = 0, most_intensity = 65535;
  std::vector<std::string> scan_names = {};  ///< E57: by scan index; "scan 1" where it is shorter
};

/// Whether a LAS file can name this coordinate system.
bool las_names_crs(const std::string& crs);

/// Whether a PCD of these points has coordinates as doubles, which PCL does not take for its points.
bool pcd_needs_doubles(const Eigen::AlignedBox3d& box, double largest_step);

/// Writes x y z in the reference scan's frame, the scan's index, a colour, then the union of the inputs' attributes.
/// In E57 and PTX each scan is one of the file instead, in its own frame with its pose and its own attributes (in PTX
/// intensity alone) and colour.
/// Memory is that of a block. Until finish() the header says 0 points.
class RegisteredCloudWriter {
 public:
  /// @param scan_attributes  the attributes of every scan that may be written, by scan index. Attributes of one name
  ///                         share a column, wide enough for each scan's type. Names this file uses itself (red green
  ///                         blue alpha scan) get "input_" in front. Colours of 8 bits are multiplied by 257 where
  ///                         other scans have 16.
  /// @throws OutputError     if the file cannot be opened or written, or the format cannot hold such points
  RegisteredCloudWriter(std::filesystem::path path, std::vector<std::vector<Attribute>> scan_attributes,
                        const RegisteredCloudOptions& options);
  ~RegisteredCloudWriter();
  RegisteredCloudWriter(RegisteredCloudWriter&&) noexcept;
  RegisteredCloudWriter& operator=(RegisteredCloudWriter&&) noexcept;

  /// Appends a block of raw points of one scan, moved by T_reference_scan; attributes nx ny nz are rotated. Attributes
  /// the scan does not have are 0. A NaN or infinite attribute value becomes 0 and is counted. In E57 and
  /// PTX nothing is moved, and a scan that comes again behind others is one more of the file ("name (2)").
  /// @throws InvalidInput  if the scan index, the attributes or the size of the block are not those announced, or a
  ///                       coordinate is not finite
  /// @throws OutputError   if the file cannot be written (disk full), or its format has no room for a value
  void write(std::size_t scan_index, const PointBlock& block, const std::vector<Attribute>& attributes,
             const Eigen::Isometry3d& T_reference_scan);

  /// Writes the number of points into the header and closes the file. Call once.
  /// @throws OutputError  if the file cannot be written
  void finish();

  std::uint64_t num_points() const;
  std::uint64_t num_replaced() const;  ///< attribute values that were not finite and are 0 now

 private:
  struct Impl;
  struct OneCloud;
  struct ScansWithPoses;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tcm_icp
