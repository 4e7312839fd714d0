#include "pcl_search.hpp"

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <random>

namespace tcm_icp {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Flann = pcl::search::KdTree<pcl::PointXYZ>;

Cloud::Ptr random_cloud(std::size_t size, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> coordinate(-5, 5);
  auto cloud = pcl::make_shared<Cloud>();
  for (std::size_t i = 0; i < size; ++i) cloud->emplace_back(coordinate(rng), coordinate(rng), coordinate(rng));
  return cloud;
}

// As PCL asks: through the base class.
void expect_same(const Flann& flann, const Flann& ours, const pcl::PointXYZ& query) {
  pcl::Indices expected(1), indices(1);
  std::vector<float> expected_d2(1), d2(1);
  for (const int k : {1, 7}) {
    EXPECT_EQ(flann.nearestKSearch(query, k, expected, expected_d2), ours.nearestKSearch(query, k, indices, d2));
    EXPECT_EQ(expected, indices);
    ASSERT_EQ(expected_d2.size(), d2.size());
    for (std::size_t i = 0; i < d2.size(); ++i) EXPECT_NEAR(expected_d2[i], d2[i], 1e-5F * (1 + d2[i]));
  }
  for (const double radius : {0.05, 0.8}) {
    EXPECT_EQ(flann.radiusSearch(query, radius, expected, expected_d2), ours.radiusSearch(query, radius, indices, d2));
    EXPECT_EQ(expected, indices);
  }
}

TEST(PclSearch, AnswersAsPclsOwnTree) {
  const Cloud::Ptr cloud = random_cloud(3000, 1), queries = random_cloud(200, 2);
  Flann flann;
  flann.setInputCloud(cloud);
  const PclSearch<pcl::PointXYZ> ours(index_of(*cloud));
  for (const auto& query : *queries) expect_same(flann, ours, query);
}

TEST(PclSearch, WhatIsBeyondReachIsInfinitelyFar) {
  const Cloud::Ptr cloud = random_cloud(50, 3);
  const PclSearch<pcl::PointXYZ> near(index_of(*cloud), 0.5);
  pcl::Indices indices(1);
  std::vector<float> d2(1);
  const pcl::PointXYZ there(20, 0, 0);
  EXPECT_EQ(near.nearestKSearch(there, 1, indices, d2), 0);
  ASSERT_EQ(d2.size(), 1U);
  EXPECT_TRUE(std::isinf(d2[0]));
  EXPECT_EQ(near.nearestKSearch(cloud->points[17], 1, indices, d2), 1);
  EXPECT_EQ(indices[0], 17);
  EXPECT_EQ(d2[0], 0);
}

TEST(PclSearch, GivesNoMoreThanItIsAskedFor) {
  const Cloud::Ptr cloud = random_cloud(500, 4);
  const PclSearch<pcl::PointXYZ> ours(index_of(*cloud));
  pcl::Indices indices;
  std::vector<float> d2;
  EXPECT_EQ(ours.radiusSearch(cloud->points[3], 100, indices, d2, 9), 9);
  EXPECT_EQ(indices.size(), 9U);
  EXPECT_EQ(indices[0], 3);
}

}  // namespace
}  // namespace tcm_icp
