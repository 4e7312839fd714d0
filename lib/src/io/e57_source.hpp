#pragma once
// The points of one scan of an E57 file (ASTM E2807), one after the other.

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "e57_header.hpp"
#include "e57_pages.hpp"
#include "e57_points.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

class E57Source : public ScanSource {
 public:
  /// @param scan  what `pages` has of the scan
  E57Source(E57Pages pages, E57Scan scan, ReadAttributes read_attributes);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;
  std::string coordinate_system() const override { return scan_.coordinate_system; }
  std::optional<Eigen::Matrix4d> header_pose() const override { return scan_.T_file_scan; }

 private:
  std::optional<std::size_t> find(const std::string& name) const;
  bool want_coordinates(const std::array<const char*, 3>& names, const char* state);
  void want_attributes();

  E57Pages pages_;
  E57Scan scan_;
  std::vector<std::size_t> wanted_;  ///< fields: three coordinates, the state where there is one, attributes
  bool is_spherical_ = false, has_state_ = false;
  std::vector<Attribute> attributes_;
  std::unique_ptr<E57Points> points_;
  std::uint64_t num_read_ = 0;
  std::size_t batch_ = 0, in_batch_ = 0;  ///< size of the present batch, next of it
};

}  // namespace tcm_icp
