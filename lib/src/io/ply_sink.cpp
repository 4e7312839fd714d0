// Binary little-endian PLY: the records as they are.

#include "cloud_sink.hpp"
#include "scalar.hpp"

namespace tcm_icp {
namespace {

/// A file name as a header comment may hold it: on one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = '?';
  }
  return text;
}

std::string comments(const RecordLayout& layout, const RegisteredCloudOptions& options) {
  std::string text =
      "comment frame: " +
      one_line(options.frame.empty() ? "that of the scan " + options.reference : "survey frame by " + options.frame) +
      '\n';
  if (!options.crs.empty()) text += "comment coordinate system: " + one_line(options.crs) + '\n';
  const std::string colour = layout.colour_is_by_scan ? "colour by scan" : "colour of the input";
  if (layout.has_scan) text += "comment scan: index of the input file, from 0; red green blue: " + colour + '\n';
  return text;
}

class PlySink : public CloudSink {
 public:
  PlySink(std::filesystem::path path, const RecordLayout& layout, const RegisteredCloudOptions& options)
      : CloudSink(std::move(path)), record_size_(layout.size) {
    const std::string start =
        "ply\nformat binary_little_endian 1.0\ncomment made by tcm-icp\n" + comments(layout, options);
    count_position_ = start.size();
    put(start + count(0));
    for (const auto& column : layout.columns) {
      put("property " + std::string(ply_type_name(column.type)) + ' ' + column.name + '\n');
    }
    put("end_header\n");
  }

  void write(const std::byte* records, std::size_t count) override { put(records, count * record_size_); }

 private:
  static std::string count(std::uint64_t num) { return count_lines("comment", "element vertex", num); }

  void complete(std::uint64_t num_points) override {
    go_to(count_position_);
    put(count(num_points));
  }

  std::size_t record_size_;
  std::uint64_t count_position_ = 0;
};

}  // namespace

std::unique_ptr<CloudSink> open_ply(std::filesystem::path path, const RecordLayout& layout,
                                    const RegisteredCloudOptions& options) {
  return std::make_unique<PlySink>(std::move(path), layout, options);
}

}  // namespace tcm_icp
