#include "input_buffer.hpp"

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

namespace {

/// Twice the longest line, so that a whole one always fits beside what is left of the buffer; small files need less.
std::size_t buffer_size(const std::filesystem::path& path) {
  constexpr std::size_t kLargest = 2 * InputBuffer::kMaxLine;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size == 0) return kLargest;  // files of the kernel say 0 and hold something
  return static_cast<std::size_t>(std::min<std::uintmax_t>(size, kLargest));
}

}  // namespace

InputBuffer::InputBuffer(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (!std::filesystem::exists(status)) throw InputError(path_, "", "there is no such file", "check the path");
  if (std::filesystem::is_directory(status)) throw InputError(path_, "", "is a folder", "name the files in it");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path_, "", "is not a regular file", "copy it to one");
  buffer_.resize(buffer_size(path_));
  // Our buffer is the only one: without this every byte is copied twice.
  stream_.rdbuf()->pubsetbuf(nullptr, 0);
  stream_.open(path_, std::ios::binary);
  if (!stream_) throw InputError(path_, "", "cannot be opened", "check its permissions");
  if (!refill()) throw InputError(path_, "", "is empty", "leave it out, or make it again");
}

bool InputBuffer::refill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  stream_.read(reinterpret_cast<char*>(buffer_.data() + end_), static_cast<std::streamsize>(buffer_.size() - end_));
  if (stream_.bad()) throw InputError(path_, byte_place(), "cannot be read", "check the disk");
  const auto count = static_cast<std::size_t>(stream_.gcount());
  end_ += count;
  return count > 0;
}

bool InputBuffer::skip(std::uint64_t n) {
  while (n > 0) {
    if (begin_ == end_ && !refill()) return false;
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(n, end_ - begin_));
    consume(step);
    n -= step;
  }
  return true;
}

bool InputBuffer::next_line(std::string_view& line) {
  std::size_t length = 0, terminator = 1;
  for (;;) {
    const std::size_t available = end_ - begin_;
    const void* const newline =
        available > length ? std::memchr(buffer_.data() + begin_ + length, '\n', available - length) : nullptr;
    length = newline ? static_cast<std::size_t>(static_cast<const std::byte*>(newline) - buffer_.data()) - begin_
                     : available;
    if (length > kMaxLine) {
      throw InputError(path_, "line " + std::to_string(line_number_ + 1), "is longer than 1 MiB",
                       "this is not a text file, or its lines do not end with a line feed");
    }
    if (newline) break;
    if (!refill()) {
      if (length == 0) return false;
      terminator = 0;
      break;
    }
  }
  line = {reinterpret_cast<const char*>(buffer_.data() + begin_), length};
  consume(length + terminator);
  ++line_number_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

}  // namespace tcm_icp
