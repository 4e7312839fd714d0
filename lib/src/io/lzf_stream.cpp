#include "lzf_stream.hpp"

#include <algorithm>
#include <string>

#include "remedies.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

LzfStream::LzfStream(const std::filesystem::path& file, const LzfState& state)
    : file_(file), stream_(open_bytes(file)), state_(state), buffer_(std::size_t{1} << 16U) {
  if (!stream_->seek(state_.input_offset)) {
    throw InputError(file_, "byte " + std::to_string(state_.input_offset), "is not to be reached",
                     "unpack the file first (gunzip), or copy it again");
  }
}

std::byte LzfStream::next_input() {
  if (state_.input_offset == state_.input_end) {
    throw InputError(file_, "byte " + std::to_string(state_.input_offset), "the packed data end within a piece",
                     kDamaged);
  }
  if (begin_ == end_) {
    begin_ = 0;
    end_ = stream_->read(buffer_.data(), buffer_.size());
    if (end_ == 0) {
      throw InputError(file_, "byte " + std::to_string(state_.input_offset), "ends within its packed data", kDamaged);
    }
  }
  ++state_.input_offset;
  return buffer_[begin_++];
}

// A piece is 1 to 32 bytes as they are, or 3 to 264 bytes that occurred at most 8 KiB before.
void LzfStream::next_token() {
  const auto control = std::to_integer<std::size_t>(next_input());
  if (control < 32) {
    state_.literals = control + 1;
    return;
  }
  std::size_t length = control >> 5U;
  if (length == 7) length += std::to_integer<std::size_t>(next_input());
  state_.distance = ((control & 31U) << 8U) + std::to_integer<std::size_t>(next_input()) + 1;
  state_.copies = length + 2;
  if (state_.distance > state_.num_out) {
    throw InputError(file_, "byte " + std::to_string(state_.input_offset),
                     "its packed data refer to before their start", kDamaged);
  }
}

bool LzfStream::read(std::byte* to, std::size_t n) {
  constexpr std::size_t kMask = LzfState::kWindow - 1;
  LzfState& s = state_;
  for (std::size_t done = 0; done < n;) {
    if (s.literals == 0 && s.copies == 0) {
      if (s.input_offset == s.input_end) return false;
      next_token();
    }
    std::size_t& left = s.literals > 0 ? s.literals : s.copies;
    const bool is_literal = s.literals > 0;
    const std::size_t count = std::min(left, n - done);
    for (std::size_t i = 0; i < count; ++i) {
      const std::byte value = is_literal ? next_input() : s.window[(s.num_out - s.distance) & kMask];
      s.window[s.num_out & kMask] = value;
      ++s.num_out;
      if (to) to[done + i] = value;
    }
    left -= count;
    done += count;
  }
  return true;
}

}  // namespace tcm_icp
