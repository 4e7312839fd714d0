#pragma once
// The vertices of a PLY file, one after the other.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input_buffer.hpp"
#include "ply_header.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

class PlySource : public ScanSource {
 public:
  explicit PlySource(InputBuffer input);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;

 private:
  /// A scalar property: where its bytes stand in a record without lists, and where they go.
  struct Field {
    ScalarType type;
    std::size_t record_offset;
    int axis;                      ///< 0, 1, 2 for x, y, z; -1 for an attribute
    std::size_t attribute_offset;  ///< in one point's attributes; unused for an axis
  };

  void lay_out_fields();
  void skip_element(const PlyElement& element);
  const std::byte* next_binary_record(const PlyElement& element);
  bool gather_record(const PlyElement& element);
  bool skip_list(const PlyProperty& property);
  void next_ascii_fields(const PlyElement& element);
  void read_binary(Eigen::Vector3d& point, std::byte* attributes);
  void read_ascii(Eigen::Vector3d& point, std::byte* attributes);
  double parse(std::string_view token) const;
  [[noreturn]] void fail_line(const std::string& problem) const;
  [[noreturn]] void fail_truncated(const PlyElement& element) const;

  InputBuffer input_;
  PlyHeader header_;
  std::vector<Field> fields_;
  std::vector<Attribute> attributes_;
  std::uint64_t num_read_ = 0;     ///< records of the present element
  std::size_t record_size_ = 0;    ///< [bytes] of a vertex without its lists
  std::vector<std::byte> record_;  ///< a record gathered from between its lists
  std::vector<std::string_view> tokens_, scalars_;
};

}  // namespace tcm_icp
