#include "correlation_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

constexpr std::size_t kPeaksPerHeading = 3;

// Both channels: both[0] = sum of t conj(s), the source as it is; both[1] = sum of t s: turned by 180 degrees.
void multiply(const Spectrum& t1, const Spectrum& s1, const Spectrum& t2, const Spectrum& s2, Spectrum (&both)[2]) {
  both[0].resize(t1.size());
  both[1].resize(t1.size());
  const float* a = reinterpret_cast<const float*>(t1.data());
  const float* b = reinterpret_cast<const float*>(s1.data());
  const float* c = reinterpret_cast<const float*>(t2.data());
  const float* d = reinterpret_cast<const float*>(s2.data());
  float* straight = reinterpret_cast<float*>(both[0].data());
  float* turned = reinterpret_cast<float*>(both[1].data());
  for (std::size_t k = 0; k < 2 * t1.size(); k += 2) {
    const float rr = a[k] * b[k] + c[k] * d[k], ii = a[k + 1] * b[k + 1] + c[k + 1] * d[k + 1];
    const float ri = a[k] * b[k + 1] + c[k] * d[k + 1], ir = a[k + 1] * b[k] + c[k + 1] * d[k];
    straight[k] = rr + ii;
    straight[k + 1] = ir - ri;
    turned[k] = rr - ii;
    turned[k + 1] = ir + ri;
  }
}

// The same of one channel.
void multiply(const Spectrum& t, const Spectrum& s, Spectrum (&both)[2]) {
  both[0].resize(t.size());
  both[1].resize(t.size());
  for (std::size_t k = 0; k < t.size(); ++k) {
    const float rr = t[k].real() * s[k].real(), ii = t[k].imag() * s[k].imag();
    const float ri = t[k].real() * s[k].imag(), ir = t[k].imag() * s[k].real();
    both[0][k] = {rr + ii, ir - ri};
    both[1][k] = {rr - ii, ir + ri};
  }
}

struct BlockPeak {
  float score;
  int row, column;
};

// The best shifts of the surface, at most one in any block of kMaskStep x kMaskStep and its neighbours.
std::vector<BlockPeak> best_blocks(const Image& agreement, const Image& shared, int size, double min_shared,
                                   double floor) {
  const auto n = static_cast<std::size_t>(size), low = n / kMaskStep;
  const auto scale = static_cast<float>(n * n);  // neither inverse was divided by it
  const float least = static_cast<float>(min_shared) * scale;
  const auto squared_floor = static_cast<float>(floor * floor) * scale;
  std::vector<BlockPeak> found;
  std::vector<float> highest(n);
  for (std::size_t i = 0; i < low; ++i) {
    const auto in_row = shared.begin() + static_cast<std::ptrdiff_t>(i * low);
    if (std::none_of(in_row, in_row + static_cast<std::ptrdiff_t>(low), [&](float c) { return c >= least; })) continue;
    const float* rows = agreement.data() + kMaskStep * i * n;
    std::copy(rows, rows + n, highest.begin());
    for (std::size_t r = 1; r < kMaskStep; ++r) {
      for (std::size_t c = 0; c < n; ++c) highest[c] = highest[c] > rows[r * n + c] ? highest[c] : rows[r * n + c];
    }
    for (std::size_t j = 0; j < low; ++j) {
      const float cells = shared[i * low + j];
      if (!(cells >= least)) continue;
      const auto first = highest.begin() + static_cast<std::ptrdiff_t>(kMaskStep * j);
      const auto top = std::max_element(first, first + kMaskStep);
      // Squares: a root for every block would take as long as the rest.
      if (!(*top > 0 && *top * *top > squared_floor * cells)) continue;
      const auto column = static_cast<std::size_t>(top - highest.begin());
      std::size_t row = kMaskStep * i;
      while (agreement[row * n + column] != *top) ++row;
      found.push_back({*top / std::sqrt(cells * scale), static_cast<int>(row), static_cast<int>(column)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<BlockPeak> kept;
  const auto apart = [&](int a, int b) {
    const int d = std::abs(a - b);
    return std::min(d, size - d);
  };
  for (const BlockPeak& p : found) {
    if (kept.size() == kPeaksPerHeading) break;
    if (std::all_of(kept.begin(), kept.end(), [&](const BlockPeak& k) {
          return std::max(apart(k.row, p.row), apart(k.column, p.column)) > 2 * kMaskStep;
        })) {
      kept.push_back(p);
    }
  }
  return kept;
}

}  // namespace

bool are_near(const MapPeak& a, const MapPeak& b, double heading_rad, double cells) {
  return a.target_map == b.target_map && a.source_map == b.source_map &&
         std::abs(std::remainder(a.heading_rad - b.heading_rad, 2 * EIGEN_PI)) <= heading_rad &&
         std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= cells;
}

void PeakList::add(const MapPeak& peak) {
  if (!(peak.score > floor())) return;
  for (const MapPeak& p : peaks_) {
    if (p.score >= peak.score && are_near(p, peak, near_heading_rad_, near_cells_)) return;
  }
  std::erase_if(peaks_, [&](const MapPeak& p) { return are_near(p, peak, near_heading_rad_, near_cells_); });
  // After its equals: the order of the search breaks ties.
  peaks_.insert(std::upper_bound(peaks_.begin(), peaks_.end(), peak,
                                 [](const MapPeak& a, const MapPeak& b) { return a.score > b.score; }),
                peak);
  if (peaks_.size() > capacity_) peaks_.pop_back();
}

void add_correlation_peaks(const MapSpectra& target, bool target_is_quarter_turned, const MapSpectra& source,
                           const Fourier& fourier, const Fourier& mask_fourier, double min_shared, MapPeak peak,
                           CorrelationScratch& scratch, PeakList& list) {
  multiply(target.detail, source.detail, target.structure, source.structure, scratch.detail);
  multiply(target.mask, source.mask, scratch.mask);
  const int size = fourier.size();
  const double source_heading_rad = peak.heading_rad;
  for (int half_turn = 0; half_turn < 2; ++half_turn) {
    fourier.inverse(scratch.detail[half_turn], scratch.agreement);
    mask_fourier.inverse(scratch.mask[half_turn], scratch.shared);
    const auto blocks = best_blocks(scratch.agreement, scratch.shared, size, min_shared, list.floor());
    for (const BlockPeak& b : blocks) {
      const int y = b.row < size / 2 ? b.row : b.row - size, x = b.column < size / 2 ? b.column : b.column - size;
      peak.score = b.score;
      peak.heading_rad = source_heading_rad + half_turn * EIGEN_PI - (target_is_quarter_turned ? EIGEN_PI / 2 : 0);
      // The target had been turned by +90 degrees: turn the answer back.
      peak.x = target_is_quarter_turned ? y : x;
      peak.y = target_is_quarter_turned ? -x : y;
      list.add(peak);
    }
  }
}

}  // namespace tcm_icp
