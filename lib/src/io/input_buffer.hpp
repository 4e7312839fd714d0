#pragma once
// Big buffered reads of a file, as bytes or as lines, in bounded memory; of what is in it, where it is gzip'd.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "byte_stream.hpp"

namespace tcm_icp {

class InputBuffer {
 public:
  static constexpr std::size_t kMaxLine = std::size_t{1} << 20;  ///< [bytes] longest line, and longest peek

  /// @throws InputError  if the file is missing, is no regular file, is empty, cannot be opened or unpacked
  explicit InputBuffer(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// The next `n` <= kMaxLine bytes without taking them, valid until the next call; nullptr where the file ends before.
  const std::byte* peek(std::size_t n) {
    while (end_ - begin_ < n) {
      if (!refill()) return nullptr;
    }
    return buffer_.data() + begin_;
  }

  /// The first of the bytes not yet taken, at most `n` <= kMaxLine of them; valid until the next call.
  std::string_view head(std::size_t n);

  /// Takes `n` bytes that peek() has shown.
  void consume(std::size_t n) {
    begin_ += n;
    offset_ += n;
  }

  /// Takes `n` bytes; false where the file ends before. Where much is to be skipped, it is not read.
  bool skip(std::uint64_t n);

  /// Takes what is before `offset`, which is not behind offset(), and counts lines from `lines_before` on.
  void skip_to(std::uint64_t offset, std::uint64_t lines_before);

  /// [bytes] of the file; nullopt where only unpacking could tell.
  std::optional<std::uint64_t> size() const { return stream_->size(); }

  /// The next line without its end (LF or CRLF), valid until the next call; false at the end of the file.
  /// @throws InputError  if it is longer than kMaxLine
  bool next_line(std::string_view& line);

  std::uint64_t offset() const { return offset_; }            ///< bytes taken
  std::uint64_t line_number() const { return line_number_; }  ///< of the line next_line() gave last, from 1

  std::string line_place() const { return "line " + std::to_string(line_number_); }
  std::string byte_place() const { return "byte " + std::to_string(offset_); }

 private:
  bool refill();

  std::filesystem::path path_;
  std::unique_ptr<ByteStream> stream_;
  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what is read and not yet taken: buffer_[begin_, end_)
  std::uint64_t offset_ = 0, line_number_ = 0;
};

}  // namespace tcm_icp
