#pragma once
// Random numbers that are the same on every standard library: std's engines are, its distributions are not.

#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace tcm_icp {

using Rng = std::mt19937_64;

/// An independent stream for one stage (and one item of it, e.g. stream_key() of a scan).
Rng make_stream(std::uint64_t seed, std::string_view stage, std::string_view item = {});

/// Uniform in [0, 1), 53 bits.
double uniform01(Rng& rng);

/// Uniform in {0, ..., n - 1}, without modulo bias; n >= 1.
std::uint64_t uniform_index(Rng& rng, std::uint64_t n);

/// Standard normal (Box-Muller; draws two numbers a call).
double standard_normal(Rng& rng);

/// `count` different indices of {0, ..., n - 1} in ascending order; all of them where count >= n. O(n).
std::vector<std::size_t> sample_indices(Rng& rng, std::size_t n, std::size_t count);

}  // namespace tcm_icp
