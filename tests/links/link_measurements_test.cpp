#include "tcm_icp/links/link_measurements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "links/measured_links.hpp"

namespace tcm_icp {
namespace {

using testing::kNoise_m;
using testing::kVoxel_m;
using testing::scaled_link;
using testing::terrible_link;
using testing::usual_link;

using testing::kInfinity;

SetReference usual_set() { return SetReference::of(kVoxel_m, kNoise_m, {usual_link(), terrible_link()}); }

double feature(std::string_view name, const LinkFeatures& features) {
  const auto at = std::find(kLinkFeatureNames.begin(), kLinkFeatureNames.end(), name);
  EXPECT_NE(at, kLinkFeatureNames.end()) << name;
  return features[static_cast<std::size_t>(at - kLinkFeatureNames.begin())];
}

// Between the least and the most that any length or count could say.
void expect_bounded(const LinkFeatures& features, const std::string& of) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    EXPECT_TRUE(std::isfinite(features[i])) << kLinkFeatureNames[i] << " of " << of;
    EXPECT_LE(std::abs(features[i]), 10) << kLinkFeatureNames[i] << " of " << of;
  }
}

TEST(LinkFeatures, NamesAreDifferent) {
  const std::set<std::string_view> names(kLinkFeatureNames.begin(), kLinkFeatureNames.end());
  EXPECT_EQ(names.size(), kLinkFeatureNames.size());
  EXPECT_EQ(names.count(""), 0u);
}

TEST(LinkFeatures, AreFiniteWhereNothingWasMeasured) {
  for (const SetReference& set : {SetReference{}, SetReference::of(kVoxel_m, 0, {}), usual_set()}) {
    expect_bounded(link_features({}, std::nullopt, set), "nothing");
    expect_bounded(link_features({}, SearchMeasurements{}, set), "an empty search");
    expect_bounded(link_features(usual_link(), SearchMeasurements{}, set), "a usual link");
  }
}

TEST(LinkFeatures, AreBoundedWhateverWasMeasured) {
  LinkMeasurements m = usual_link();
  for (const double length_m : {0.0, 1e-300, 1e300}) {
    for (const double share : {0.0, 1e-12, 1.0}) {
      for (const double left : {0.0, 1e9}) {
        m.evidence.median_residual_m = length_m;
        m.evidence.overlap = m.other_overlap = share;
        m.evidence.inlier_share = m.other_inlier_share = share;
        m.evidence.left_after_slide.fill(left);
        m.evidence.left_across = left;
        for (const SetReference& set : {usual_set(), SetReference{1e300, 1e-300, 1e-12, 1e-300}}) {
          for (const double ratio : {0.0, 1e-300, 1.0, kInfinity}) {
            for (const CoarseMethod method : {CoarseMethod::kFeatures, CoarseMethod::kHeightMap, CoarseMethod::kSlide,
                                              CoarseMethod::kGuess, CoarseMethod::kImplied}) {
              expect_bounded(link_features(m, SearchMeasurements{method, ratio, ratio}, set), "an extreme");
            }
          }
        }
      }
    }
  }
  m = usual_link();
  for (const FreeSpaceEvidence& all :
       {FreeSpaceEvidence{100, 100, 100, 100}, FreeSpaceEvidence{1u << 30, 1u << 30, 1u << 30, 1u << 30},
        FreeSpaceEvidence{99, 99, 99, 99}, FreeSpaceEvidence{0, 0, 0, 0}}) {
    m.free_space = m.slid_space = all;
    expect_bounded(link_features(m, std::nullopt, usual_set()), "free space");
  }
}

TEST(LinkFeatures, UnitsDoNotMatter) {
  const SearchMeasurements search{CoarseMethod::kHeightMap, 1.4, 0.6};
  const LinkFeatures in_m = link_features(usual_link(), search, usual_set());
  for (const double factor : {0.001, 1000.0}) {
    const SetReference set =
        SetReference::of(factor * kVoxel_m, factor * kNoise_m,
                         {scaled_link(usual_link(), factor), scaled_link(terrible_link(), factor)});
    const LinkFeatures scaled = link_features(scaled_link(usual_link(), factor), search, set);
    for (std::size_t i = 0; i < in_m.size(); ++i) EXPECT_NEAR(scaled[i], in_m[i], 1e-12) << kLinkFeatureNames[i];
    const LinkFeatures mixed = link_features(scaled_link(usual_link(), factor), search, usual_set());
    EXPECT_GT(std::abs(feature("residual_by_voxel", mixed) - feature("residual_by_voxel", in_m)), 1)
        << "it is the set's lengths that residuals are measured by";
  }
}

// Of one measurement that grows, beside all others as they usually are.
TEST(LinkFeatures, EachGrowsWithWhatItIsNamedAfter) {
  using M = LinkMeasurements;
  const std::vector<std::pair<std::string_view, std::function<void(M&, double)>>> measured{
      {"log_overlap", [](M& m, double x) { m.evidence.overlap = x; }},
      {"log_other_overlap", [](M& m, double x) { m.other_overlap = x; }},
      {"log_inlier_share", [](M& m, double x) { m.evidence.inlier_share = x; }},
      {"inliers_by_best", [](M& m, double x) { m.evidence.inlier_share = x; }},
      {"log_other_inlier_share", [](M& m, double x) { m.other_inlier_share = x; }},
      {"residual_by_voxel", [](M& m, double x) { m.evidence.median_residual_m = 0.1 * x * kVoxel_m; }},
      {"residual_by_typical", [](M& m, double x) { m.evidence.median_residual_m = 0.1 * x * kVoxel_m; }},
      {"weakest_left", [](M& m, double x) { m.evidence.left_after_slide[0] = x; }},
      {"mean_left", [](M& m, double x) { m.evidence.left_after_slide[5] = x; }},
      {"left_across", [](M& m, double x) { m.evidence.left_across = x; }},
      {"violations", [](M& m, double x) { m.free_space.num_violating = static_cast<std::size_t>(100 * x); }},
      {"held_by_space", [](M& m, double x) { m.slid_space.num_violating = static_cast<std::size_t>(200 * x); }},
      {"opposed", [](M& m, double x) { m.free_space.num_opposed = static_cast<std::size_t>(1000 * x); }},
  };
  for (const auto& [name, set] : measured) {
    double last = -kInfinity;
    for (const double x : {0.2, 0.5, 0.9}) {
      LinkMeasurements m = usual_link();
      set(m, x);
      const double now = feature(name, link_features(m, std::nullopt, usual_set()));
      EXPECT_GT(now, last) << name << " at " << x;
      last = now;
    }
  }
}

TEST(LinkFeatures, ThoseOfTheSearchAreOfItsMethodAlone) {
  const auto of = [](const SearchMeasurements& search) { return link_features(usual_link(), search, usual_set()); };
  const LinkFeatures none = link_features(usual_link(), std::nullopt, usual_set());
  for (std::size_t i = kNumPoseFeatures; i < none.size(); ++i) EXPECT_EQ(none[i], 0) << kLinkFeatureNames[i];
  const LinkFeatures map = of({CoarseMethod::kHeightMap, 2, 0.5}), features = of({CoarseMethod::kFeatures, 2, 0.5}),
                     slide = of({CoarseMethod::kSlide, 2, 0.5}), guess = of({CoarseMethod::kGuess, 2, 0.5});
  EXPECT_NEAR(feature("height_map_margin", map), std::log(2), 1e-12);
  EXPECT_NEAR(feature("feature_margin", features), std::log(2), 1e-12);
  for (const LinkFeatures* f : {&features, &slide, &guess}) EXPECT_EQ(feature("height_map_margin", *f), 0);
  for (const LinkFeatures* f : {&map, &slide, &guess}) EXPECT_EQ(feature("feature_margin", *f), 0);
  EXPECT_EQ(feature("height_map", map), 1);
  EXPECT_EQ(feature("slide", slide), 1);
  for (const LinkFeatures* f : {&map, &features, &slide, &guess}) {
    EXPECT_NEAR(feature("second_best", *f), std::log(2), 1e-12);
    for (std::size_t i = 0; i < kNumPoseFeatures; ++i) EXPECT_EQ((*f)[i], none[i]) << "the pose is the same";
  }
  EXPECT_GT(feature("second_best", of({CoarseMethod::kSlide, 2, 0})), feature("second_best", slide)) << "no other pose";
  EXPECT_LT(feature("second_best", of({CoarseMethod::kSlide, 2, 1.5})), 0) << "a better one";
  EXPECT_EQ(feature("second_best", of({CoarseMethod::kImplied, 1, 0})), 0) << "nobody looked for another";
}

TEST(LinkFeatures, FreeSpaceHoldsWhatSeesThroughMoreAfterASlide) {
  LinkMeasurements m = usual_link();
  const auto held = [&](std::size_t num_points, std::size_t before, std::size_t slid_points, std::size_t after) {
    m.free_space = {num_points, before, 0, 0};
    m.slid_space = {slid_points, after, 0, 0};
    return feature("held_by_space", link_features(m, std::nullopt, usual_set()));
  };
  EXPECT_NEAR(held(2000, 3, 1600, 100), std::log((0.004 + 90.0 / 1600) / (0.004 + 6.0 / 2000)), 1e-12);
  EXPECT_EQ(held(2000, 100, 1600, 80), 0) << "as much here";
  EXPECT_EQ(held(99, 0, 1600, 100), 0) << "too few points";
  EXPECT_EQ(held(2000, 3, 29, 29), 0) << "too few points after it";
  EXPECT_LT(held(100, 0, 1600, 100), held(2000, 0, 1600, 100)) << "none of a few points is chance";
}

TEST(LinkFeatures, WhatNoSlideCanTellIsNotCountedAsNotHeld) {
  LinkMeasurements m = usual_link();
  const auto unknown = [&](std::size_t num_points, std::size_t slid_points) {
    m.free_space = {num_points, 0, 0, 0};
    m.slid_space = {slid_points, 0, 0, 0};
    return feature("held_unknown", link_features(m, std::nullopt, usual_set()));
  };
  EXPECT_EQ(unknown(2000, 30), 0) << "not held";
  EXPECT_EQ(unknown(2000, 29), 1);
  EXPECT_EQ(unknown(99, 0), 0) << "nothing is known of the pose itself: another feature";
}

// Free space that shows nothing speaks against scans that see space, and says nothing of others.
TEST(LinkFeatures, BlindScansAreToldFromScansThatSeeNothingOfOneAnother) {
  LinkMeasurements m = usual_link();
  m.free_space = {};
  const auto features = [&](bool sighted) {
    m.sighted = sighted;
    return link_features(m, std::nullopt, usual_set());
  };
  EXPECT_EQ(feature("space_unseen", features(true)), 1);
  EXPECT_EQ(feature("blind", features(true)), 0);
  EXPECT_EQ(feature("space_unseen", features(false)), 0);
  EXPECT_EQ(feature("blind", features(false)), 1);
  EXPECT_EQ(kLinkFeatureNames[kBlind], "blind");
}

TEST(LinkFeatures, FewPointsSayThatTheyAreFewAndNothingElse) {
  LinkMeasurements few = usual_link();
  few.evidence.num_across = 5;
  few.evidence.left_across = 1.5;
  few.free_space = {50, 50, 50, 50};
  const LinkFeatures f = link_features(few, std::nullopt, usual_set());
  EXPECT_EQ(feature("across_unknown", f), 1);
  EXPECT_EQ(feature("space_unseen", f), 1);
  for (const std::string_view name : {"left_across", "violations", "opposed"}) EXPECT_EQ(feature(name, f), 0) << name;
  const LinkFeatures many = link_features(usual_link(), std::nullopt, usual_set());
  EXPECT_EQ(feature("across_unknown", many), 0);
  EXPECT_EQ(feature("space_unseen", many), 0);
}

// One in a hundred of 200 points is two, which chance makes of none; of 20,000 it is 200.
TEST(LinkFeatures, OfFewPointsTheSameShareOfViolationsProvesLess) {
  const auto violations = [](std::size_t num_points) {
    LinkMeasurements m = usual_link();
    m.free_space = {num_points, num_points / 100, 0, 0};
    return feature("violations", link_features(m, std::nullopt, usual_set()));
  };
  EXPECT_LT(violations(200), violations(2000));
  EXPECT_LT(violations(2000), violations(20000));
}

TEST(SetReference, OfNoHypothesesKeepsToTheVoxel) {
  const SetReference set = SetReference::of(0.2, 0.01, {});
  EXPECT_EQ(set.voxel_m, 0.2);
  EXPECT_EQ(set.noise_m, 0.01);
  EXPECT_EQ(set.best_inlier_share, 1);
  EXPECT_EQ(set.typical_residual_m, 0.2);
}

// Twenty hypotheses: the two with the most consensus have residuals of 0.01 and 0.02, the others far larger ones.
TEST(SetReference, TakesTheTenthWithTheMostConsensus) {
  std::vector<LinkMeasurements> hypotheses;
  for (int i = 0; i < 20; ++i) {
    LinkMeasurements m;
    m.evidence.overlap = 0.5;
    m.evidence.inlier_share = 0.04 * (i + 1);  // 0.04 .. 0.8
    m.evidence.median_residual_m = i == 19 ? 0.01 : i == 18 ? 0.02 : 0.5;
    hypotheses.push_back(m);
  }
  const SetReference set = SetReference::of(0.1, 0.01, hypotheses);
  EXPECT_GE(set.typical_residual_m, 0.01);
  EXPECT_LE(set.typical_residual_m, 0.02);
  EXPECT_GE(set.best_inlier_share, 0.72) << "the 0.95 quantile, between the third best";
  EXPECT_LE(set.best_inlier_share, 0.8) << "and the best";
  std::reverse(hypotheses.begin(), hypotheses.end());
  const SetReference backwards = SetReference::of(0.1, 0.01, hypotheses);
  EXPECT_EQ(backwards.typical_residual_m, set.typical_residual_m);
  EXPECT_EQ(backwards.best_inlier_share, set.best_inlier_share);
}

TEST(SetReference, OneHypothesisIsComparedWithItself) {
  const SetReference set = SetReference::of(kVoxel_m, kNoise_m, {usual_link()});
  const LinkFeatures f = link_features(usual_link(), std::nullopt, set);
  EXPECT_EQ(feature("inliers_by_best", f), 0);
  EXPECT_EQ(feature("residual_by_typical", f), 0);
}

}  // namespace
}  // namespace tcm_icp
