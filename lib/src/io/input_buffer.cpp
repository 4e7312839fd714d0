#include "input_buffer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

InputBuffer::InputBuffer(std::filesystem::path path) : path_(std::move(path)), stream_(open_bytes(path_)) {
  // Twice the longest line, so that a whole one always fits beside what is left of the buffer; small files need less.
  constexpr std::size_t kLargest = 2 * kMaxLine;
  buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size().value_or(kLargest), kLargest)));
  if (!refill()) throw InputError(path_, "", "is empty", "leave it out, or make it again");
}

bool InputBuffer::refill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const std::size_t count = stream_->read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += count;
  return count > 0;
}

std::string_view InputBuffer::head(std::size_t n) {
  while (end_ - begin_ < n && refill()) continue;
  return {reinterpret_cast<const char*>(buffer_.data() + begin_), std::min(n, end_ - begin_)};
}

void InputBuffer::skip_to(std::uint64_t offset, std::uint64_t lines_before) {
  skip(offset - offset_);
  line_number_ = lines_before;
}

bool InputBuffer::skip(std::uint64_t n) {
  if (n > buffer_.size() && size() && n <= *size() - offset_ && stream_->seek(offset_ + n)) {
    offset_ += n;
    begin_ = end_ = 0;
    return true;
  }
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
