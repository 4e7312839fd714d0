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

double posterior(const std::vector<JudgedHypothesis>& judged, double spread, const SetShift& shift) {
  const double slope = shift.slope - 1;
  double sum = -(shift.constant * shift.constant + slope * slope) / (2 * spread * spread);
  for (const auto& h : judged) {
    const double odds = shift.of(h.log_odds);
    sum -= h.sure * std::log1p(std::exp(h.right ? -odds : odds));
  }
  return sum;
}

// Labels that a set with that shift has.
std::vector<JudgedHypothesis> drawn(const SetShift& shift, double low, double high, std::size_t count, Rng& rng) {
  std::vector<JudgedHypothesis> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double log_odds = low + (high - low) * uniform01(rng);
    out.push_back({log_odds, uniform01(rng) < 1 / (1 + std::exp(-shift.of(log_odds))), 1});
  }
  return out;
}

TEST(SetShift, IsNothingWithoutEvidenceOrSpread) {
  for (const SetShift& shift :
       {set_shift({}, 1, 1), set_shift({{-3, true, 1}}, 0, 1), set_shift({{-3, true, 0}}, 1, 1)}) {
    EXPECT_NEAR(shift.constant, 0, 1e-12);
    EXPECT_NEAR(shift.slope, 1, 1e-12);
    EXPECT_NEAR(shift.of(2.5), 2.5, 1e-12);
  }
}

TEST(SetShift, IsTheModeOfThePosterior) {
  Rng rng = make_stream(3, "set_constant_test");
  for (const double spread : {0.3, 1.0, 3.0}) {
    auto judged = drawn({1.5, 1.6}, -4, 4, 60, rng);
    for (auto& h : judged) h.sure = uniform01(rng);
    const SetShift shift = set_shift(judged, spread, spread);
    const double at = posterior(judged, spread, shift);
    for (double constant = -4; constant <= 4; constant += 0.1) {
      for (double slope = 0.1; slope <= 4; slope += 0.1) {
        EXPECT_LE(posterior(judged, spread, SetShift{constant, slope}), at + 1e-9) << constant << ", " << slope;
      }
    }
  }
}

TEST(SetShift, ManyJudgementsTellWhatASetHas) {
  Rng rng = make_stream(4, "set_constant_test");
  for (const SetShift& truth : {SetShift{-2, 1.5}, SetShift{0, 1}, SetShift{1.5, 0.6}}) {
    const SetShift shift = set_shift(drawn(truth, -4, 4, 8000, rng), 1, 1);
    EXPECT_NEAR(shift.constant, truth.constant, 0.2);
    EXPECT_NEAR(shift.slope, truth.slope, 0.15);
  }
}

// Thousands that share nothing are as good as all wrong, the few that do as likely as they say.
TEST(SetShift, WhatLooksRightIsNotPutDownToWhatLooksWrong) {
  Rng rng = make_stream(5, "set_constant_test");
  auto judged = drawn({0, 1}, 0, 6, 30, rng);
  for (int i = 0; i < 20000; ++i) judged.push_back({-6 * uniform01(rng), false, 1});
  EXPECT_LT(set_constant(judged, 0.5) + 3, 0) << "a constant alone leaves nothing of 3";
  EXPECT_GT(set_shift(judged, 0.5, 0.5).of(3), 1);
}

TEST(SetShift, NeverTurnsWhatLooksBetterIntoWorse) {
  std::vector<JudgedHypothesis> judged;
  for (int i = 0; i < 1000; ++i) judged.push_back({i % 2 == 0 ? 4.0 : -4.0, i % 2 != 0, 1});
  EXPECT_GT(set_shift(judged, 3, 3).slope, 0);
}

}  // namespace
}  // namespace tcm_icp
