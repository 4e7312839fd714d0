#include "inference/motion_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

TEST(MotionCells, EachMotionIsInOneAndThoseNearItAreAround) {
  Rng rng = make_stream(1, "motion_cells_test");
  Eigen::Matrix3Xd at(3, 300);
  for (double& c : at.reshaped()) c = 8 * (uniform01(rng) - 0.5);
  const MotionCells cells(at);
  std::vector<std::size_t> cell_of(300, cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    EXPECT_TRUE(std::is_sorted(cells.motions(c).begin(), cells.motions(c).end()));
    for (const std::size_t k : cells.motions(c)) {
      EXPECT_EQ(cell_of[k], cells.size()) << "in two";
      cell_of[k] = c;
    }
  }
  std::size_t num_near = 0;
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    const auto around = cells.around(cell_of[static_cast<std::size_t>(i)]);
    EXPECT_LE(around.size(), 27u);
    for (Eigen::Index j = 0; j < at.cols(); ++j) {
      if ((at.col(i) - at.col(j)).cwiseAbs().maxCoeff() > 1) continue;
      ++num_near;
      EXPECT_TRUE(std::count(around.begin(), around.end(), cell_of[static_cast<std::size_t>(j)]) == 1);
    }
  }
  EXPECT_GT(num_near, 600u) << "more than each with itself";
}

TEST(MotionCells, OnAnEdgeBelongToOneSide) {
  const MotionCells cells(Eigen::Matrix3Xd::Ones(3, 2));
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells.motions(0).size(), 2u);
  EXPECT_EQ(MotionCells(Eigen::Matrix3Xd(3, 0)).size(), 0u);
}

}  // namespace
}  // namespace tcm_icp
