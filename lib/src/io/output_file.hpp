#pragma once
// A file that is written from its beginning on, with places that are filled in later.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace tcm_icp {

class OutputFile {
 public:
  /// @throws OutputError  if the file cannot be opened
  explicit OutputFile(std::filesystem::path path);

  /// @throws OutputError  if the file cannot be written
  void put(const void* bytes, std::size_t size);
  void put(std::string_view text) { put(text.data(), text.size()); }

  std::uint64_t position();  ///< [bytes] from the beginning
  void go_to(std::uint64_t position);

  /// Call once. @throws OutputError
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  void check() const;  ///< throws OutputError where a write failed

  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace tcm_icp
