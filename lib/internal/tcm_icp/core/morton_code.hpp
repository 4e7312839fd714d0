#pragma once
// Places along Morton's curve: the bits of three coordinates in turn.

#include <cstdint>

namespace tcm_icp {

inline constexpr int kMortonBits = 21;  ///< of a coordinate; three fill 63

/// One bit of three, from the lowest on: those of the first coordinate.
inline constexpr std::uint64_t kMortonAxis = 0x1249249249249249ULL;

/// Each of the lowest 21 bits goes to three times its place.
constexpr std::uint64_t morton_spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffffULL;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2) & kMortonAxis;
}

/// The bits of the first coordinate of a code.
constexpr std::uint64_t morton_gathered(std::uint64_t code) {
  code &= kMortonAxis;
  code = (code | code >> 2) & 0x10c30c30c30c30c3ULL;
  code = (code | code >> 4) & 0x100f00f00f00f00fULL;
  code = (code | code >> 8) & 0x001f0000ff0000ffULL;
  code = (code | code >> 16) & 0x001f00000000ffffULL;
  return (code | code >> 32) & 0x1fffffULL;
}

}  // namespace tcm_icp
