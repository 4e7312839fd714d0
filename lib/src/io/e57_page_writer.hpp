#pragma once
// Writes the pages of an E57 file, each with its check sum.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace tcm_icp {

/// Places are logical: without the check sums. Nothing is kept in memory but a page.
class E57PageWriter {
 public:
  static constexpr std::size_t kPage = 1024, kPayload = 1020;  ///< [bytes]

  /// @throws OutputError  if the file cannot be opened
  explicit E57PageWriter(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t offset() const { return offset_; }  ///< [bytes] of what is put next

  /// @throws OutputError  if the file cannot be written
  void put(const void* bytes, std::size_t size);
  void put(const std::string& text) { put(text.data(), text.size()); }

  /// Replaces bytes that were put before. Done by finish(), since the check sums change.
  void replace_later(std::uint64_t offset, std::string bytes) { replaced_.emplace_back(offset, std::move(bytes)); }

  /// Bytes of the file, once it is finished.
  std::uint64_t physical_size() const { return (offset_ + kPayload - 1) / kPayload * kPage; }

  /// Fills the last page and closes the file. Call once. @throws OutputError
  void finish();

  static std::uint64_t physical(std::uint64_t logical) { return logical / kPayload * kPage + logical % kPayload; }

 private:
  void write_page(std::byte* page);
  void replace(std::uint64_t offset, const std::string& bytes);
  void check() const;

  std::filesystem::path path_;
  std::fstream stream_;
  std::vector<std::byte> page_;
  std::uint64_t offset_ = 0;
  std::vector<std::pair<std::uint64_t, std::string>> replaced_;
};

}  // namespace tcm_icp
