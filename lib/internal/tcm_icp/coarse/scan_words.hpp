#pragma once
// Which scans of a set look alike, by how often each kind of surface occurs in them: bags of visual words.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tcm_icp/coarse/feature_alignment.hpp"

namespace tcm_icp {

/// The words are keypoints' descriptors, taken evenly from all scans; each keypoint counts for the word most like it
/// (Sivic and Zisserman, 2003; that words need not be cluster centres was measured, docs/decisions/0012). A word that
/// many scans have says little: counts are damped by a root and weighted by inverse document frequency.
class ScanWords {
 public:
  static constexpr std::size_t kMostWords = 2000;  ///< of each level

  /// @param scans  described with the same levels
  /// @throws InvalidInput  where the levels of two scans differ in number
  /// Cost: keypoints times words, some 50 ms a scan; memory of some thousand numbers a scan. The same bits for any
  /// number of threads.
  ScanWords(const std::vector<DescribedScan>& scans, int num_threads);

  std::size_t size() const { return levels_.empty() ? 0 : levels_.front().size(); }

  /// How alike a scan is to each of the set: cosines of their words, in mean over the levels, 0..1. They rank partners
  /// of one scan, and are no verdict: scans far apart may have the same surfaces. Cost: words times scans.
  std::vector<double> likeness(std::size_t scan) const;

 private:
  struct Word {
    std::uint32_t number;
    float weight;
  };
  using Bag = std::vector<Word>;          // ascending numbers, of length 1
  std::vector<std::vector<Bag>> levels_;  // by level and scan
};

}  // namespace tcm_icp
