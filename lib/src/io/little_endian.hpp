#pragma once
// Numbers of little-endian binary formats.

#include <bit>
#include <cstddef>
#include <cstring>

namespace tcm_icp {

static_assert(std::endian::native == std::endian::little, "numbers of files are taken as they lie there");

/// The T at `bytes`, which need no alignment.
template <typename T>
T load(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace tcm_icp
