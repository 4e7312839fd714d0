#include "pipeline/linked_pairs.hpp"

#include <gtest/gtest.h>

#include "pipeline/prepared_scene.hpp"
#include "pipeline/synthetic_links.hpp"

namespace tcm_icp {
namespace {

class LinkedPairsTest : public ::testing::Test {
 protected:
  LinkedPairsTest() {
    for (std::size_t i = 0; i < s_.scans.size(); ++i) T_.push_back(s_.scene.T_target_source(0, i));
  }
  void link(std::size_t a, std::size_t b, double shift_m) {
    graph_.add({a, b, {testing::link_hypothesis(s_.scene, a, b, 5, 0.01, shift_m, rng_)}});
  }
  ScanPairs kept() const { return without_unlinked(s_.scans, graph_, T_, {{0, 1}, {2, 1}, {0, 2}}); }
  double voxel_m() const { return s_.resolutions.coarse_m; }

  Rng rng_ = make_stream(1, "linked_pairs_test");
  testing::PreparedScene s_ = testing::prepared_scene(
      {.shape = testing::SyntheticShape::kYard, .num_scans = 3, .points_per_scan = 3000, .noise_m = 0.02}, rng_);
  std::vector<Eigen::Isometry3d> T_;
  PoseGraph graph_{3};
};

TEST_F(LinkedPairsTest, APairWhoseHypothesesLeadElsewhereIsLeftOut) {
  link(0, 1, voxel_m());
  link(1, 2, voxel_m());
  link(0, 2, 12 * voxel_m());
  EXPECT_EQ(kept(), (ScanPairs{{0, 1}, {2, 1}}));
}

TEST_F(LinkedPairsTest, NotWhereItAloneConnectsItsScans) {
  link(0, 1, voxel_m());
  link(1, 2, 12 * voxel_m());
  link(0, 2, 12 * voxel_m());
  EXPECT_EQ(kept(), (ScanPairs{{0, 1}, {2, 1}, {0, 2}}));
}

TEST_F(LinkedPairsTest, PairsThatWereNotComparedStay) {
  link(0, 1, voxel_m());
  link(1, 2, voxel_m());
  EXPECT_EQ(kept().size(), 3u);
  EXPECT_EQ(without_unlinked(s_.scans, PoseGraph(3), T_, {{0, 1}, {1, 2}, {0, 2}}).size(), 3u) << "guesses only";
}

TEST_F(LinkedPairsTest, TheRightOneOfSeveralHypothesesIsEnough) {
  link(0, 1, voxel_m());
  link(1, 2, voxel_m());
  link(0, 2, 12 * voxel_m());
  link(0, 2, voxel_m());
  EXPECT_EQ(kept().size(), 3u);
}

}  // namespace
}  // namespace tcm_icp
