#include "tcm_icp/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tcm_icp {
namespace {

// FNV-1a: std::hash differs between standard libraries.
std::uint64_t hash_text(std::string_view text, std::uint64_t hash) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace

Rng make_stream(std::uint64_t seed, std::string_view stage, std::string_view item) {
  const std::uint64_t stage_hash = hash_text(stage, 0xcbf29ce484222325ULL);
  const std::uint64_t item_hash = hash_text(item, stage_hash ^ 0x9e3779b97f4a7c15ULL);
  std::seed_seq sequence{static_cast<std::uint32_t>(seed),       static_cast<std::uint32_t>(seed >> 32),
                         static_cast<std::uint32_t>(stage_hash), static_cast<std::uint32_t>(stage_hash >> 32),
                         static_cast<std::uint32_t>(item_hash),  static_cast<std::uint32_t>(item_hash >> 32)};
  return Rng(sequence);
}

double uniform01(Rng& rng) { return static_cast<double>(rng() >> 11) * 0x1.0p-53; }

std::uint64_t uniform_index(Rng& rng, std::uint64_t n) {
  // Numbers at or above the largest multiple of n would make the low remainders more likely.
  const std::uint64_t limit = Rng::max() - Rng::max() % n;
  std::uint64_t value = rng();
  while (value >= limit) value = rng();
  return value % n;
}

double standard_normal(Rng& rng) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform01(rng)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform01(rng));
}

std::vector<std::size_t> sample_indices(Rng& rng, std::size_t n, std::size_t count) {
  std::vector<std::size_t> chosen;
  chosen.reserve(std::min(n, count));
  // Selection sampling (Knuth, TAOCP 2, 3.4.2, Algorithm S): ascending order without sorting.
  for (std::size_t i = 0; i < n && chosen.size() < count; ++i) {
    if (count >= n || uniform01(rng) * static_cast<double>(n - i) < static_cast<double>(count - chosen.size())) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

}  // namespace tcm_icp
