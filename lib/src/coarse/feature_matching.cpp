#include "tcm_icp/coarse/feature_matching.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace tcm_icp {
namespace {

// Columns of the source compared at a time: the products stay in the cache.
constexpr Eigen::Index kBlock = 64;

struct Nearest {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  float similarity = -1;
};

}  // namespace

std::vector<FeatureMatch> match_features(const Descriptors& target, const Descriptors& source) {
  const Eigen::Index num_targets = target.cols();
  std::vector<FeatureMatch> matches;
  if (num_targets == 0 || source.cols() == 0) return matches;
  std::vector<Nearest> of_target(static_cast<std::size_t>(num_targets)), of_source;
  Eigen::ArrayXf best = Eigen::ArrayXf::Constant(num_targets, -1);
  Eigen::MatrixXf products;
  for (Eigen::Index first = 0; first < source.cols(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, source.cols() - first);
    products.noalias() = target.transpose() * source.middleCols(first, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      // Two walks: for the largest alone the compiler takes vectors.
      const float largest = products.col(k).maxCoeff();
      const float* column = products.col(k).data();
      const auto row = std::find(column, column + num_targets, largest) - column;
      of_source.push_back({static_cast<std::uint32_t>(row), largest});
    }
    const Eigen::ArrayXf of_block = products.rowwise().maxCoeff().array();
    for (Eigen::Index t = 0; t < num_targets; ++t) {
      if (!(of_block[t] > best[t])) continue;
      best[t] = of_block[t];
      Eigen::Index column = 0;
      products.row(t).maxCoeff(&column);
      of_target[static_cast<std::size_t>(t)].index = static_cast<std::uint32_t>(first + column);
    }
  }
  for (std::uint32_t k = 0; k < of_source.size(); ++k)
    matches.push_back({of_source[k].index, k, of_source[k].similarity});
  for (std::uint32_t t = 0; t < of_target.size(); ++t) {
    const std::uint32_t k = of_target[t].index;
    if (of_source[k].index != t) matches.push_back({t, k, best[t]});
  }
  return matches;
}

}  // namespace tcm_icp
