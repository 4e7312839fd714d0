#include "scans/prepared_scan.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "pipeline/prepared_scene.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using testing::sampled;

std::set<std::tuple<double, double, double>> as_set(const Points& points) {
  std::set<std::tuple<double, double, double>> out;
  for (const auto& p : points) out.emplace(p.x(), p.y(), p.z());
  return out;
}

Cloud yard(std::uint64_t seed, std::size_t num_points = 6000) {
  Rng rng = make_stream(seed, "prepared_scan_test");
  return testing::synthetic_scene({.num_scans = 1, .points_per_scan = num_points}, rng).scans[0];
}

PreparedScan prepare(const Cloud& cloud, const SampleSizes& options, std::uint64_t seed = 42) {
  const SampledScan scan = sampled(cloud, "a.ply");
  return prepare_scan(scan, choose_resolutions({scan}, {}, 1), options, seed);
}

TEST(PrepareScan, HeldOutPointsAreInNoFit) {
  SampleSizes options;
  options.fine_points = 900;
  options.held_out_points = 300;
  const PreparedScan scan = prepare(yard(1), options);
  EXPECT_EQ(scan.fit_sample.size(), 900u);
  EXPECT_EQ(scan.held_out_sample.size(), 300u);
  auto both = as_set(scan.fit_sample.points);
  both.merge(as_set(scan.held_out_sample.points));
  EXPECT_EQ(both.size(), 1200u);
  EXPECT_EQ(scan.verification_sample.points, scan.held_out_sample.points) << "there are enough";
}

TEST(PrepareScan, SmallScansAreSharedInTheProportionAskedFor) {
  const PreparedScan scan = prepare(yard(2, 400), {});  // 4,500 points wanted, 3,000 of them for the fit
  const std::size_t total = scan.fit_sample.size() + scan.held_out_sample.size();
  ASSERT_GT(total, 100u);
  ASSERT_LT(total, 400u);
  EXPECT_EQ(scan.held_out_sample.size(), total / 3);
}

TEST(PrepareScan, AllPointsOfASmallScanVerify) {
  const PreparedScan scan = prepare(yard(2, 400), {});
  auto all = as_set(scan.fit_sample.points);
  all.merge(as_set(scan.held_out_sample.points));
  EXPECT_EQ(as_set(scan.verification_sample.points), all);
}

TEST(PrepareScan, AsManyPointsOfAScanVerifyAsAreAskedForBeginningWithThoseInNoFit) {
  SampleSizes options;
  options.fine_points = 3000;
  options.held_out_points = 150;
  const PreparedScan scan = prepare(yard(2, 400), options);
  const auto verifying = as_set(scan.verification_sample.points);
  EXPECT_EQ(scan.verification_sample.size(), 150u);
  EXPECT_LT(scan.held_out_sample.size(), 150u);
  for (const auto& p : as_set(scan.held_out_sample.points)) EXPECT_TRUE(verifying.contains(p));
}

TEST(PrepareScan, FitsAndVerificationUseSurfacesOnly) {
  SampledScan scan = sampled(yard(3), "a.ply");
  for (std::size_t i = 0; i < scan.is_surface.size(); i += 2) scan.is_surface[i] = 0;  // rough places
  const PreparedScan prepared = prepare_scan(scan, choose_resolutions({scan}, {}, 1), {}, 42);
  for (const Cloud* const cloud : {&prepared.fit_sample, &prepared.verification_sample, &prepared.fine_sample}) {
    ASSERT_FALSE(cloud->empty());
    for (const auto& n : cloud->normals) EXPECT_NEAR(n.norm(), 1, 1e-9);
  }
}

TEST(PrepareScan, SeedAndFileDecideTheSamples) {
  EXPECT_EQ(prepare(yard(4), {}).fit_sample.points, prepare(yard(4), {}).fit_sample.points);
  EXPECT_NE(prepare(yard(4), {}).held_out_sample.points, prepare(yard(4), {}, 43).held_out_sample.points);
}

TEST(ChooseResolutions, GiveTheMiddleScanTheWantedVoxelsAndScaleWithTheData) {
  std::vector<SampledScan> scans, large;
  for (const std::uint64_t seed : {5u, 6u, 7u}) {
    const Cloud cloud = testing::scaled_cloud(yard(seed), static_cast<double>(seed));
    scans.push_back(sampled(cloud, "a.ply"));
    large.push_back(sampled(testing::scaled_cloud(cloud, 1000), "a.ply"));
  }
  SamplingOptions options;
  options.coarse_voxels = 500;
  options.fine_voxels = 2000;
  const Resolutions resolutions = choose_resolutions(scans, options, 1);
  const std::size_t coarse = count_voxels(scans[1].scan.cloud.points, resolutions.coarse_m);
  EXPECT_GE(coarse, 500u);
  EXPECT_LE(coarse, 1000u);
  EXPECT_LT(resolutions.fine_m, 0.7 * resolutions.coarse_m);
  EXPECT_NEAR(choose_resolutions(large, options, 2).coarse_m / resolutions.coarse_m, 1000, 1e-9);
}

// Finer voxels would hold lines of points, or noise.
TEST(ChooseResolutions, AreNoFinerThanWhatPointsCoverAndNoiseAllows) {
  SampledScan scan = sampled(yard(8), "a.ply");
  const Resolutions by_count = choose_resolutions({scan}, {}, 1);
  scan.scan.coverage_m = 4 * by_count.coarse_m;
  const Resolutions sparse = choose_resolutions({scan}, {}, 1);
  EXPECT_EQ(sparse.coarse_m, rounded_voxel_size(scan.scan.coverage_m));
  EXPECT_GT(sparse.fine_m, by_count.fine_m);
  EXPECT_LE(sparse.fine_m, sparse.coarse_m);
  scan.scan.coverage_m = 0;
  scan.scan.noise_m = by_count.coarse_m;
  const Resolutions noisy = choose_resolutions({scan}, {}, 1);
  EXPECT_GT(noisy.coarse_m, 2 * scan.scan.noise_m);
  EXPECT_GT(noisy.fine_m, by_count.fine_m);
  EXPECT_LE(noisy.fine_m, noisy.coarse_m);
  scan.scan.noise_m = 0.001 * by_count.fine_m;
  EXPECT_EQ(choose_resolutions({scan}, {}, 1).coarse_m, by_count.coarse_m) << "a usual scan's noise says nothing";
}

}  // namespace
}  // namespace tcm_icp
