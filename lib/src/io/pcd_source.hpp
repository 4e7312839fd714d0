#pragma once
// The points of a PCD file, one after the other: ASCII, binary, and compressed field by field.

#include <cstdint>
#include <string_view>
#include <vector>

#include "input_buffer.hpp"
#include "lzf_stream.hpp"
#include "pcd_header.hpp"
#include "tcm_icp/io/scan_source.hpp"

namespace tcm_icp {

class PcdSource : public ScanSource {
 public:
  explicit PcdSource(InputBuffer input);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;

 private:
  /// How one number of a point, or one packed colour, comes out of it.
  struct Column {
    char kind;
    std::size_t size, from, to;  ///< [bytes] of the number; its place in a binary point and in the attributes
    std::size_t word;            ///< its place on an ASCII line
    int axis = -1;               ///< 0, 1, 2 for x, y, z
    int channel = -1;            ///< 0, 1, 2, 3 for red, green, blue, alpha out of a packed colour
  };

  void lay_out();
  void add_numbers(const PcdField& field, std::size_t word);
  void add_colour(const PcdField& field, std::size_t word);
  void check_room() const;
  void open_compressed();
  void read_ascii();
  const std::byte* next_binary();
  const std::byte* next_compressed(bool with_attributes);
  double value_of(const Column& column, const std::byte* record) const;
  double word_value(const Column& column) const;
  [[noreturn]] void fail_truncated() const;
  [[noreturn]] void fail_line(const std::string& problem) const;

  InputBuffer input_;
  PcdHeader header_;
  std::vector<Attribute> attributes_;
  std::vector<Column> columns_;
  std::size_t stride_ = 0, num_words_ = 0;
  char delimiter_ = ' ';
  std::uint64_t num_read_ = 0;
  std::vector<std::string_view> words_;
  std::vector<std::byte> record_;
  std::vector<LzfStream> streams_;  ///< one a field: each stands where the field's numbers are
};

}  // namespace tcm_icp
