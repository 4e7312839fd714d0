#include "pipeline/pair_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/link_score.hpp"
#include "pipeline/prepared_scene.hpp"
#include "support/matchers.hpp"
#include "tcm_icp/coarse/vertical.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using testing::PreparedScene;
using Pair = std::pair<std::size_t, std::size_t>;

// What a search refers to while it lives.
const PipelineOptions kOptions;
const RunContext kContext;

constexpr std::size_t kPoints = 15000;

// Buildings, walls and ground of a town's yard, the frames turned in any way.
PreparedScene yard(std::size_t num_scans, std::uint64_t seed) {
  Rng rng = make_stream(seed, "pair_search_test");
  return testing::prepared_scene({.num_scans = num_scans, .points_per_scan = kPoints, .noise_m = 0.01}, rng);
}

std::vector<std::string> names(std::size_t count, bool backwards = false) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < count; ++i) files.push_back(std::to_string(backwards ? count - 1 - i : i) + ".ply");
  return files;
}

double error_m(const PreparedScene& s, const Pair& pair, const LinkHypothesis& h) {
  return testing::pose_rmse_m(s.scene.T_target_source(pair.first, pair.second), h.T_a_b,
                              s.scene.scans[pair.second].points);
}

std::vector<Pair> tried(const PoseGraph& graph) {
  std::vector<Pair> pairs;
  for (const auto& [pair, link] : graph.links()) pairs.push_back(pair);
  return pairs;
}

TEST(PairSearch, FindsTheLinksOfASetInUnknownFrames) {
  const PreparedScene s = yard(3, 1);
  const auto files = names(3);
  PairSearch search(s.scans, files, kOptions, kContext);
  PoseGraph graph(3);
  ASSERT_TRUE(search.extend(graph, std::vector<bool>(3, true)));
  EXPECT_EQ(tried(graph), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  for (const auto& [pair, link] : graph.links()) {
    ASSERT_FALSE(link.hypotheses.empty());
    const LinkHypothesis& best = link.hypotheses.front();
    EXPECT_LE(error_m(s, pair, best), 0.25 * s.resolutions.coarse_m) << pair.first << " " << pair.second;
    EXPECT_GE(best.log_odds, kClearLogOdds);
    EXPECT_EQ(best.candidate.method, CoarseMethod::kHeightMap) << "the cheap way comes first";
  }
  EXPECT_EQ(graph.outside_of_largest_group(), std::vector<bool>(3, false));
}

TEST(PairSearch, AsksLocalFeaturesNextThenSlidesAndThenNothing) {
  const PreparedScene s = yard(2, 2);
  const auto files = names(2);
  PairSearch search(s.scans, files, kOptions, kContext);
  PoseGraph graph(2);
  const std::vector<bool> all(2, true);
  ASSERT_TRUE(search.extend(graph, all));
  const std::size_t by_maps = graph.num_hypotheses(0, all);
  ASSERT_TRUE(search.extend(graph, all));
  const auto& hypotheses = graph.links().begin()->second.hypotheses;
  EXPECT_GT(hypotheses.size(), by_maps);
  const auto features = std::find_if(hypotheses.begin(), hypotheses.end(), [](const LinkHypothesis& h) {
    return h.candidate.method == CoarseMethod::kFeatures;
  });
  ASSERT_NE(features, hypotheses.end());
  EXPECT_LE(error_m(s, {0, 1}, *features), 0.25 * s.resolutions.coarse_m);
  EXPECT_TRUE(search.extend(graph, all)) << "slides";
  EXPECT_FALSE(search.extend(graph, all)) << "no pair is tried twice";
}

TEST(PairSearch, TriesThePairsOfWantedScansAlone) {
  Rng rng = make_stream(3, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 4, .points_per_scan = 2000}, rng);
  const auto files = names(4);
  PairSearch search(s.scans, files, kOptions, kContext);
  PoseGraph graph(4);
  EXPECT_FALSE(search.extend(graph, std::vector<bool>(4, false)));
  ASSERT_TRUE(search.extend(graph, {false, false, true, false}));
  EXPECT_EQ(tried(graph), (std::vector<Pair>{{0, 2}, {1, 2}, {2, 3}}));
  ASSERT_TRUE(search.extend(graph, {false, true, false, false}));
  EXPECT_EQ(tried(graph), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
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
  PipelineOptions level;
  level.level = true;
  const auto files = names(2);
  PairSearch search(upright.scans, files, level, kContext);
  PoseGraph graph(2);
  while (search.extend(graph, std::vector<bool>(2, true))) {
  }
  const auto& hypotheses = graph.links().at({0, 1}).hypotheses;
  ASSERT_FALSE(hypotheses.empty());
  EXPECT_LE(error_m(upright, {0, 1}, hypotheses.front()), 0.25 * upright.resolutions.coarse_m);
  for (const auto& h : hypotheses) {
    EXPECT_GT(h.candidate.T_target_source.linear()(2, 2), std::cos(2 * kMaxLevelTilt_deg * EIGEN_PI / 180));
  }
}

TEST(PairSearch, NeverTriesWhatIsLeftOut) {
  const PreparedScene s = yard(3, 2);
  const auto files = names(3);
  PairSearch search(s.scans, files, kOptions, kContext);
  search.leave_out(2, 0);
  PoseGraph graph(3);
  while (search.extend(graph, std::vector<bool>(3, true))) {
  }
  EXPECT_EQ(tried(graph), (std::vector<Pair>{{0, 1}, {1, 2}}));
}

// Two places of eight scans each: a scan's own place comes before the other.
TEST(PairSearch, ManyScansAreTriedWithTheirLikeliestPartnersFirst) {
  constexpr std::size_t kEach = 8, kAll = 2 * kEach;
  Rng rng = make_stream(6, "pair_search_test");
  PreparedScene s = testing::prepared_scene({.num_scans = kEach, .points_per_scan = 3000}, rng);
  const PreparedScene other = testing::prepared_scene(
      {.shape = testing::SyntheticShape::kRubble, .num_scans = kEach, .points_per_scan = 3000}, rng);
  for (std::size_t i = 0; i < kEach; ++i) {
    s.scans.push_back(
        prepare_scan(testing::sampled(other.scene.scans[i], std::to_string(kEach + i)), s.resolutions, {}, 42));
  }
  const auto files = names(kAll);
  PairSearch search(s.scans, files, kOptions, kContext);
  PoseGraph graph(kAll);
  ASSERT_TRUE(search.extend(graph, std::vector<bool>(kAll, true)));
  const auto first = tried(graph);
  EXPECT_LT(first.size(), kAll * (kAll - 1) / 2);
  for (std::size_t a = 0; a < kEach; ++a) {
    for (std::size_t b = a + 1; b < kEach; ++b) {
      EXPECT_TRUE(std::find(first.begin(), first.end(), Pair(a, b)) != first.end()) << a << " " << b;
    }
  }
  // One that nothing was found for gets all others in the end.
  std::vector<bool> wanted(kAll, false);
  wanted[3] = true;
  while (search.extend(graph, wanted)) {
  }
  const auto last = tried(graph);
  for (std::size_t b = 0; b < kAll; ++b) {
    if (b == 3) continue;
    const Pair pair(std::min<std::size_t>(3, b), std::max<std::size_t>(3, b));
    EXPECT_TRUE(std::find(last.begin(), last.end(), pair) != last.end()) << b;
  }
}

TEST(PairSearch, AStrangerHasNoClearLink) {
  PreparedScene s = yard(2, 4);
  Rng rng = make_stream(4, "pair_search_test rubble");
  const auto rubble = testing::synthetic_scene(
      {.shape = testing::SyntheticShape::kRubble, .num_scans = 1, .points_per_scan = kPoints, .noise_m = 0.01}, rng);
  s.scans.push_back(prepare_scan(testing::sampled(rubble.scans[0], "2.ply"), s.resolutions, {}, 42));
  const auto files = names(3);
  PairSearch search(s.scans, files, kOptions, kContext);
  PoseGraph graph(3);
  while (search.extend(graph, std::vector<bool>(3, true))) continue;
  EXPECT_EQ(graph.outside_of_largest_group(), (std::vector<bool>{false, false, true}));
}

// Names, not places in the list, decide which scan of a pair is the target: the same links come out either way.
TEST(PairSearch, TheOrderOfTheFilesDecidesNothing) {
  PreparedScene s = yard(2, 5);
  const auto link_of = [](const std::vector<PreparedScan>& scans, const std::vector<std::string>& files) {
    PairSearch search(scans, files, kOptions, kContext);
    PoseGraph graph(2);
    while (search.extend(graph, {true, true})) continue;
    return graph.links().begin()->second;
  };
  const CandidateLink ab = link_of(s.scans, names(2));
  std::reverse(s.scans.begin(), s.scans.end());
  const CandidateLink ba = link_of(s.scans, names(2, true));
  ASSERT_EQ(ab.hypotheses.size(), ba.hypotheses.size());
  for (std::size_t k = 0; k < ab.hypotheses.size(); ++k) {
    EXPECT_EQ(ab.hypotheses[k].log_odds, ba.hypotheses[k].log_odds);
    EXPECT_TRUE(testing::is_pose_near(ab.hypotheses[k].T_a_b, ba.hypotheses[k].T_a_b.inverse(), 1e-12, 1e-9));
  }
}

TEST(PairSearch, ThreadsDoNotChangeABit) {
  const PreparedScene s = yard(3, 6);
  const auto links_of = [&](int num_threads) {
    RunContext context;
    context.num_threads = num_threads;
    const auto files = names(3);
    PairSearch search(s.scans, files, kOptions, context);
    PoseGraph graph(3);
    while (search.extend(graph, std::vector<bool>(3, true))) continue;
    return graph.links();
  };
  const auto one = links_of(1), two = links_of(2);
  ASSERT_EQ(one.size(), two.size());
  for (const auto& [pair, link] : one) {
    const auto& other = two.at(pair).hypotheses;
    ASSERT_EQ(link.hypotheses.size(), other.size());
    for (std::size_t k = 0; k < other.size(); ++k) {
      EXPECT_EQ(link.hypotheses[k].log_odds, other[k].log_odds);
      EXPECT_TRUE(link.hypotheses[k].T_a_b.matrix() == other[k].T_a_b.matrix());
    }
  }
}

TEST(PairSearch, StopsWhenAsked) {
  Rng rng = make_stream(7, "pair_search_test");
  const PreparedScene s = testing::prepared_scene({.num_scans = 2, .points_per_scan = 1000}, rng);
  for (const std::string stage : {"comparing height maps", "comparing features"}) {
    RunContext context;
    context.on_progress = [&](const Progress& p) { return p.stage == stage ? Continue::kStop : Continue::kYes; };
    const auto files = names(2);
    PairSearch search(s.scans, files, kOptions, context);
    PoseGraph graph(2);
    const auto search_all = [&] {
      while (search.extend(graph, {true, true})) continue;
    };
    EXPECT_THROW(search_all(), Cancelled) << stage;
  }
}

}  // namespace
}  // namespace tcm_icp
