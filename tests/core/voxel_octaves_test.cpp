#include "tcm_icp/core/voxel_octaves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

using Keys = std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>>;

Keys::value_type as_tuple(const VoxelKey& key) { return {key.x, key.y, key.z}; }

Points yard(std::uint64_t seed) {
  Rng rng = make_stream(seed, "voxel_octaves_test");
  return testing::synthetic_scene({.num_scans = 1, .points_per_scan = 6000}, rng).scans[0].points;
}

VoxelOctaves octaves_of(const Points& points, double finest_m = 0.01) { return {points, Vector3d::Zero(), finest_m}; }

TEST(VoxelOctaves, CountsAreThoseOfAHashAtEachEdge) {
  Rng rng = make_stream(1, "voxel_octaves_test");
  for (const Points& points : {yard(1), yard(2), testing::random_points(3000, 5, rng), Points{{0, 0, 0}, {-1, 2, 3}}}) {
    for (const Vector3d& moved : {Vector3d(0, 0, 0), Vector3d(1e6, -777, 3e-3)}) {
      Points there = points;
      for (auto& p : there) p += moved;
      const std::vector<std::size_t> counts = VoxelOctaves(there, moved, 0.01).counts();
      ASSERT_EQ(counts.size(), 20u);
      EXPECT_EQ(counts[0], count_voxels(there, 0.01));
      for (int k = 1; k < 20; ++k) EXPECT_EQ(counts[k], count_voxels(there, std::ldexp(0.01, k))) << k;
    }
  }
}

TEST(VoxelOctaves, KeysAreThoseOfThePoints) {
  const Points points = yard(3);
  const Vector3d middle(3, -2, 1);
  const VoxelOctaves voxels(points, middle, 0.05);
  EXPECT_TRUE(std::is_sorted(voxels.finest().begin(), voxels.finest().end()));
  for (const int octave : {0, 3, 7}) {
    Keys of_codes, of_points;
    for (const VoxelCode code : voxels.finest()) of_codes.insert(as_tuple(voxels.key(code >> 3 * octave, octave)));
    for (const auto& p : points) of_points.insert(as_tuple(voxel_key(p, std::ldexp(0.05, octave))));
    EXPECT_EQ(of_codes, of_points) << octave;
  }
}

TEST(VoxelOctaves, AreTheSameInAnyOrder) {
  Rng rng = make_stream(2, "voxel_octaves_test");
  const Points points = yard(4);
  EXPECT_EQ(octaves_of(testing::shuffled(points, rng)).finest(), octaves_of(points).finest());
}

TEST(VoxelOctaves, WhatLiesTooFarAwayLiesAtTheBorder) {
  Points points = yard(5);
  const std::size_t before = octaves_of(points).counts()[4];
  points.emplace_back(1e300, 0, 0);
  points.emplace_back(0, -1e15, 0);
  EXPECT_EQ(octaves_of(points).counts()[4], before + 2);
}

TEST(VoxelOctaves, OfNothingThereAreNone) {
  EXPECT_TRUE(octaves_of({}).finest().empty());
  EXPECT_EQ(octaves_of({}).counts(), std::vector<std::size_t>(20, 0));
  EXPECT_EQ(octaves_of(Points(5, Vector3d(1, 2, 3))).counts(), std::vector<std::size_t>(20, 1));
}

// Of the 27 around each voxel those that are occupied, by codes and by a set of keys.
TEST(VoxelOctaves, TouchingVoxelsAreThoseOfTheNextKeys) {
  const Points points = yard(6);
  Keys keys;
  for (const auto& p : points) keys.insert(as_tuple(voxel_key(p, 0.2)));
  const VoxelOctaves voxels = octaves_of(points, 0.2);
  std::size_t by_codes = 0, by_keys = 0;
  for (const VoxelCode code : voxels.finest()) {
    for (int n = 0; n < kTouchingVoxels; ++n) {
      by_codes += std::binary_search(voxels.finest().begin(), voxels.finest().end(), touching_voxel(code, n));
    }
    EXPECT_EQ(touching_voxel(code, 13), code);
    EXPECT_EQ(touching_voxel(touching_voxel(code, 0), 26), code) << "and back";
  }
  for (const auto& [x, y, z] : keys) {
    for (int n = 0; n < kTouchingVoxels; ++n) by_keys += keys.count({x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1});
  }
  EXPECT_GT(by_keys, 2 * keys.size());
  EXPECT_EQ(by_codes, by_keys);
}

}  // namespace
}  // namespace tcm_icp
