#include "tcm_icp/coarse/scan_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

// Columns compared at a time: the products stay in the cache.
constexpr Eigen::Index kBlock = 64;

// Every so many-th keypoint of the set: all scans have their share, and no random number is needed.
Descriptors choose_words(const std::vector<const Descriptors*>& scans) {
  std::size_t count = 0;
  for (const Descriptors* d : scans) count += static_cast<std::size_t>(d->cols());
  const std::size_t num_words = std::min(count, ScanWords::kMostWords);
  Descriptors words(kFpfhSize, static_cast<Eigen::Index>(num_words));
  std::size_t before = 0, chosen = 0;
  for (const Descriptors* d : scans) {
    const auto end = before + static_cast<std::size_t>(d->cols());
    for (; chosen < num_words && chosen * count / num_words < end; ++chosen) {
      words.col(static_cast<Eigen::Index>(chosen)) =
          d->col(static_cast<Eigen::Index>(chosen * count / num_words - before));
    }
    before = end;
  }
  return words;
}

std::vector<float> count_words(const Descriptors& words, const Descriptors& scan) {
  std::vector<float> counts(static_cast<std::size_t>(words.cols()), 0);
  Eigen::MatrixXf products;
  for (Eigen::Index first = 0; first < scan.cols(); first += kBlock) {
    products.noalias() = words.transpose() * scan.middleCols(first, std::min(kBlock, scan.cols() - first));
    for (Eigen::Index k = 0; k < products.cols(); ++k) {
      Eigen::Index word = 0;
      products.col(k).maxCoeff(&word);
      ++counts[static_cast<std::size_t>(word)];
    }
  }
  return counts;
}

}  // namespace

ScanWords::ScanWords(const std::vector<DescribedScan>& scans, int num_threads) {
  if (scans.empty()) return;
  const std::size_t n = scans.size();
  for (std::size_t l = 0; l < scans.front().levels.size(); ++l) {
    std::vector<const Descriptors*> descriptors;
    for (const DescribedScan& scan : scans) {
      if (scan.levels.size() != scans.front().levels.size()) throw InvalidInput("scans are described at other levels");
      descriptors.push_back(&scan.levels[l].descriptors);
    }
    const Descriptors words = choose_words(descriptors);
    std::vector<Bag>& bags = levels_.emplace_back(n);
    parallel_for(num_threads, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::vector<float> counts = count_words(words, *descriptors[i]);
        for (std::uint32_t w = 0; w < counts.size(); ++w) {
          if (counts[w] > 0) bags[i].push_back({w, counts[w]});
        }
      }
    });
    std::vector<double> num_scans(static_cast<std::size_t>(words.cols()), 0);
    for (const Bag& bag : bags) {
      for (const Word& word : bag) ++num_scans[word.number];
    }
    for (Bag& bag : bags) {
      double squared = 0;
      for (Word& word : bag) {
        const double rarity = std::log(static_cast<double>(n + 1) / num_scans[word.number]);
        word.weight = static_cast<float>(std::sqrt(word.weight) * rarity);
        squared += static_cast<double>(word.weight) * word.weight;
      }
      for (Word& word : bag) word.weight /= static_cast<float>(std::sqrt(squared));
    }
  }
}

std::vector<double> ScanWords::likeness(std::size_t scan) const {
  std::vector<double> out(size(), 0);
  for (const std::vector<Bag>& bags : levels_) {
    std::uint32_t end = 0;
    for (const Word& word : bags[scan]) end = std::max(end, word.number + 1);
    std::vector<double> weights(end, 0);
    for (const Word& word : bags[scan]) weights[word.number] = word.weight;
    for (std::size_t j = 0; j < bags.size(); ++j) {
      for (const Word& word : bags[j]) {
        if (word.number >= end) break;
        out[j] += weights[word.number] * word.weight / static_cast<double>(levels_.size());
      }
    }
  }
  return out;
}

}  // namespace tcm_icp
