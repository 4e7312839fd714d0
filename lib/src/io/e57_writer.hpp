#pragma once
// Writes an E57 file (ASTM E2807-11): scans with points in frames of their own, and the pose of each in the file's.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cloud_sink.hpp"
#include "e57_page_writer.hpp"
#include "e57_xml.hpp"
#include "posed_scans_sink.hpp"

namespace tcm_icp {

/// Attributes that E57 has no field for are written with this prefix, as its rules for extensions have it.
inline constexpr const char* kE57Prefix = "tcm:";

class E57Writer : public PosedScansSink {
 public:
  /// @throws OutputError  if the file cannot be opened
  explicit E57Writer(std::filesystem::path path);

  /// @throws OutputError  also if a scan has more columns than a packet of the format can hold
  void begin_scan(const std::string& name, const Eigen::Isometry3d& T_file_scan, const RecordLayout& layout) override;
  void write(const std::byte* records, std::size_t count) override;
  void finish(const std::string& description, const std::string& coordinate_system) override;

 private:
  struct Scan : E57WrittenScan {
    std::size_t record_size = 0;
    std::size_t packet_points = 0;       ///< points in a full packet
    std::uint64_t offset = 0;            ///< of its section, logical
    std::vector<std::uint64_t> packets;  ///< where each begins, logical
  };

  static E57Column column_of(const RecordColumn& record, const std::vector<E57Column>& others);
  void check_size(Scan& scan) const;
  void write_packet(const std::byte* records, std::size_t count);
  void end_scan();
  void write_index(const Scan& scan);

  E57PageWriter pages_;
  std::vector<Scan> scans_;
  std::vector<std::byte> waiting_;  ///< records of the packet to come
  std::string packet_;
};

}  // namespace tcm_icp
