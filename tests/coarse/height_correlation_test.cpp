#include "tcm_icp/coarse/height_correlation.hpp"

#include <algorithm>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::testing {
namespace {

// What the refinement starts from: 5 degrees, and a small part of the yard's 24 m.
constexpr double kTolerance_rad = 5 * EIGEN_PI / 180;
constexpr double kTolerance_m = 1;

SyntheticScene yard(double noise_m, double outlier_share, Rng& rng) {
  SyntheticSceneOptions options;
  options.num_scans = 3;
  options.points_per_scan = 20000;
  options.noise_m = noise_m;
  options.outlier_share = outlier_share;
  return synthetic_scene(options, rng);
}

std::vector<const Cloud*> pointers(const std::vector<Cloud>& scans) {
  std::vector<const Cloud*> out;
  for (const auto& scan : scans) out.push_back(&scan);
  return out;
}

std::vector<std::vector<PoseCandidate>> poses_of(const std::vector<const Cloud*>& scans,
                                                 const std::vector<ScanPair>& pairs,
                                                 const HeightCorrelationOptions& options, int num_threads) {
  ScansFromAbove from_above(scans);
  return correlate_height_maps(from_above, pairs, options, num_threads);
}

std::vector<PairScreening> screened(const std::vector<const Cloud*>& scans, const std::vector<ScanPair>& pairs,
                                    const HeightCorrelationOptions& options, int num_threads) {
  ScansFromAbove from_above(scans);
  return screen_by_height_maps(from_above, pairs, options, num_threads);
}

void expect_found(const SyntheticScene& scene) {
  const std::vector<ScanPair> pairs = {{0, 1}, {0, 2}, {2, 1}};
  const auto found = poses_of(pointers(scene.scans), pairs, {}, 1);
  ASSERT_EQ(found.size(), pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Eigen::Isometry3d truth = scene.T_target_source(pairs[k].target, pairs[k].source);
    const Points& points = scene.scans[pairs[k].source].points;
    ASSERT_GT(pose_rmse_m(truth, Eigen::Isometry3d::Identity(), points), 10 * kTolerance_m);
    ASSERT_FALSE(found[k].empty());
    const PoseCandidate& best = found[k].front();
    EXPECT_EQ(best.method, CoarseMethod::kHeightMap);
    EXPECT_LT(rotation_angle_rad(truth.linear().transpose() * best.T_target_source.linear()), kTolerance_rad);
    EXPECT_LT(pose_rmse_m(truth, best.T_target_source, points), kTolerance_m);
    EXPECT_LT(pose_rmse_m(truth, best.T_target_source, points), best.accuracy_m);
    EXPECT_LT(best.accuracy_m, kTolerance_m) << "which tells something";
    EXPECT_GT(best.margin, 1.1);
    for (std::size_t i = 1; i < found[k].size(); ++i) {
      EXPECT_LE(found[k][i].score, found[k][i - 1].score);
      EXPECT_LE(found[k][i].margin, 1);
    }
  }
}

TEST(HeightCorrelation, FindsTheYardFromAnyFrame) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng = make_stream(seed, "test");
    expect_found(yard(0, 0, rng));
  }
}

TEST(HeightCorrelation, FindsTheYardAmongNoiseAndOutliers) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng = make_stream(seed, "test");
    expect_found(yard(0.03, 0.02, rng));
  }
}

TEST(HeightCorrelation, ADeepSearchFindsMoreThanTheSamePoses) {
  Rng rng = make_stream(6, "test");
  const SyntheticScene scene = yard(0.02, 0, rng);
  HeightCorrelationOptions options;
  const auto usual = poses_of(pointers(scene.scans), {{0, 1}}, options, 1)[0];
  options.depth = 4;
  const auto deep = poses_of(pointers(scene.scans), {{0, 1}}, options, 1)[0];
  const auto most = static_cast<std::size_t>(options.max_candidates);
  ASSERT_EQ(usual.size(), most);
  EXPECT_GT(deep.size(), most);
  EXPECT_LE(deep.size(), 4 * most);
  for (const PoseCandidate& pose : usual) {
    EXPECT_TRUE(std::any_of(deep.begin(), deep.end(), [&](const PoseCandidate& other) {
      return pose_rmse_m(pose.T_target_source, other.T_target_source, scene.scans[1].points) < kTolerance_m;
    }));
  }
  for (std::size_t i = 1; i < deep.size(); ++i) EXPECT_LE(deep[i].score, deep[i - 1].score);
}

TEST(HeightCorrelation, HasNoMarginForAStranger) {
  Rng rng = make_stream(4, "test");
  SyntheticScene scene = yard(0.02, 0, rng);
  SyntheticSceneOptions options;
  options.shape = SyntheticShape::kRubble;
  options.points_per_scan = 20000;
  scene.scans.push_back(synthetic_scene(options, rng).scans[0]);
  const auto found = poses_of(pointers(scene.scans), {{0, 1}, {0, 3}, {3, 1}}, {}, 1);
  for (const std::size_t stranger : {1, 2}) {
    ASSERT_FALSE(found[stranger].empty());
    EXPECT_LT(found[stranger].front().score, found[0].front().score);
    EXPECT_LT(found[stranger].front().margin, found[0].front().margin);
  }
}

TEST(HeightCorrelation, ScreeningRanksScansOfOnePlaceBeforeAStranger) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng = make_stream(seed, "test");
    const SyntheticScene here = yard(0.02, 0, rng);
    const SyntheticScene there =
        synthetic_scene({.shape = SyntheticShape::kRubble, .num_scans = 1, .points_per_scan = 20000}, rng);
    std::vector<const Cloud*> scans = pointers(here.scans);
    scans.push_back(&there.scans[0]);
    const std::vector<ScanPair> pairs = {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {3, 2}};
    std::vector<double> scores, on_one_thread;
    for (const auto& found : screened(scans, pairs, screening_options(), 2)) {
      scores.push_back(found.score);
      EXPECT_FALSE(found.ups.empty()) << "a pair with a peak names the directions it was found with";
    }
    const double least = *std::min_element(scores.begin(), scores.begin() + 3);
    const double most = *std::max_element(scores.begin() + 3, scores.end());
    EXPECT_GT(least, 1.2 * most);
    for (const auto& found : screened(scans, pairs, screening_options(), 1)) {
      on_one_thread.push_back(found.score);
    }
    EXPECT_EQ(on_one_thread, scores) << "threads change nothing";
  }
  EXPECT_THROW(screened({}, {{0, 1}}, screening_options(), 1), InvalidInput);
}

TEST(HeightCorrelation, IsTheSameForAnyNumberOfThreads) {
  Rng rng = make_stream(5, "test");
  const SyntheticScene scene = yard(0.02, 0, rng);
  const std::vector<ScanPair> pairs = {{0, 1}, {0, 2}, {1, 2}};
  const auto one = poses_of(pointers(scene.scans), pairs, {}, 1);
  for (const int num_threads : {2, 5}) {
    const auto many = poses_of(pointers(scene.scans), pairs, {}, num_threads);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      ASSERT_EQ(one[k].size(), many[k].size());
      for (std::size_t i = 0; i < one[k].size(); ++i) {
        EXPECT_EQ(one[k][i].T_target_source.matrix(), many[k][i].T_target_source.matrix());
        EXPECT_EQ(one[k][i].score, many[k][i].score);
      }
    }
  }
}

TEST(HeightCorrelation, WhatIsKnownOfScansChangesNothing) {
  Rng rng = make_stream(12, "test");
  const SyntheticScene scene = yard(0.02, 0, rng);
  ScansFromAbove from_above(pointers(scene.scans));
  EXPECT_TRUE(from_above.footprints(0).empty());
  const std::vector<ScanPair> pairs = {{0, 1}};
  const auto first = correlate_height_maps(from_above, pairs, {}, 1)[0];
  const std::vector<Footprint> known = from_above.footprints(0);
  ASSERT_FALSE(known.empty());
  const auto second = correlate_height_maps(from_above, pairs, {}, 1)[0];
  EXPECT_EQ(from_above.footprints(0).size(), known.size()) << "nothing is found twice";
  EXPECT_EQ(from_above.footprints(0).front().T_map_scan.matrix(), known.front().T_map_scan.matrix());
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].T_target_source.matrix(), second[i].T_target_source.matrix());
    EXPECT_EQ(first[i].score, second[i].score);
  }
}

// Spectra are kept of 64 scans at once: pairs come in blocks.
TEST(HeightCorrelation, PairsOfManyScansAreSearchedAsIfAlone) {
  Rng rng = make_stream(11, "test");
  constexpr std::size_t kCopies = 30;  // of three scans
  const SyntheticScene scene = yard(0.02, 0, rng);
  std::vector<const Cloud*> scans;
  std::vector<ScanPair> pairs;
  for (std::size_t copy = 0; copy < kCopies; ++copy) {
    for (const Cloud* scan : pointers(scene.scans)) scans.push_back(scan);
    pairs.push_back({3 * copy, 3 * copy + 1});
    pairs.push_back({3 * copy + 2, (3 * copy + 40) % scans.size()});
  }
  HeightCorrelationOptions options = screening_options();
  const auto all = poses_of(scans, pairs, options, 2);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}, pairs.size() / 2 + 1, pairs.size() - 1}) {
    const auto alone = poses_of(scans, {pairs[k]}, options, 1)[0];
    ASSERT_EQ(alone.size(), all[k].size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(alone[i].T_target_source.matrix(), all[k][i].T_target_source.matrix());
      EXPECT_EQ(alone[i].score, all[k][i].score);
    }
  }
}

TEST(HeightCorrelation, ScalesWithTheInput) {
  Rng rng = make_stream(6, "test");
  const SyntheticScene scene = yard(0.02, 0, rng);
  constexpr double kFactor = 1000;
  std::vector<Cloud> large;
  for (const auto& scan : scene.scans) large.push_back(scaled_cloud(scan, kFactor));
  const auto expected = poses_of(pointers(scene.scans), {{0, 1}}, {}, 1)[0].front();
  const auto actual = poses_of(pointers(large), {{0, 1}}, {}, 1)[0].front();
  EXPECT_EQ(actual.score, expected.score) << "not the same bits";
  EXPECT_NEAR(actual.accuracy_m, kFactor * expected.accuracy_m, 1e-9 * kFactor);
  EXPECT_LT(pose_rmse_m(scaled_pose(expected.T_target_source, kFactor), actual.T_target_source, large[1].points),
            1e-9 * kFactor);
}

TEST(HeightCorrelation, AnswersForDegenerateScans) {
  Rng rng = make_stream(7, "test");
  std::vector<Cloud> scans(3);
  for (int i = 0; i < 500; ++i) {
    scans[0].points.emplace_back(i, 0, 0);
    scans[1].points.emplace_back(i % 20, i / 20, 0);
  }
  scans[2].points = random_points(5, 1, rng);
  const auto found = poses_of(pointers(scans), {{0, 1}, {1, 2}, {2, 0}, {1, 1}}, {}, 1);
  for (const auto& pair : found) {
    for (const auto& candidate : pair) EXPECT_TRUE(is_rigid(candidate.T_target_source.matrix(), 1e-9));
  }
  EXPECT_TRUE(poses_of(pointers(scans), {}, {}, 1).empty());
  EXPECT_THROW(poses_of(pointers(scans), {{0, 3}}, {}, 1), InvalidInput);
  scans[1].points.assign(10, Eigen::Vector3d::Ones());
  EXPECT_THROW(poses_of(pointers(scans), {{0, 1}}, {}, 1), InvalidInput);
}

TEST(HeightCorrelation, RejectsOptionsOutOfBounds) {
  HeightCorrelationOptions options;
  options.cells_across = 2;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.heading_step_deg = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.max_candidates = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.depth = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.map.clip_sigma = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp::testing
