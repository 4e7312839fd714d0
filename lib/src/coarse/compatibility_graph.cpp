#include "compatibility_graph.hpp"

#include <algorithm>
#include <numeric>

namespace tcm_icp {
namespace {

// A column each of x, y, z: contiguous, so that rows of the graph are computed by vectors.
using Coordinates = Eigen::Array<float, Eigen::Dynamic, 3>;
using Row = Eigen::ArrayXf;

// Distances from point i to those after it.
void distances_from(const Coordinates& points, Eigen::Index i, Row& out) {
  const Eigen::Index n = points.rows() - i - 1;
  out.head(n) = ((points.col(0).tail(n) - points(i, 0)).square() + (points.col(1).tail(n) - points(i, 1)).square() +
                 (points.col(2).tail(n) - points(i, 2)).square())
                    .sqrt();
}

// Cosines, without sign, of axis i with those after it.
auto cosines_with(const Coordinates& axes, Eigen::Index i) {
  const Eigen::Index n = axes.rows() - i - 1;
  return (axes.col(0).tail(n) * axes(i, 0) + axes.col(1).tail(n) * axes(i, 1) + axes.col(2).tail(n) * axes(i, 2)).abs();
}

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

}  // namespace

int CompatibilityGraph::num_common(std::size_t i, std::size_t j) const {
  const std::uint64_t* a = row(i);
  const std::uint64_t* b = row(j);
  std::uint64_t total = 0;
  for (std::size_t first = 0; first < words_; first += kWordsPerSum) {
    const std::size_t end = std::min(words_, first + kWordsPerSum);
    std::uint64_t bytes = 0;
    for (std::size_t w = first; w < end; ++w) bytes += bits_per_byte(a[w] & b[w]);
    total += sum_of_bytes(bytes);
  }
  return static_cast<int>(total);
}

std::size_t CompatibilityGraph::num_joined(std::size_t i) const {
  return std::accumulate(row(i), row(i) + words_, std::size_t{0}, [](std::size_t sum, std::uint64_t word) {
    return sum + static_cast<std::size_t>(std::popcount(word));
  });
}

CompatibilityGraph::CompatibilityGraph(const MatchedPoints& matches, float tolerance, float min_length,
                                       float normal_tolerance)
    : size_(static_cast<std::size_t>(matches.size())), words_((size_ + 63) / 64), bits_(size_ * words_, 0) {
  const Coordinates target = matches.target.transpose(), source = matches.source.transpose();
  const Coordinates target_normal = matches.target_normal.transpose();
  const Coordinates source_normal = matches.source_normal.transpose();
  const auto num_rows = static_cast<Eigen::Index>(size_);
  Row a(num_rows), b(num_rows), excess(num_rows);
  for (std::size_t i = 0; i < size_; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Eigen::Index n = num_rows - k - 1;
    distances_from(target, k, a);
    distances_from(source, k, b);
    // The largest of the three, each below 0 where it holds: one number to look at.
    excess.tail(n) =
        ((a.head(n) - b.head(n)).abs() - tolerance)
            .max((cosines_with(target_normal, k) - cosines_with(source_normal, k)).abs() - normal_tolerance)
            .max(min_length - a.head(n).min(b.head(n)));
    join_those_after(i, excess.data());
  }
}

// Few are joined: words are made without a branch a match, and looked at once.
void CompatibilityGraph::join_those_after(std::size_t i, const float* excess) {
  for (std::size_t w = (i + 1) / 64; w < words_; ++w) {
    const std::size_t first = std::max(i + 1, 64 * w), end = std::min(size_, 64 * (w + 1));
    std::uint64_t word = 0;
    for (std::size_t j = first; j < end; ++j) word |= std::uint64_t{excess[j] < 0} << (j - 64 * w);
    bits_[i * words_ + w] |= word;
    for (std::uint64_t left = word; left != 0; left &= left - 1) {
      const std::size_t j = 64 * w + static_cast<std::size_t>(std::countr_zero(left));
      bits_[j * words_ + i / 64] |= std::uint64_t{1} << (i % 64);
    }
  }
}

}  // namespace tcm_icp
