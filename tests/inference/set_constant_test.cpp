#include "inference/set_constant.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

double posterior(const std::vector<JudgedHypothesis>& judged, double spread, double constant) {
  double sum = -constant * constant / (2 * spread * spread);
  for (const auto& h : judged) {
    const double odds = h.log_odds + constant;
    sum -= h.sure * std::log1p(std::exp(h.right ? -odds : odds));
  }
  return sum;
}

// Labels that a set with `constant` has.
std::vector<JudgedHypothesis> drawn(double constant, std::size_t count, Rng& rng) {
  std::vector<JudgedHypothesis> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double log_odds = 8 * uniform01(rng) - 4;
    out.push_back({log_odds, uniform01(rng) < 1 / (1 + std::exp(-log_odds - constant)), 1});
  }
  return out;
}

TEST(SetConstant, IsNothingWithoutEvidenceOrSpread) {
  EXPECT_EQ(set_constant({}, 1), 0);
  EXPECT_EQ(set_constant({{-3, true, 1}}, 0), 0);
  EXPECT_NEAR(set_constant({{-3, true, 0}}, 1), 0, 1e-12) << "a judgement nobody is sure of";
  EXPECT_NEAR(set_constant({{2, true, 1}, {-2, false, 1}}, 1), 0, 1e-12) << "what speaks for either side alike";
}

TEST(SetConstant, IsTheModeOfThePosterior) {
  Rng rng = make_stream(1, "set_constant_test");
  for (const double spread : {0.3, 1.0, 3.0}) {
    auto judged = drawn(1.5, 40, rng);
    for (auto& h : judged) h.sure = uniform01(rng);
    const double constant = set_constant(judged, spread), at = posterior(judged, spread, constant);
    EXPECT_GT(constant, 0);
    for (double other = -5; other <= 5; other += 0.01) EXPECT_LE(posterior(judged, spread, other), at + 1e-9) << other;
  }
}

TEST(SetConstant, ManyJudgementsTellWhatASetHas) {
  Rng rng = make_stream(2, "set_constant_test");
  for (const double truth : {-2.0, 0.0, 2.5}) EXPECT_NEAR(set_constant(drawn(truth, 4000, rng), 1), truth, 0.15);
}

TEST(SetConstant, IsBoundedWhereAllAreRight) {
  const std::vector<JudgedHypothesis> all_right(100000, {-3, true, 1});
  const double constant = set_constant(all_right, 1);
  EXPECT_GT(constant, 3);
  EXPECT_LT(constant, 15);
}

}  // namespace
}  // namespace tcm_icp
