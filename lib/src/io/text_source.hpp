#pragma once
// The points of a text file, one a line: .xyz .txt .asc .pts .csv; or of one of its clouds, where each has a count.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input_buffer.hpp"
#include "tcm_icp/io/scan_source.hpp"
#include "text_clouds.hpp"

namespace tcm_icp {

class TextSource : public ScanSource {
 public:
  /// @param input  at the start of a cloud
  explicit TextSource(InputBuffer input, CloudIs cloud = CloudIs::kAll);

  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override;

 private:
  void read_start();
  bool take_header(std::string_view line);
  bool take_count(std::string_view line);
  void take_first_record(std::string_view line);
  void refuse_commas_for_both(std::string_view first_line);
  void name_attributes();
  bool next_content_line(std::string_view& line);
  bool begins_next_cloud(std::string_view line) const;
  void parse_record(std::string_view line);
  std::optional<double> parse_field(std::string_view field);
  void find_byte_colours();
  void check_colours() const;
  void check_count() const;
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  InputBuffer input_;
  CloudIs cloud_;
  char delimiter_ = ' ';
  char decimal_ = '\0';              ///< '.' or ',', once one has been seen
  std::string number_;               ///< a field whose comma has become a point
  std::vector<std::string> header_;  ///< names of the columns; empty where the file has none
  bool header_is_comment_ = false;
  std::optional<std::uint64_t> promised_;  ///< points, by the count line
  std::size_t num_columns_ = 0;            ///< 0 until the first record
  std::array<std::size_t, 3> axis_columns_ = {0, 1, 2};
  std::vector<Attribute> attributes_;
  std::vector<std::size_t> attribute_columns_;
  bool has_pending_ = false;  ///< the first record is parsed on opening, and given by the first next()
  bool is_finished_ = false;
  std::uint64_t num_read_ = 0;
  std::vector<std::string_view> fields_;
  std::vector<double> values_;
};

}  // namespace tcm_icp
