#include "tcm_icp/coarse/feature_alignment.hpp"

#include <gtest/gtest.h>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using testing::SyntheticScene;
using testing::SyntheticSceneOptions;
using testing::SyntheticShape;

struct DescribedScene {
  SyntheticScene scene;
  double voxel_m = 0;
  std::vector<ScanPyramid> pyramids;
  std::vector<DescribedScan> described;

  FeatureView view(std::size_t i) const { return {pyramids[i], described[i]}; }
};

DescribedScene describe(SyntheticScene scene) {
  DescribedScene out{std::move(scene), 0, {}, {}};
  out.voxel_m = 2 * out.scene.spacing_m;
  for (const Cloud& cloud : out.scene.scans) {
    Rng rng = make_stream(1, "check points");
    out.pyramids.emplace_back(cloud, out.voxel_m / 2, 3);
    out.described.push_back(describe_scan(out.pyramids.back(), {}, rng));
  }
  return out;
}

DescribedScene yard(double noise_m, std::uint64_t seed) {
  Rng rng = make_stream(seed, "feature alignment");
  SyntheticSceneOptions options;
  options.points_per_scan = 20000;
  options.noise_m = noise_m;
  return describe(testing::synthetic_scene(options, rng));
}

// The basin of the fine registration: two voxels of the finer level are well inside.
void expect_first_is_right(const DescribedScene& s) {
  const auto candidates = align_by_features(s.view(0), s.view(1), {});
  const Eigen::Isometry3d truth = s.scene.T_target_source(0, 1);
  const Points& points = s.scene.scans[1].points;
  ASSERT_GT(testing::pose_rmse_m(truth, Eigen::Isometry3d::Identity(), points), 20 * s.voxel_m);
  ASSERT_FALSE(candidates.empty());
  EXPECT_LT(testing::pose_rmse_m(truth, candidates.front().T_target_source, points), 2 * s.voxel_m);
  EXPECT_GT(candidates.front().margin, 1.5);
  EXPECT_EQ(CoarseMethod::kFeatures, candidates.front().method);
}

TEST(FeatureAlignment, PlacesScansThatShareASurface) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) expect_first_is_right(yard(0, seed));
}

TEST(FeatureAlignment, PlacesNoisyScans) { expect_first_is_right(yard(0.02, 4)); }

TEST(FeatureAlignment, CandidatesAreSortedRigidAndFew) {
  const DescribedScene s = yard(0.02, 5);
  FeatureAlignmentOptions options;
  options.max_candidates = 3;
  const auto candidates = align_by_features(s.view(0), s.view(1), options);
  ASSERT_LE(candidates.size(), 3U);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    EXPECT_TRUE(is_rigid(candidates[k].T_target_source.matrix(), 1e-6));
    if (k > 0) {
      EXPECT_LE(candidates[k].score, candidates[k - 1].score);
      EXPECT_LE(candidates[k].margin, 1);
    }
  }
}

TEST(FeatureAlignment, IsTheSameInAllUnits) {
  DescribedScene s = yard(0, 6);
  const auto metres = align_by_features(s.view(0), s.view(1), {});
  constexpr double kFactor = 1000;
  for (auto& scan : s.scene.scans) scan = testing::scaled_cloud(scan, kFactor);
  s.scene.spacing_m *= kFactor;
  const DescribedScene scaled = describe(s.scene);
  const auto other = align_by_features(scaled.view(0), scaled.view(1), {});
  ASSERT_EQ(metres.size(), other.size());
  for (std::size_t k = 0; k < metres.size(); ++k) {
    EXPECT_TRUE(testing::is_pose_near(testing::scaled_pose(metres[k].T_target_source, kFactor),
                                      other[k].T_target_source, 1e-9 * kFactor, 1e-9));
  }
}

TEST(FeatureAlignment, ScoresStrangersBelowNeighbours) {
  Rng rng = make_stream(7, "rubble");
  SyntheticSceneOptions options;
  options.points_per_scan = 20000;
  options.shape = SyntheticShape::kRubble;
  options.num_scans = 1;
  SyntheticScene scene = yard(0, 7).scene;
  scene.scans.push_back(testing::synthetic_scene(options, rng).scans.front());
  const DescribedScene s = describe(scene);
  const auto right = align_by_features(s.view(0), s.view(1), {});
  const auto wrong = align_by_features(s.view(0), s.view(2), {});
  ASSERT_FALSE(right.empty());
  EXPECT_GT(right.front().score, 2 * (wrong.empty() ? 0 : wrong.front().score));
}

TEST(FeatureAlignment, FindsNothingInTooFewPoints) {
  const Cloud cloud{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 0, 1}}};
  const ScanPyramid pyramid(cloud, 0.1, 3);
  Rng rng = make_stream(8, "two points");
  const DescribedScan described = describe_scan(pyramid, {}, rng);
  EXPECT_TRUE(align_by_features({pyramid, described}, {pyramid, described}, {}).empty());
}

TEST(FeatureAlignmentOptions, NameWhatIsWrong) {
  FeatureAlignmentOptions options;
  options.levels.clear();
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.tolerance_voxels = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.features.normal_radius_voxels = 6;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.levels = {9};
  Rng rng = make_stream(9, "options");
  EXPECT_THROW(describe_scan(ScanPyramid({{{0, 0, 0}}, {{0, 0, 1}}}, 1, 2), options, rng), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
