#pragma once
// Binary files put together by hand.

#include <algorithm>
#include <string>

#include "io/ply_text.hpp"

namespace tcm_icp::test {

/// The bytes of all values, one behind the other, little-endian.
template <typename... T>
std::string joined(T... values) {
  std::string bytes;
  (bytes.append(bytes_of(values)), ...);
  return bytes;
}

/// `text` and as many zeros as make it `size` bytes.
inline std::string padded(const std::string& text, std::size_t size) {
  std::string out(size, '\0');
  std::copy_n(text.begin(), std::min(size, text.size()), out.begin());
  return out;
}

/// Overwrites bytes of `content` from `at` on.
template <typename T>
void put(std::string& content, std::size_t at, T value) {
  content.replace(at, sizeof(T), bytes_of(value));
}

}  // namespace tcm_icp::test
