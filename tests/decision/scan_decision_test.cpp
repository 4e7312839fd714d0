#include "tcm_icp/decision/scan_decision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

// The model's coefficients are fitted, and fitted anew: nothing here depends on their values.

const ComponentReference kUsual{0.8, 0.01, 6};
const DecisionOptions kAny{.confidence = 0}, kDefault;

ScanMeasurements good() {
  ScanMeasurements m;
  m.evidence.num_points = 1000;
  m.evidence.overlap = 0.8;
  m.evidence.inlier_share = 0.85;
  m.evidence.median_residual_m = 0.01;
  m.evidence.left_after_slide = {0.3, 0.3, 0.2, 0.2, 0.1, 0.1};
  m.evidence.left_across = 0.1;
  m.evidence.num_across = 200;
  m.free_space = {4000, 4, 3000, 20};
  m.lead = m.support = 20;
  m.num_across = 3;
  return m;
}

ScanMeasurements terrible() {
  ScanMeasurements m = good();
  m.evidence.overlap = 0.3;
  m.evidence.inlier_share = 0.2;
  m.evidence.median_residual_m = 0.1;
  m.evidence.left_after_slide = {1.5, 1.3, 1.2, 1, 1, 1};
  m.evidence.left_across = 1.5;
  m.free_space = {4000, 1500, 3000, 1500};
  m.lead = -5;
  m.support = 3;
  m.other_distance = 12.5;
  m.num_across = 2;
  return m;
}

TEST(Decide, GoodEvidenceIsAcceptedAndTerribleIsNot) {
  const DecisionOptions likely{.confidence = 0.5};
  const Decision yes = decide(good(), kUsual, likely), no = decide(terrible(), kUsual, likely);
  EXPECT_TRUE(yes.accepted()) << yes.probability;
  EXPECT_EQ(yes.reason, Reason::kAccepted);
  EXPECT_FALSE(no.accepted());
  EXPECT_LT(no.probability, 0.5);
  for (const Decision* d : {&yes, &no}) {
    EXPECT_FALSE(d->text.empty());
    EXPECT_GE(d->probability, 0);
    EXPECT_LE(d->probability, 1);
  }
}

TEST(Decide, TooFewAgreeingPointsAreNeverAccepted) {
  for (const std::size_t num_points : {0u, 1u, 29u, 36u}) {  // agreeing: at most 36 * 0.8 * 0.85 = 24
    ScanMeasurements few = good();
    few.evidence.num_points = num_points;
    few.lead = few.support = 1e6;
    const Decision d = decide(few, kUsual, kAny);
    EXPECT_FALSE(d.accepted()) << num_points;
    EXPECT_EQ(d.probability, 0) << num_points;
    EXPECT_EQ(d.reason, num_points < 30 ? Reason::kTooFewPoints : Reason::kMisfit);
    EXPECT_FALSE(d.text.empty());
  }
  ScanMeasurements apart = good();
  apart.evidence.overlap = 0.02;  // 17 of its points agree
  EXPECT_EQ(decide(apart, kUsual, kAny).reason, Reason::kMisfit);
  EXPECT_FALSE(decide({}, {}, kAny).accepted()) << "nothing was measured";
}

TEST(Decide, MoreLeadIsNeverLessProbable) {
  for (const ScanMeasurements& start : {good(), terrible()}) {
    double last = -1;
    for (const double lead : {-1000.0, -10.0, -3.0, -0.1, 0.0, 0.1, 1.0, 3.0, 6.0, 12.0, 20.0, 1000.0}) {
      ScanMeasurements m = start;
      m.lead = lead;
      const double now = decide(m, kUsual, kDefault).probability;
      EXPECT_GE(now, last) << "at " << lead;
      last = now;
    }
  }
}

TEST(Decide, ALostLeadMakesAPlaceLessProbable) {
  ScanMeasurements m = good();
  m.lead = -10;
  EXPECT_LT(decide(m, kUsual, kDefault).probability, decide(good(), kUsual, kDefault).probability);
}

TEST(Decide, ALeadOfMorePairsIsNeverMoreProbable) {
  double last = 1;
  for (const std::size_t num_across : {1u, 2u, 3u, 10u, 30u, 1000u}) {
    ScanMeasurements m = good();
    m.num_across = num_across;
    const double now = decide(m, kUsual, kDefault).probability;
    EXPECT_LE(now, last) << "of " << num_across;
    last = now;
  }
}

TEST(Decide, ConfidenceIsTheLeastProbability) {
  for (const double lead : {-10.0, 0.0, 1.0, 5.0, 20.0}) {
    ScanMeasurements m = good();
    m.lead = lead;
    const double p = decide(m, kUsual, kAny).probability;
    EXPECT_TRUE(decide(m, kUsual, {.confidence = p}).accepted()) << lead;
    EXPECT_FALSE(decide(m, kUsual, {.confidence = std::nextafter(p, 2)}).accepted()) << lead;
  }
}

TEST(Decide, WithoutConfidenceWhateverWasMeasuredIsAccepted) {
  EXPECT_EQ(decide(good(), kUsual, kAny).reason, Reason::kAccepted);
  EXPECT_EQ(decide(terrible(), kUsual, kAny).reason, Reason::kAccepted);
}

TEST(Decide, KeepsTheFeaturesItWasToldFrom) {
  EXPECT_EQ(decide(good(), kUsual, kDefault).features, decision_features(good(), kUsual));
  EXPECT_EQ(decide({}, kUsual, kDefault).features, decision_features({}, kUsual)) << "of too few points, too";
}

// A tie, everything else as good as can be: whatever the weights are, nothing but the lead takes anything.
TEST(Decide, ATieIsAmbiguousAndSaysHowFarTheOtherPlaceIs) {
  ScanMeasurements m = good();
  m.lead = -1000;
  m.other_distance = 12.5;
  const DecisionOptions nearly_sure{.confidence = std::nextafter(1.0, 0.0)};
  const Decision alone = decide(m, kUsual, nearly_sure);
  ASSERT_EQ(alone.reason, Reason::kAmbiguous);
  EXPECT_NE(alone.text.find("12.5"), std::string::npos) << alone.text;
  EXPECT_EQ(alone.text.find("together"), std::string::npos) << alone.text;
  m.num_moved = 4;
  const Decision group = decide(m, kUsual, nearly_sure);
  EXPECT_NE(group.text.find("12.5"), std::string::npos) << group.text;
  EXPECT_NE(group.text.find("3 more"), std::string::npos) << group.text;
  m.other_distance.reset();
  const Decision nowhere = decide(m, kUsual, nearly_sure);
  EXPECT_EQ(nowhere.reason, Reason::kAmbiguous);
  EXPECT_FALSE(nowhere.text.empty());
  EXPECT_EQ(nowhere.text.find("away"), std::string::npos) << nowhere.text;
}

TEST(Decide, EveryRefusalHasAReasonOfTheScan) {
  const std::set<Reason> of_a_scan{Reason::kAmbiguous,    Reason::kMisfit,  Reason::kSlides, Reason::kSeenThrough,
                                   Reason::kTooFewPoints, Reason::kInexact, Reason::kNoLink};
  const ScanMeasurements bad = terrible();
  for (int k = 0; k < 64; ++k) {
    ScanMeasurements m = good();
    if (k & 1) m.lead = bad.lead;
    if (k & 2) m.evidence.inlier_share = bad.evidence.inlier_share;
    if (k & 4) m.evidence.left_after_slide = bad.evidence.left_after_slide;
    if (k & 8) m.free_space = bad.free_space;
    if (k & 16) m.sigma_in_voxels = 2;
    if (k & 32) m.evidence.num_points = 20;
    const Decision d = decide(m, kUsual, {.confidence = 0.999999});
    EXPECT_EQ(d.accepted(), d.probability >= 0.999999) << k;
    EXPECT_FALSE(d.text.empty()) << k;
    if (!d.accepted()) {
      EXPECT_EQ(of_a_scan.count(d.reason), 1u) << k << ": " << to_string(d.reason);
    }
  }
}

TEST(DecisionFeatures, AreFiniteAndBoundedWhateverWasMeasured) {
  const std::set<std::string_view> names(kDecisionFeatureNames.begin(), kDecisionFeatureNames.end());
  EXPECT_EQ(names.size(), kDecisionFeatureNames.size());
  ScanMeasurements most = good(), least;
  most.evidence.median_residual_m = 1e300;
  most.evidence.left_after_slide.fill(1e300);
  most.evidence.left_across = 1e300;
  most.lead = std::numeric_limits<double>::infinity();
  most.free_space = {1u << 30, 1u << 30, 1u << 30, 1u << 30};
  least.lead = -std::numeric_limits<double>::infinity();
  for (const ScanMeasurements& m : {good(), terrible(), most, least, ScanMeasurements{}}) {
    for (const ComponentReference& component : {kUsual, ComponentReference{}, ComponentReference{1, 1e-300}}) {
      const DecisionFeatures f = decision_features(m, component);
      for (std::size_t i = 0; i < f.size(); ++i) {
        EXPECT_TRUE(std::isfinite(f[i])) << kDecisionFeatureNames[i];
        EXPECT_LE(std::abs(f[i]), 40) << kDecisionFeatureNames[i];
      }
    }
  }
}

TEST(DecisionFeatures, LeadAPairIsComparedWithThatOfTheSet) {
  ScanMeasurements m = good();
  m.lead = 12;
  m.num_across = 6;
  EXPECT_EQ(m.lead_a_pair(), 2);
  EXPECT_DOUBLE_EQ(decision_features(m, kUsual)[14], std::log1p(2));
  EXPECT_DOUBLE_EQ(decision_features(m, kUsual)[15], std::log1p(2) - std::log1p(6));
  m.num_across = 1;
  EXPECT_EQ(decision_features(m, kUsual)[15], 0) << "what has more than others is not better for it";
  m.num_across = 0;
  EXPECT_EQ(m.lead_a_pair(), 12) << "no pair counts like one";
  m.lead = -3;
  EXPECT_EQ(m.lead_a_pair(), 0);
}

TEST(DecisionFeatures, UnitsDoNotMatter) {
  for (const double factor : {0.001, 1000.0}) {
    ScanMeasurements scaled = terrible();
    scaled.evidence.median_residual_m *= factor;
    scaled.evidence.tolerance_m *= factor;
    scaled.evidence.slide_m *= factor;
    *scaled.other_distance *= factor;
    const DecisionFeatures f = decision_features(scaled,
                                                 {kUsual.inlier_share, factor * kUsual.residual_m, kUsual.lead_a_pair}),
                           in_m = decision_features(terrible(), kUsual);
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], in_m[i], 1e-12) << kDecisionFeatureNames[i];
  }
}

TEST(ComponentReference, IsWhatTheMiddleMemberShows) {
  std::vector<ScanMeasurements> members(5, good());
  const std::vector<double> shares{0.9, 0.1, 0.7, 0.8, 0.6}, residuals_m{0.05, 0.01, 0.02, 0.03, 0.04};
  for (std::size_t i = 0; i < 5; ++i) {
    members[i].evidence.inlier_share = shares[i];
    members[i].evidence.median_residual_m = residuals_m[i];
  }
  EXPECT_EQ(ComponentReference::of(members).inlier_share, 0.7);
  EXPECT_EQ(ComponentReference::of(members).residual_m, 0.03);
  for (std::size_t i = 0; i < 5; ++i) members[i].num_across = i + 1;
  EXPECT_DOUBLE_EQ(ComponentReference::of(members).lead_a_pair, 20.0 / 3);
  members.resize(2);
  EXPECT_EQ(ComponentReference::of(members).inlier_share, 0.9);
  EXPECT_EQ(ComponentReference::of(members).residual_m, 0.01) << "of two the better counts";
  EXPECT_EQ(ComponentReference::of({}).inlier_share, 0);
}

TEST(DecisionOptions, ConfidenceIsAProbabilityBelowOne) {
  for (const double valid : {0.0, 0.5, 0.999999}) {
    EXPECT_NO_THROW(DecisionOptions{.confidence = valid}.validate()) << valid;
  }
  for (const double invalid : {-0.001, 1.0, 2.0, std::nan("")}) {
    EXPECT_THROW(DecisionOptions{.confidence = invalid}.validate(), InvalidOptions) << invalid;
  }
  EXPECT_NO_THROW(DecisionOptions().validate());
}

TEST(Reasons, EachHasWordsOfItsOwn) {
  const std::vector<Reason> all{Reason::kNotDecided, Reason::kReference,   Reason::kAccepted,
                                Reason::kNoLink,     Reason::kAmbiguous,   Reason::kMisfit,
                                Reason::kSlides,     Reason::kSeenThrough, Reason::kTooFewPoints};
  std::set<std::string_view> words;
  for (const Reason reason : all) words.insert(to_string(reason));
  EXPECT_EQ(words.size(), all.size());
  EXPECT_EQ(words.count("unknown"), 0u);
  for (const Reason reason : all) {
    Decision d;
    d.reason = reason;
    EXPECT_EQ(d.accepted(), reason == Reason::kAccepted || reason == Reason::kReference) << to_string(reason);
  }
}

}  // namespace
}  // namespace tcm_icp
