#pragma once
// The bytes of a file, one after the other, unpacked where it is gzip'd.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

namespace tcm_icp {

class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// Up to `n` bytes; 0 at the end only. @throws InputError  if the disk fails, or the packed data are damaged
  virtual std::size_t read(std::byte* to, std::size_t n) = 0;

  /// Goes on at this byte, if that is cheaper than reading up to it; false where it is not.
  virtual bool seek(std::uint64_t offset) = 0;

  /// [bytes] of the file; nullopt where only unpacking could tell, or the kernel does not say.
  virtual std::optional<std::uint64_t> size() const = 0;
};

/// @throws InputError  if the file is missing, is no regular file or cannot be opened
std::unique_ptr<ByteStream> open_bytes(const std::filesystem::path& path);

}  // namespace tcm_icp
