#include "core/paged_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

#include "core/memory_budget.hpp"
#include "support/random_points.hpp"
#include "tcm_icp/core/memory_limit.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMegabyte = 1 << 20;

class PagedMemory : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(open_paged_memory(std::filesystem::temp_directory_path())); }

  static Points numbered(std::size_t count) {
    Points points(count);
    for (std::size_t i = 0; i < count; ++i) points[i] = Eigen::Vector3d::Constant(static_cast<double>(i));
    return points;
  }
};

TEST_F(PagedMemory, TakesLargeArraysThatAreMadeInAScope) {
  const std::size_t before = paged_bytes();
  const Points outside = numbered(10'000), few = numbered(10);
  EXPECT_EQ(paged_bytes(), before);
  {
    const PagedScope scope;
    const Points inside = outside, small = few;
    EXPECT_GE(paged_bytes(), before + 240'000);
    EXPECT_LT(paged_bytes(), before + 250'000) << "small arrays stay on the heap";
    EXPECT_EQ(inside, outside);
  }
  EXPECT_EQ(paged_bytes(), before) << "all of it was given back";
}

TEST_F(PagedMemory, KeepsWhatIsInItWhenItsPagesLeave) {
  Points paged;
  {
    const Points source = numbered(1'000'000);
    const PagedScope scope;
    paged = source;
  }
  const std::size_t with = resident_memory();
  release_paged_memory();
  EXPECT_LT(resident_memory() + 20 * kMegabyte, with) << "24 MB were to leave";
  EXPECT_EQ(paged, numbered(1'000'000));
  paged[5] = Eigen::Vector3d::Zero();  // what is changed stays changed
  release_paged_memory();
  EXPECT_EQ(paged[5], Eigen::Vector3d::Zero());
  EXPECT_EQ(paged[6], Eigen::Vector3d::Constant(6));
}

TEST_F(PagedMemory, ArraysMoveOutOfTheScopeAndToOtherThreads) {
  const std::size_t before = paged_bytes();
  Points kept;
  std::thread([&] {
    const PagedScope scope;
    Points made = numbered(5000);
    kept = std::move(made);
  }).join();
  EXPECT_GT(paged_bytes(), before);
  EXPECT_EQ(kept, numbered(5000));
  const Points copy = kept;  // no scope here
  const std::size_t with_one = paged_bytes();
  kept = Points();
  EXPECT_LT(paged_bytes(), with_one);
  EXPECT_EQ(paged_bytes(), before);
  EXPECT_EQ(copy, numbered(5000));
}

TEST_F(PagedMemory, GivesTheSameRoomAgain) {
  const PagedScope scope;
  const void* before = nullptr;
  {
    const Points first(33'333);
    before = first.data();
  }
  const Points second(33'000);  // not quite as many
  EXPECT_EQ(static_cast<const void*>(second.data()), before);
  const Points third(33'333, Eigen::Vector3d::Ones());
  EXPECT_NE(static_cast<const void*>(third.data()), before) << "which is taken";
  EXPECT_EQ(second.size() + third.size(), 66'333u);
}

TEST_F(PagedMemory, CanLeaveBesideThreadsThatReadIt) {
  Rng rng = make_stream(3, "paged");
  const Points points = testing::random_points(20'000, 10, rng), queries = testing::random_points(2000, 10, rng);
  const NeighborIndex index(points);
  const auto in_pages = [&] {
    const PagedScope scope;
    return NeighborIndex(index);
  }();
  std::atomic<bool> done{false};
  std::thread releases([&] {
    while (!done) release_paged_memory();
  });
  for (const auto& q : queries) {
    const Neighbor expected = index.nearest(q), found = in_pages.nearest(q);
    EXPECT_EQ(found.index, expected.index);
    EXPECT_EQ(found.squared_distance_m2, expected.squared_distance_m2);
  }
  done = true;
  releases.join();
}

TEST(PagedMemoryFile, IsRefusedWhereThereIsNoFolder) {
  // One a process: where a test before has opened it, that one holds.
  if (open_paged_memory("/nowhere/at/all")) GTEST_SKIP() << "opened before";
  const PagedScope scope;
  const std::size_t before = paged_bytes();
  const Points on_the_heap(10'000, Eigen::Vector3d::Ones());
  EXPECT_EQ(paged_bytes(), before);
}

TEST(MemoryBudget, PutsAwayNothingWithoutALimitOrFarBelowIt) {
  RunContext context;
  {
    const MemoryBudget none(context);
    EXPECT_FALSE(memory_is_short());
  }
  context.memory_limit = std::size_t{1} << 50;
  const MemoryBudget ample(context);
  EXPECT_FALSE(memory_is_short());
  const std::size_t before = paged_bytes();
  const Points points = in_budget(Points(10'000, Eigen::Vector3d::Ones()));
  EXPECT_EQ(paged_bytes(), before);
  EXPECT_EQ(ample.shortfall(), "");
}

TEST(MemoryBudget, KeepsTheProcessBelowItsLimit) {
  constexpr std::size_t kPoints = 100'000, kScans = 100;  // 240 MB
  RunContext context;
  context.memory_limit = resident_memory() + 100 * kMegabyte;
  const MemoryBudget budget(context);
  std::vector<Points> scans;
  std::size_t most = 0;
  for (std::size_t i = 0; i < kScans; ++i) {
    scans.push_back(in_budget(Points(kPoints, Eigen::Vector3d::Constant(static_cast<double>(i)))));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // what a scan would take
    most = std::max(most, resident_memory());
  }
#ifndef __SANITIZE_ADDRESS__  // which keeps what is freed in memory for a while
  EXPECT_LT(most, context.memory_limit + 30 * kMegabyte) << "all together would be 140 MB above it";
#else
  EXPECT_GT(most, 0u);
#endif
  for (std::size_t i = 0; i < kScans; ++i) {
    EXPECT_EQ(scans[i], Points(kPoints, Eigen::Vector3d::Constant(static_cast<double>(i))));
  }
  EXPECT_EQ(budget.shortfall(), "");
}

TEST(MemoryLimit, IsHalfOfWhatThereIsAtMostAndGrowsByFewMegabytesAScan) {
  EXPECT_GT(available_memory(), 0u);
  for (const std::size_t num_scans : {2U, 25U, 26U, 60U, 1'000U, 100'000U}) {
    EXPECT_LE(default_memory_limit(num_scans), available_memory() / 2);
  }
  EXPECT_LE(default_memory_limit(25), std::size_t{2} << 30);
  EXPECT_LE(default_memory_limit(60), 376 * kMegabyte);
  EXPECT_LE(default_memory_limit(1'000), 2'256 * kMegabyte);
  EXPECT_GT(resident_memory(), 0u);
  EXPECT_LT(resident_memory(), available_memory());
}

}  // namespace
}  // namespace tcm_icp
