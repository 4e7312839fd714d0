#include "links/pair_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "io/temp_files.hpp"
#include "links/empty_hypotheses.hpp"
#include "pipeline/prepared_scene.hpp"
#include "tcm_icp/coarse/vertical.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/visibility/sight.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::no_hypotheses;
using testing::PreparedScene;
using Pair = std::pair<std::size_t, std::size_t>;

// What a search refers to while it lives.
const LinkSearchOptions kOptions;
const RunContext kContext;

constexpr std::size_t kPoints = 15000;

// Buildings, walls and ground of a town's yard, the frames turned in any way.
PreparedScene yard(std::size_t num_scans, std::uint64_t seed) {
  Rng rng = make_stream(seed, "pair_search_test");
  return testing::prepared_scene({.num_scans = num_scans, .points_per_scan = kPoints, .noise_m = 0.01}, rng);
}

double error_m(const PreparedScene& s, const Pair& pair, const LinkHypothesis& h) {
  return testing::pose_rmse_m(s.scene.T_target_source(pair.first, pair.second), h.T_a_b,
                              s.scene.scans[pair.second].points);
}

std::vector<Pair> tried(const HypothesisSet& set) {
  std::vector<Pair> pairs;
  for (const auto& [pair, hypotheses] : set.pairs()) pairs.push_back(pair);
  return pairs;
}

std::vector<bool> all(std::size_t num_scans) { return std::vector<bool>(num_scans, true); }
// Groups of one scan each.
std::vector<std::size_t> apart(std::size_t num_scans) {
  std::vector<std::size_t> groups(num_scans);
  std::iota(groups.begin(), groups.end(), std::size_t{0});
  return groups;
}

TEST(PairSearch, FindsThePosesOfASetInUnknownFrames) {
  const PreparedScene s = yard(3, 1);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  ASSERT_TRUE(search.extend(all(3), apart(3), set));
  EXPECT_EQ(tried(set), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  for (const auto& [pair, hypotheses] : set.pairs()) {
    ASSERT_FALSE(hypotheses.empty());
    const LinkHypothesis& best = hypotheses.front();
    EXPECT_LE(error_m(s, pair, best), 0.25 * s.resolutions.coarse_m) << pair.first << " " << pair.second;
    EXPECT_GT(best.log_odds, 0);
    EXPECT_EQ(best.candidate.method, CoarseMethod::kHeightMap) << "the cheap way comes first";
  }
}

TEST(PairSearch, AsksLocalFeaturesNextThenSlidesAndThenNothing) {
  const PreparedScene s = yard(2, 2);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  const auto methods = [&] {
    std::vector<CoarseMethod> out;
    for (const auto& h : set.pairs().at({0, 1})) out.push_back(h.candidate.method);
    return out;
  };
  const auto count = [](const std::vector<CoarseMethod>& of, CoarseMethod method) {
    return std::count(of.begin(), of.end(), method);
  };
  ASSERT_TRUE(search.extend(all(2), apart(2), set));
  const auto by_maps = methods();
  EXPECT_EQ(count(by_maps, CoarseMethod::kHeightMap), static_cast<std::ptrdiff_t>(by_maps.size()));
  ASSERT_TRUE(search.extend(all(2), apart(2), set));
  const auto by_features = methods();
  EXPECT_EQ(count(by_features, CoarseMethod::kHeightMap), static_cast<std::ptrdiff_t>(by_maps.size()));
  EXPECT_EQ(count(by_features, CoarseMethod::kSlide), 0);
  EXPECT_TRUE(search.extend(all(2), apart(2), set)) << "slides";
  EXPECT_EQ(count(methods(), CoarseMethod::kFeatures), count(by_features, CoarseMethod::kFeatures));
  EXPECT_FALSE(search.extend(all(2), apart(2), set)) << "no pair is tried twice";
}

// As if seen from high above, where nothing hides.
void let_see(PreparedScene& s, std::size_t scan) {
  Viewpoint viewpoint;
  viewpoint.place = s.scene.T_world_scan[scan].inverse() * Eigen::Vector3d(0, 0, 60);
  viewpoint.hidden_share = 0;
  viewpoint.extent_m = 20;
  s.scans[scan].sight = make_sight(viewpoint, s.scans[scan].fine.cloud.points, s.scans[scan].pyramid.level(0).cloud);
  ASSERT_TRUE(s.scans[scan].sight.sees_space());
}

TEST(PairSearch, AsksForMoreOfBothWhereFreeSpaceCanTell) {
  PreparedScene s = yard(3, 2);
  let_see(s, 0);
  let_see(s, 1);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  for (const char* method : {"height maps", "features", "slides"}) {
    ASSERT_TRUE(search.extend(all(3), apart(3), set)) << method;
  }
  const auto before = set.pairs();
  EXPECT_TRUE(search.extend(all(3), apart(3), set)) << "more of height maps";
  EXPECT_TRUE(search.extend(all(3), apart(3), set)) << "more of features";
  EXPECT_FALSE(search.extend(all(3), apart(3), set));
  for (const Pair& blind : {Pair{0, 2}, Pair{1, 2}}) {
    EXPECT_EQ(set.pairs().at(blind).size(), before.at(blind).size()) << "its third scan sees nothing";
  }
  EXPECT_GE(set.pairs().at({0, 1}).size(), before.at({0, 1}).size());
  std::vector<std::size_t> reported;
  RunContext counting;
  counting.on_progress = [&](const Progress& p) {
    if (p.stage == "comparing more of features") reported.push_back(p.total);
    return Continue::kYes;
  };
  PairSearch again(s.scans, kOptions, counting);
  HypothesisSet other = no_hypotheses(s);
  while (again.extend(all(3), apart(3), other)) {
  }
  EXPECT_EQ(reported, std::vector<std::size_t>{1}) << "of the pair that sees";
}

// Of scans 0 to 2 as they were about to be put; what is known of 3 is nothing, and 4 was put where it meets no other.
TEST(PairSearch, InitialPosesAreFittedWhereTheyOverlap) {
  Rng rng = make_stream(8, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 5, .points_per_scan = 4000, .noise_m = 0.01}, rng);
  std::vector<std::optional<Isometry3d>> T_common_scan;
  for (std::size_t i = 0; i < 3; ++i) {
    T_common_scan.emplace_back(testing::perturbed(s.scene.T_world_scan[i], s.scene.scans[i].points, 0.03, 0.3, rng));
  }
  T_common_scan.push_back(std::nullopt);
  T_common_scan.emplace_back(Eigen::Translation3d(1000, 0, 0) * s.scene.T_world_scan[4]);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  search.try_guesses(T_common_scan, set);
  EXPECT_EQ(tried(set), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  for (const auto& [pair, hypotheses] : set.pairs()) {
    const double tolerance = 0.25 * s.resolutions.coarse_m;
    ASSERT_EQ(hypotheses.size(), 1u);
    const auto& guess = hypotheses.front().candidate;
    EXPECT_EQ(guess.method, CoarseMethod::kGuess);
    ASSERT_GT(testing::pose_rmse_m(s.scene.T_target_source(pair.first, pair.second), guess.T_target_source,
                                   s.scene.scans[pair.second].points),
              tolerance);
    EXPECT_LE(error_m(s, pair, hypotheses.front()), tolerance);
  }
  ASSERT_TRUE(search.extend(all(5), apart(5), set)) << "what was guessed is searched, too";
  EXPECT_EQ(tried(set).size(), 10u);
}

TEST(PairSearch, ImpliedPosesAreFittedOnceWhereTheyOverlap) {
  Rng rng = make_stream(8, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 3, .points_per_scan = 4000, .noise_m = 0.01}, rng);
  const auto off = [&](std::size_t a, std::size_t b, double shift_m) {
    return ImpliedPose{a, b,
                       testing::perturbed(s.scene.T_target_source(a, b), s.scene.scans[b].points, 0.02, shift_m, rng)};
  };
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  const std::vector<ImpliedPose> poses{off(0, 1, 0.2), off(1, 2, 1000)};
  ASSERT_TRUE(search.try_implied(poses, set));
  EXPECT_EQ(tried(set), (std::vector<Pair>{{0, 1}})) << "1 and 2 do not meet there";
  const LinkHypothesis& found = set.pairs().at({0, 1}).front();
  EXPECT_EQ(found.candidate.method, CoarseMethod::kImplied);
  EXPECT_LE(error_m(s, {0, 1}, found), 0.25 * s.resolutions.coarse_m);
  EXPECT_FALSE(search.try_implied(poses, set)) << "known";
  EXPECT_FALSE(search.try_implied({}, set));
}

// A set without clear poses puts its scans elsewhere round after round.
TEST(PairSearch, APairIsAskedAtFewOfManyImpliedPoses) {
  Rng rng = make_stream(8, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 2, .points_per_scan = 4000, .noise_m = 0.01}, rng);
  const Isometry3d T = s.scene.T_target_source(0, 1);
  const Eigen::Vector3d& middle = s.scans[1].moments.mean;
  constexpr int kTurns = 36;
  const auto turned = [&](int k) -> Isometry3d {
    const Eigen::AngleAxisd turn(2 * EIGEN_PI * k / kTurns, Eigen::Vector3d::UnitZ());
    return T * Eigen::Translation3d(middle) * turn * Eigen::Translation3d(-middle);
  };
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  int num_asked = 0;
  for (int k = 1; k < kTurns; ++k) num_asked += search.try_implied({{0, 1, turned(k)}}, set) ? 1 : 0;
  EXPECT_GT(num_asked, 4);
  EXPECT_LT(num_asked, kTurns / 2);
  search.try_guesses({Isometry3d::Identity(), turned(0)}, set);
  EXPECT_LE(error_m(s, {0, 1}, set.pairs().at({0, 1}).front()), 0.25 * s.resolutions.coarse_m)
      << "what a user says is asked in any case";
}

TEST(PairSearch, TriesThePairsOfWantedScansAlone) {
  Rng rng = make_stream(3, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 4, .points_per_scan = 2000}, rng);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  EXPECT_FALSE(search.extend(std::vector<bool>(4, false), apart(4), set));
  ASSERT_TRUE(search.extend({false, false, true, false}, apart(4), set));
  EXPECT_EQ(tried(set), (std::vector<Pair>{{0, 2}, {1, 2}, {2, 3}}));
  ASSERT_TRUE(search.extend({false, true, false, false}, apart(4), set));
  EXPECT_EQ(tried(set), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(PairSearch, PairsWithinAGroupAreNotTried) {
  Rng rng = make_stream(3, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 4, .points_per_scan = 2000}, rng);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  ASSERT_TRUE(search.extend(all(4), {7, 7, 1, 7}, set));
  EXPECT_EQ(tried(set), (std::vector<Pair>{{0, 2}, {1, 2}, {2, 3}}));
}

TEST(PairSearch, LevelledScansAreTriedUprightOnly) {
  const PreparedScene upright = [] {
    Rng rng = make_stream(4, "pair_search_test");
    testing::SyntheticScene scene =
        testing::synthetic_scene({.num_scans = 2, .points_per_scan = kPoints, .noise_m = 0.01}, rng);
    PreparedScene out;
    std::vector<SampledScan> scans;
    for (std::size_t i = 0; i < 2; ++i) {
      const Isometry3d T_turned_world(Eigen::AngleAxisd(2.0 + static_cast<double>(i), Eigen::Vector3d::UnitZ()));
      const Isometry3d T_turned_scan = T_turned_world * scene.T_world_scan[i];
      scene.scans[i] = transformed(scene.scans[i], T_turned_scan);
      scene.T_world_scan[i] = T_turned_world.inverse();
      scans.push_back(testing::sampled(scene.scans[i], std::to_string(i) + ".ply"));
    }
    out.resolutions = choose_resolutions(scans, {}, 1);
    for (const auto& scan : scans) out.scans.push_back(prepare_scan(scan, out.resolutions, {}, 42));
    out.scene = scene;
    return out;
  }();
  LinkSearchOptions level;
  level.level = true;
  PairSearch search(upright.scans, level, kContext);
  HypothesisSet set = no_hypotheses(upright);
  while (search.extend(all(2), apart(2), set)) continue;
  const auto& hypotheses = set.pairs().at({0, 1});
  ASSERT_FALSE(hypotheses.empty());
  EXPECT_LE(error_m(upright, {0, 1}, hypotheses.front()), 0.25 * upright.resolutions.coarse_m);
  for (const auto& h : hypotheses) {
    EXPECT_GT(h.candidate.T_target_source.linear()(2, 2), std::cos(2 * kMaxLevelTilt_deg * EIGEN_PI / 180));
  }
}

// Two places of six scans each: a scan's own place comes before the other.
TEST(PairSearch, ManyScansAreTriedWithTheirLikeliestPartnersFirst) {
  constexpr std::size_t kEach = 6, kAll = 2 * kEach;
  Rng rng = make_stream(6, "pair_search_test");
  PreparedScene s = testing::prepared_scene({.num_scans = kEach, .points_per_scan = 2000}, rng);
  const PreparedScene other = testing::prepared_scene(
      {.shape = testing::SyntheticShape::kRubble, .num_scans = kEach, .points_per_scan = 2000}, rng);
  for (std::size_t i = 0; i < kEach; ++i) {
    s.scans.push_back(
        prepare_scan(testing::sampled(other.scene.scans[i], std::to_string(kEach + i)), s.resolutions, {}, 42));
  }
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  std::vector<bool> wanted(kAll, false);
  wanted[3] = true;
  const auto pair_with = [](std::size_t b) { return Pair(std::min<std::size_t>(3, b), std::max<std::size_t>(3, b)); };
  ASSERT_TRUE(search.extend(wanted, apart(wanted.size()), set));
  EXPECT_LT(set.pairs().size(), kAll - 1);
  for (std::size_t b = 0; b < kEach; ++b) {
    if (b == 3) continue;
    EXPECT_EQ(set.pairs().count(pair_with(b)), 1u) << b;
  }
  while (search.extend(wanted, apart(wanted.size()), set)) continue;
  EXPECT_EQ(set.pairs().size(), kAll - 1) << "one that is still wanted gets all others in the end";
}

// Of smaller sets each call is another method.
TEST(PairSearch, AFewScansOfALargeSetAreTriedByAllMethodsAtOnce) {
  constexpr std::size_t kAll = 26;
  Rng rng = make_stream(7, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = kAll, .points_per_scan = 800}, rng);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  std::vector<bool> wanted(kAll, false);
  wanted[3] = true;
  for (const std::size_t partners : {6, 12, 24}) {
    ASSERT_TRUE(search.extend(wanted, apart(kAll), set)) << partners;
    EXPECT_EQ(set.pairs().size(), partners);
  }
  EXPECT_FALSE(search.extend(wanted, apart(kAll), set)) << "that it has 24 partners is enough";
}

// Words choose whom a scan is aligned with, 24 others at first; the last one meets the whole set.
TEST(PairSearch, TheLastScanOfALargeSetIsAlignedWithAll) {
  constexpr std::size_t kAll = 30;
  Rng rng = make_stream(8, "pair_search_test");
  PreparedScene s = testing::prepared_scene({.num_scans = kAll, .points_per_scan = 800}, rng);
  for (std::size_t i = 0; i < kAll; ++i) s.scans[i].digest = std::to_string(i);
  const test::TempFolder folder;
  const StepStore store(folder.path() / "work");
  PairSearch search(s.scans, kOptions, kContext, {&store, {}});
  HypothesisSet set = no_hypotheses(s);
  std::vector<bool> wanted(kAll, false);
  wanted[3] = true;
  ASSERT_TRUE(search.extend(wanted, apart(kAll), set));
  EXPECT_EQ(store.counts()["rankings"].num_made, kAll - 1);
  EXPECT_EQ(store.counts()["features"].num_made, 6u) << "by both levels only those it is compared with";
  EXPECT_EQ(set.pairs().size(), 6u);
}

// Two halves, the ends of which are asked for one another: each with the six that its features fit best, and the six
// that its height map does.
TEST(PairSearch, SomeOfTwoGroupsOfALargeSetAreTriedWithTheLikeliestOfTheOther) {
  constexpr std::size_t kAll = 30, kHalf = 15, kSome = 10;
  Rng rng = make_stream(8, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = kAll, .points_per_scan = 800}, rng);
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  std::vector<std::size_t> groups(kAll, 0), some;
  for (std::size_t i = kHalf; i < kAll; ++i) groups[i] = 1;
  for (std::size_t i = 0; i < kSome; ++i) some.insert(some.end(), {i, kHalf + i});
  ASSERT_TRUE(search.try_between(some, groups, set));
  std::vector<std::size_t> num_partners(kAll, 0);
  for (const auto& [a, b] : tried(set)) {
    EXPECT_NE(groups[a], groups[b]);
    ++num_partners[a];
    ++num_partners[b];
  }
  for (std::size_t i = 0; i < kAll; ++i) {
    const bool is_asked = i % kHalf < kSome;
    EXPECT_GE(num_partners[i], is_asked ? 6 : 0) << i;
    EXPECT_LE(num_partners[i], is_asked ? kSome : 0) << i;
  }
  EXPECT_LT(tried(set).size(), kSome * kSome) << "not all with all";
  EXPECT_FALSE(search.try_between(some, groups, set)) << "no pair is tried twice";
  EXPECT_FALSE(search.try_between(some, std::vector<std::size_t>(kAll, 0), set)) << "none lies between groups";
}

TEST(PairSearch, ScansBetweenGroupsAreAskedInLargeSetsAloneAndFewerThanAPairOfEachWouldCost) {
  const auto most_of = [](std::size_t num_scans) {
    Rng rng = make_stream(7, "pair_search_test");
    const PreparedScene s = testing::prepared_scene({.num_scans = num_scans, .points_per_scan = 800}, rng);
    return PairSearch(s.scans, kOptions, kContext).most_between();
  };
  EXPECT_EQ(most_of(25), 0u);
  const std::size_t most = most_of(26);
  EXPECT_GT(most, 6u);
  EXPECT_LE(most * (most - 1) / 2, 3u * 26) << "first partners were no more";
}

TEST(PairSearch, AStrangersPosesAreLessLikelyThanThoseOfScansOfOnePlace) {
  PreparedScene s = yard(2, 4);
  Rng rng = make_stream(4, "pair_search_test rubble");
  const auto rubble = testing::synthetic_scene(
      {.shape = testing::SyntheticShape::kRubble, .num_scans = 1, .points_per_scan = kPoints, .noise_m = 0.01}, rng);
  s.scans.push_back(prepare_scan(testing::sampled(rubble.scans[0], "2.ply"), s.resolutions, {}, 42));
  PairSearch search(s.scans, kOptions, kContext);
  HypothesisSet set = no_hypotheses(s);
  while (search.extend(all(3), apart(3), set)) continue;
  ASSERT_LE(error_m(s, {0, 1}, set.pairs().at({0, 1}).front()), 0.25 * s.resolutions.coarse_m);
  EXPECT_GT(set.log_odds(0, 1), set.log_odds(0, 2) + 3);
  EXPECT_GT(set.log_odds(0, 1), set.log_odds(1, 2) + 3);
}

TEST(PairSearch, ThreadsDoNotChangeABit) {
  Rng rng = make_stream(6, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 3, .points_per_scan = 5000, .noise_m = 0.01}, rng);
  const auto found_by = [&](int num_threads) {
    RunContext context;
    context.num_threads = num_threads;
    PairSearch search(s.scans, kOptions, context);
    HypothesisSet set = no_hypotheses(s);
    while (search.extend(all(3), apart(3), set)) continue;
    return set.pairs();
  };
  const auto one = found_by(1), two = found_by(2);
  ASSERT_EQ(one.size(), two.size());
  for (const auto& [pair, hypotheses] : one) {
    const auto& other = two.at(pair);
    ASSERT_EQ(hypotheses.size(), other.size());
    for (std::size_t k = 0; k < other.size(); ++k) {
      EXPECT_EQ(hypotheses[k].log_odds, other[k].log_odds);
      EXPECT_TRUE(hypotheses[k].T_a_b.matrix() == other[k].T_a_b.matrix());
    }
  }
}

TEST(PairSearch, StopsWhenAsked) {
  Rng rng = make_stream(7, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 2, .points_per_scan = 1000}, rng);
  for (const std::string stage : {"comparing height maps", "comparing features", "comparing along corridors"}) {
    RunContext context;
    context.on_progress = [&](const Progress& p) { return p.stage == stage ? Continue::kStop : Continue::kYes; };
    PairSearch search(s.scans, kOptions, context);
    HypothesisSet set = no_hypotheses(s);
    const auto search_all = [&] {
      while (search.extend(all(2), apart(2), set)) continue;
    };
    EXPECT_THROW(search_all(), Cancelled) << stage;
  }
}

}  // namespace
}  // namespace tcm_icp
