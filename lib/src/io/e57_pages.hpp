#pragma once
// The bytes of an E57 file without the check sums of its pages, each of which is checked.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "byte_stream.hpp"

namespace tcm_icp {

/// Places in an E57 file are physical (bytes of the file) or logical (without check sums).
class E57Pages {
 public:
  /// Reads the file's header. @throws InputError  no E57 file, of an unknown version, cut off
  explicit E57Pages(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t xml_offset() const { return xml_offset_; }  ///< [bytes] physical
  std::uint64_t xml_length() const { return xml_length_; }  ///< [bytes] logical, at most that of the file
  std::uint64_t logical_size() const { return num_pages_ * payload_; }

  /// @throws InputError  if it lies behind the file's end, or in a check sum
  std::uint64_t logical(std::uint64_t physical_offset, const std::string& what) const;

  /// Goes on at this byte. @param offset  [bytes] logical
  void seek(std::uint64_t offset) { at_ = offset; }
  std::uint64_t offset() const { return at_; }  ///< [bytes] logical

  /// The next `n` bytes. @throws InputError  where the file ends before, or a page is damaged
  void read(std::byte* to, std::size_t n);

 private:
  void load_page(std::uint64_t page);
  void read_header();
  [[noreturn]] void fail(const std::string& place, const std::string& problem) const;

  std::filesystem::path path_;
  std::unique_ptr<ByteStream> stream_;
  std::uint64_t size_ = 0, num_pages_ = 0, xml_offset_ = 0, xml_length_ = 0;
  std::size_t page_size_ = 0, payload_ = 0;  ///< [bytes] of a page, without its check sum
  std::vector<std::byte> pages_;             ///< several at once, checked
  std::uint64_t first_loaded_ = 0, num_loaded_ = 0;
  std::uint64_t stream_at_ = 0;  ///< [bytes] physical, where the stream stands
  std::uint64_t at_ = 0;
};

/// CRC-32C (Castagnoli), as iSCSI and E57 have it.
std::uint32_t crc32c(const std::byte* bytes, std::size_t n);

/// The same without the processor's help.
std::uint32_t crc32c_by_table(const std::byte* bytes, std::size_t n);

}  // namespace tcm_icp
