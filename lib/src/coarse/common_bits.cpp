#include "common_bits.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace tcm_icp {
namespace {

// Number of bits of each byte. std::popcount is a call per word where the processor's own is not asked for; bytes can
// be summed by the compiler's vectors.
std::uint64_t bits_per_byte(std::uint64_t x) {
  x -= (x >> 1U) & 0x5555555555555555U;
  x = (x & 0x3333333333333333U) + ((x >> 2U) & 0x3333333333333333U);
  return (x + (x >> 4U)) & 0x0f0f0f0f0f0f0f0fU;
}

// Sum of the bytes, each at most 255.
std::uint64_t sum_of_bytes(std::uint64_t x) {
  x = (x & 0x00ff00ff00ff00ffU) + ((x >> 8U) & 0x00ff00ff00ff00ffU);
  return (x * 0x0001000100010001U) >> 48U;
}

constexpr std::size_t kWordsPerSum = 31;  // 31 times 8 bits fit a byte

#if defined(__x86_64__)
__attribute__((target("popcnt"))) std::uint64_t num_common_bits_by_instruction(std::span<const std::uint64_t> a,
                                                                               std::span<const std::uint64_t> b) {
  std::uint64_t total = 0;
  for (std::size_t w = 0; w < a.size(); ++w) total += static_cast<std::uint64_t>(std::popcount(a[w] & b[w]));
  return total;
}
#endif

}  // namespace

std::uint64_t num_common_bits_by_words(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
  std::uint64_t total = 0;
  for (std::size_t first = 0; first < a.size(); first += kWordsPerSum) {
    const std::size_t end = std::min(a.size(), first + kWordsPerSum);
    std::uint64_t bytes = 0;
    for (std::size_t w = first; w < end; ++w) bytes += bits_per_byte(a[w] & b[w]);
    total += sum_of_bytes(bytes);
  }
  return total;
}

std::uint64_t num_common_bits(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
#if defined(__x86_64__)
  static const bool has_instruction = __builtin_cpu_supports("popcnt") != 0;
  if (has_instruction) return num_common_bits_by_instruction(a, b);
#endif
  return num_common_bits_by_words(a, b);
}

}  // namespace tcm_icp
