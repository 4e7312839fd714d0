#include "tcm_icp/evaluation/cloud_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/tcm/hausdorff.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

Points some_points(std::size_t count, std::uint64_t seed) {
  Rng rng = make_stream(seed, "test");
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform01(rng);
    const double y = uniform01(rng);
    const double z = uniform01(rng);
    points.push_back({10 * x, 10 * y, 10 * z});
  }
  return points;
}

/// Turns about several axes: a reversed product would show.
Isometry3d some_pose(int i) {
  return Translation3d(20 * i, -7 * i, 3) * Eigen::AngleAxisd(0.9 + i, Vector3d(1, 2, 3).normalized());
}

struct Set {
  Truth truth;
  std::vector<std::optional<Isometry3d>> estimates;
  std::vector<Points> points;

  explicit Set(int num_scans) {
    for (int i = 0; i < num_scans; ++i) {
      truth.scans.push_back({std::to_string(i) + ".ply", some_pose(i), 0});
      estimates.push_back(some_pose(7) * some_pose(i));  // the truth in another common frame
      points.push_back(some_points(300, static_cast<std::uint64_t>(i)));
    }
  }
  CloudComparison compare(std::size_t rms_points = 1000000, std::size_t reference = 0) const {
    Rng rng = make_stream(1, "test");
    return compare_clouds(truth, estimates, reference, points, rms_points, rng, 1);
  }
};

TEST(DirectedDistance, AgreesWithALoopOverAllPairs) {
  const Points a = some_points(200, 1), b = some_points(300, 2);
  std::vector<double> nearest;
  for (const auto& p : a) {
    double least = INFINITY;
    for (const auto& q : b) least = std::min(least, (p - q).norm());
    nearest.push_back(least);
  }
  const double mean = std::accumulate(nearest.begin(), nearest.end(), 0.0) / 200;
  double squares = 0;
  for (const double d : nearest) squares += (d - mean) * (d - mean);
  for (const int threads : {1, 3}) {
    const DirectedDistance d = directed_distance(a, b, threads);
    EXPECT_NEAR(d.mean_m, mean, 1e-12);
    EXPECT_NEAR(d.std_dev_m, std::sqrt(squares / 200), 1e-12);
    EXPECT_NEAR(d.max_m, *std::max_element(nearest.begin(), nearest.end()), 1e-12);
    EXPECT_NEAR(d.max_m * d.max_m, directed_hausdorff(a, b), 1e-12);
    EXPECT_EQ(d.num_points, 200u);
  }
}

TEST(DirectedDistance, RefusesEmptyCloudsAndNaN) {
  const Points a = some_points(3, 1);
  EXPECT_THROW(directed_distance(a, {}, 1), InvalidInput);
  EXPECT_THROW(directed_distance({}, a, 1), InvalidInput);
  EXPECT_THROW(directed_distance({Vector3d(NAN, 0, 0)}, a, 1), InvalidInput);
}

TEST(CompareClouds, ExactPosesInAnyCommonFrameGiveZeros) {
  const CloudComparison c = Set(3).compare();
  EXPECT_EQ(c.num_points, 900u);
  EXPECT_LT(c.rms_m, 1e-9);
  EXPECT_LT(c.hausdorff_m(), 1e-9);
  EXPECT_LT(c.registered_to_truth.mean_m, 1e-9);
}

TEST(CompareClouds, AShiftOfOneScanShowsInTheRmsAndInTheDistances) {
  Set set(3);
  set.estimates[2] = *set.estimates[2] * Translation3d(0, 0, 100);  // far from everything
  const CloudComparison c = set.compare();
  EXPECT_NEAR(c.rms_m, 100 / std::sqrt(3.0), 1e-6);
  EXPECT_GT(c.registered_to_truth.max_m, 80);  // a scan's points are up to 17 m apart
  EXPECT_LT(c.registered_to_truth.max_m, 100.1);
  EXPECT_GT(c.registered_to_truth.mean_m, 25);
  EXPECT_LT(c.registered_to_truth.mean_m, 34);  // a third of the points is off
  EXPECT_GT(c.truth_to_registered.max_m, 10);   // nobody stands where that scan belongs
}

TEST(CompareClouds, AMissingScanShowsFromTheTruthToTheRegisteredCloudAlone) {
  Set set(3);
  set.estimates[2] = std::nullopt;
  const CloudComparison c = set.compare();
  EXPECT_EQ(c.num_points, 600u);
  EXPECT_LT(c.rms_m, 1e-9);
  EXPECT_LT(c.registered_to_truth.max_m, 1e-9);
  EXPECT_GT(c.truth_to_registered.max_m, 5);
  EXPECT_EQ(c.hausdorff_m(), c.truth_to_registered.max_m);
}

TEST(CompareClouds, AScanOfAnotherGroupBelongsToNeitherCloud) {
  Set set(3);
  set.truth.scans[2].group = 1;
  set.estimates[2] = Isometry3d::Identity();
  const CloudComparison c = set.compare();
  EXPECT_EQ(c.registered_to_truth.num_points, 600u);
  EXPECT_LT(c.hausdorff_m(), 1e-9);
}

TEST(CompareClouds, TakesTheRmsOverAsManyPointsAsAskedFor) {
  Set set(2);
  set.estimates[1] = *set.estimates[1] * Translation3d(3, 0, 0);
  const CloudComparison c = set.compare(100);
  EXPECT_EQ(c.num_points, 100u);
  EXPECT_NEAR(c.rms_m, 3 / std::sqrt(2.0), 0.4);  // which of the scans a drawn point is of is chance
  EXPECT_GT(c.rms_m, 1);
}

TEST(CompareClouds, RefusesAReferenceWithoutAPoseAndListsThatDiffer) {
  Set set(2);
  EXPECT_THROW(set.compare(10, 2), InvalidInput);
  set.estimates[0] = std::nullopt;
  EXPECT_THROW(set.compare(), InvalidInput);
  set.points.pop_back();
  EXPECT_THROW(set.compare(10, 1), InvalidInput);
}

TEST(ShareOut, GivesEachScanItsShareAndNoMoreThanThereAre) {
  EXPECT_EQ(share_out(100, {10, 20, 30}), (std::vector<std::size_t>{10, 20, 30}));
  EXPECT_EQ(share_out(6, {100, 200, 300}), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(share_out(4, {100, 100, 100}), (std::vector<std::size_t>{2, 1, 1}));
  EXPECT_EQ(share_out(5, {}), (std::vector<std::size_t>{}));
}

}  // namespace
}  // namespace tcm_icp
