#pragma once
// Bits that two rows share.

#include <cstdint>
#include <span>

namespace tcm_icp {

/// Number of bits that are set in both; by the processor's instruction, where it has one that counts them.
/// @param a, b  of the same length
std::uint64_t num_common_bits(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b);

/// The same, by any processor.
std::uint64_t num_common_bits_by_words(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b);

}  // namespace tcm_icp
