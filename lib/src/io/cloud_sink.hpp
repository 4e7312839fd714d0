#pragma once
// Where records of points go: a file of some format.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output_file.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"

namespace tcm_icp {

/// One number of a record.
struct RecordColumn {
  std::string name;
  ScalarType type = ScalarType::kFloat64;
  std::size_t offset = 0;  ///< [bytes] in the record
};

/// Records are packed and in native byte order. The first three columns are x y z, as doubles.
struct RecordLayout {
  std::vector<RecordColumn> columns;
  std::size_t size = 0;     ///< [bytes] of a record
  bool has_scan = false;    ///< column 3 is the scan's index
  bool has_colour = false;  ///< red green blue, uchar or ushort, stand behind x y z and the scan's index
  bool colour_is_by_scan = false;

  std::size_t first_colour() const { return has_scan ? 4 : 3; }
  std::size_t first_attribute() const { return first_colour() + (has_colour ? 3 : 0); }
};

class CloudSink {
 public:
  /// @throws OutputError  if the file cannot be opened
  explicit CloudSink(std::filesystem::path path) : file_(std::move(path)) {}
  virtual ~CloudSink() = default;

  /// @throws OutputError  if the file cannot be written
  virtual void write(const std::byte* records, std::size_t count) = 0;

  /// Writes what is known at the end only, and closes the file. Call once. @throws OutputError
  void finish(std::uint64_t num_points);

 protected:
  virtual void complete(std::uint64_t num_points) = 0;

  void put(const void* bytes, std::size_t size) { file_.put(bytes, size); }
  void put(std::string_view text) { file_.put(text); }
  void go_to(std::uint64_t position) { file_.go_to(position); }
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  OutputFile file_;
};

/// @throws OutputError   if the file cannot be written, or its format cannot hold such points
std::unique_ptr<CloudSink> open_ply(std::filesystem::path path, const RecordLayout& layout,
                                    const RegisteredCloudOptions& options);
std::unique_ptr<CloudSink> open_text(std::filesystem::path path, const RecordLayout& layout);
std::unique_ptr<CloudSink> open_pcd(std::filesystem::path path, const RecordLayout& layout,
                                    const RegisteredCloudOptions& options);
std::unique_ptr<CloudSink> open_las(std::filesystem::path path, const RecordLayout& layout,
                                    const RegisteredCloudOptions& options);

/// A colour of 8 or 16 bits in 8: 65535 becomes 255.
std::uint8_t colour_byte(const std::byte* bytes, ScalarType type);

/// A number of points in a header that may be overwritten in place: a comment before it takes the digits' room.
std::string count_lines(const std::string& comment, const std::string& text, std::uint64_t count);

}  // namespace tcm_icp
