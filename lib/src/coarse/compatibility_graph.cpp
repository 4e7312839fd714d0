#include "compatibility_graph.hpp"

#include <algorithm>
#include <array>

#include "common_bits.hpp"

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

// A bit for each of the 64 values, set where it is below 0: compared by vectors, then eight bytes of 0 or 1 at a time,
// which the product moves to the highest byte, the first of them lowest.
std::uint64_t below_zero(const float* values) {
  std::array<std::uint8_t, 64> is_below;
  for (std::size_t k = 0; k < 64; ++k) is_below[k] = values[k] < 0 ? 1 : 0;
  std::uint64_t out = 0;
  for (std::size_t byte = 0; byte < 8; ++byte) {
    std::uint64_t eight = 0;
    for (std::size_t k = 0; k < 8; ++k) eight |= std::uint64_t{is_below[8 * byte + k]} << (8 * k);
    out |= (eight * 0x0102040810204080U) >> 56U << (8 * byte);
  }
  return out;
}

}  // namespace

int CompatibilityGraph::num_common(std::size_t i, std::size_t j) const {
  return static_cast<int>(num_common_bits({row(i), words_}, {row(j), words_}));
}

CompatibilityGraph::CompatibilityGraph(const MatchedPoints& matches, float tolerance, float min_length,
                                       float normal_tolerance)
    : size_(static_cast<std::size_t>(matches.size())), words_((size_ + 63) / 64), bits_(size_ * words_, 0) {
  const Coordinates target = matches.target.transpose(), source = matches.source.transpose();
  const Coordinates target_normal = matches.target_normal.transpose();
  const Coordinates source_normal = matches.source_normal.transpose();
  const auto num_rows = static_cast<Eigen::Index>(size_);
  Row a(num_rows), b(num_rows);
  Row excess = Row::Ones(static_cast<Eigen::Index>(64 * words_));
  for (std::size_t i = 0; i < size_; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Eigen::Index n = num_rows - k - 1;
    distances_from(target, k, a);
    distances_from(source, k, b);
    // The largest of the three, each below 0 where it holds: one number to look at.
    excess.segment(k + 1, n) =
        ((a.head(n) - b.head(n)).abs() - tolerance)
            .max((cosines_with(target_normal, k) - cosines_with(source_normal, k)).abs() - normal_tolerance)
            .max(min_length - a.head(n).min(b.head(n)));
    join_those_after(i, excess.data());
  }
}

void CompatibilityGraph::join_those_after(std::size_t i, const float* excess) {
  for (std::size_t w = (i + 1) / 64; w < words_; ++w) {
    std::uint64_t word = below_zero(excess + 64 * w);
    if (w == (i + 1) / 64) word &= ~std::uint64_t{0} << ((i + 1) % 64);
    bits_[i * words_ + w] |= word;
    for (std::uint64_t left = word; left != 0; left &= left - 1) {
      const std::size_t j = 64 * w + static_cast<std::size_t>(std::countr_zero(left));
      bits_[j * words_ + i / 64] |= std::uint64_t{1} << (i % 64);
    }
  }
}

}  // namespace tcm_icp
