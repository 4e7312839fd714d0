#pragma once
// One cloud of a PTX file: a grid of cells, one a line, in the scanner's frame.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input_buffer.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "text_clouds.hpp"

namespace tcm_icp {

class PtxSource : public ScanSource {
 public:
  /// @param input  at the number of columns of the cloud
  explicit PtxSource(InputBuffer input, CloudIs cloud);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;
  std::optional<Eigen::Matrix4d> header_pose() const override { return T_file_scan_; }

 private:
  bool next_fields();
  std::uint64_t read_count(const char* what);
  void read_numbers(std::size_t count, const char* what);
  void read_pose();
  void name_attributes();
  double parse(std::string_view token) const;
  [[noreturn]] void fail(const std::string& problem) const;

  InputBuffer input_;
  CloudIs cloud_;
  std::uint64_t num_cells_ = 0, num_read_ = 0;
  Eigen::Matrix4d T_file_scan_;
  std::vector<Attribute> attributes_;
  bool has_pending_ = false;  ///< the first cell is split on opening, to know the columns
  std::vector<std::string_view> fields_;
  std::vector<double> values_;
};

}  // namespace tcm_icp
