#include "tcm_icp/coarse/feature_matching.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

Descriptors random_descriptors(Eigen::Index count, Rng& rng) {
  Descriptors d(kFpfhSize, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (int k = 0; k < kFpfhSize; ++k) d(k, i) = static_cast<float>(uniform01(rng));
    d.col(i).normalize();
  }
  return d;
}

std::uint32_t most_similar(const Descriptors& to, const Eigen::VectorXf& d) {
  Eigen::Index best = 0;
  for (Eigen::Index i = 1; i < to.cols(); ++i) {
    if (to.col(i).dot(d) > to.col(best).dot(d)) best = i;
  }
  return static_cast<std::uint32_t>(best);
}

TEST(FeatureMatching, FindsWhatALoopFindsInBothDirections) {
  Rng rng = make_stream(1, "matching");
  const Descriptors target = random_descriptors(150, rng), source = random_descriptors(217, rng);
  const auto matches = match_features(target, source);
  ASSERT_GE(matches.size(), 217U);
  for (std::uint32_t s = 0; s < 217; ++s) {
    EXPECT_EQ(s, matches[s].source);
    EXPECT_EQ(most_similar(target, source.col(s)), matches[s].target);
  }
  for (std::size_t k = 217; k < matches.size(); ++k) {
    EXPECT_EQ(most_similar(source, target.col(matches[k].target)), matches[k].source);
    EXPECT_NE(matches[matches[k].source].target, matches[k].target) << "no match twice";
  }
}

TEST(FeatureMatching, MatchesEqualColumnsWithTheFirst) {
  Rng rng = make_stream(2, "matching");
  const Descriptors one = random_descriptors(1, rng);
  const auto matches = match_features(one.replicate(1, 3), one);
  ASSERT_EQ(3U, matches.size());
  EXPECT_EQ(0U, matches.front().target);
}

TEST(FeatureMatching, OfNothingIsNothing) {
  Rng rng = make_stream(3, "matching");
  const Descriptors none(kFpfhSize, 0), some = random_descriptors(3, rng);
  EXPECT_TRUE(match_features(none, some).empty());
  EXPECT_TRUE(match_features(some, none).empty());
}

}  // namespace
}  // namespace tcm_icp
