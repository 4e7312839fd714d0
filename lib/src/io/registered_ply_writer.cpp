#include "tcm_icp/io/registered_ply_writer.hpp"

#include <fstream>
#include <utility>

#include "merged_record.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kCountDigits = 20;  // of the largest 64-bit number

/// The count and the padding before it always have the same length, so that finish() can overwrite them in place.
std::string count_lines(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  return "comment " + std::string(1 + kCountDigits - digits.size(), '-') + "\nelement vertex " + digits + "\n";
}

/// A file name as a header comment may hold it: on one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = '?';
  }
  return text;
}

}  // namespace

struct RegisteredPlyWriter::Impl {
  Impl(std::filesystem::path file, std::vector<std::vector<Attribute>> attributes, const std::string& reference)
      : path(std::move(file)), scan_attributes(std::move(attributes)), record(scan_attributes) {
    stream.open(path, std::ios::binary | std::ios::trunc);
    if (!stream) throw OutputError(path, "cannot be written", "check that the folder is there and may be written to");
    write_header(reference);
  }

  void write_header(const std::string& reference) {
    const std::string start =
        "ply\nformat binary_little_endian 1.0\ncomment made by tcm-icp\ncomment frame: that of the scan " +
        one_line(reference) + "\ncomment scan: index of the input file, from 0; red green blue: colour by scan\n";
    count_position = static_cast<std::streamoff>(start.size());
    stream << start << count_lines(0) << record.header_properties() << "end_header\n";
    check_stream();
  }

  void check_stream() const {
    if (!stream) throw OutputError(path, "cannot be written", "check the free space on the disk");
  }

  void check_block(std::size_t scan, const PointBlock& block, const std::vector<Attribute>& attributes) const {
    if (scan >= scan_attributes.size()) throw InvalidInput("scan " + std::to_string(scan) + " was not announced");
    if (attributes != scan_attributes[scan] || block.attributes.size() != block.size() * record.stride(scan)) {
      throw InvalidInput("the attributes of scan " + std::to_string(scan) + " are not those announced");
    }
  }

  std::filesystem::path path;
  std::vector<std::vector<Attribute>> scan_attributes;
  MergedRecord record;
  std::ofstream stream;
  std::streamoff count_position = 0;
  std::vector<std::byte> bytes;  ///< of the records of one block
  std::uint64_t num_points = 0;
};

RegisteredPlyWriter::RegisteredPlyWriter(std::filesystem::path path,
                                         std::vector<std::vector<Attribute>> scan_attributes,
                                         const std::string& reference)
    : impl_(std::make_unique<Impl>(std::move(path), std::move(scan_attributes), reference)) {}
RegisteredPlyWriter::~RegisteredPlyWriter() = default;
RegisteredPlyWriter::RegisteredPlyWriter(RegisteredPlyWriter&&) noexcept = default;
RegisteredPlyWriter& RegisteredPlyWriter::operator=(RegisteredPlyWriter&&) noexcept = default;

std::uint64_t RegisteredPlyWriter::num_points() const { return impl_->num_points; }
std::uint64_t RegisteredPlyWriter::num_replaced() const { return impl_->record.num_replaced(); }

void RegisteredPlyWriter::write(std::size_t scan_index, const PointBlock& block,
                                const std::vector<Attribute>& attributes, const Eigen::Isometry3d& T_reference_scan) {
  Impl& impl = *impl_;
  impl.check_block(scan_index, block, attributes);
  const std::size_t stride = impl.record.stride(scan_index), size = impl.record.size();
  impl.bytes.assign(block.size() * size, std::byte{});
  for (std::size_t i = 0; i < block.size(); ++i) {
    impl.record.fill(scan_index, block.points[i], block.attributes.data() + i * stride, T_reference_scan,
                     impl.bytes.data() + i * size);
  }
  impl.stream.write(reinterpret_cast<const char*>(impl.bytes.data()), static_cast<std::streamsize>(impl.bytes.size()));
  impl.check_stream();
  impl.num_points += block.size();
}

void RegisteredPlyWriter::finish() {
  impl_->stream.seekp(impl_->count_position);  // writes what is buffered first
  impl_->stream << count_lines(impl_->num_points);
  impl_->stream.close();  // fails where the last bytes do not find room
  impl_->check_stream();
}

}  // namespace tcm_icp
