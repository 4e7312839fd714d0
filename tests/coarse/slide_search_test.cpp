#include "tcm_icp/coarse/slide_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kVoxel_m = 0.1;

SlideMarks marks(Cloud surfaces, NormalSides sides = NormalSides::kUnknown) { return {std::move(surfaces), {}, sides}; }

// Points 0.1 m apart over a rectangle.
void add_patch(const Vector3d& corner, const Vector3d& u, double length_u, const Vector3d& v, double length_v,
               Cloud& cloud) {
  for (double a = kVoxel_m / 2; a < length_u; a += kVoxel_m) {
    for (double b = kVoxel_m / 2; b < length_v; b += kVoxel_m) {
      cloud.points.push_back(corner + a * u + b * v);
      cloud.normals.push_back(u.cross(v));
    }
  }
}

// 2 m wide, 3 m high, along x; piers stand out from the walls at `piers_m`, 0.4 m deep. Each pier shows the face that
// looks along -x, and with `both_faces` the one 0.3 m behind it, whose normal points the other way.
Cloud corridor(double begin_m, double end_m, const std::vector<double>& piers_m, bool both_faces = false) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  Cloud cloud;
  add_patch({begin_m, -1, 0}, x, end_m - begin_m, y, 2, cloud);
  add_patch({begin_m, -1, 0}, z, 3, x, end_m - begin_m, cloud);
  add_patch({begin_m, 1, 0}, x, end_m - begin_m, z, 3, cloud);
  for (const double at_m : piers_m) {
    if (at_m < begin_m || at_m > end_m) continue;
    add_patch({at_m, 0.6, 0}, z, 3, y, 0.4, cloud);
    if (both_faces) add_patch({at_m + 0.3, 0.6, 0}, y, 0.4, z, 3, cloud);
  }
  return cloud;
}

const std::vector<double> kPiers{1.0, 4.1, 5.3, 9.2, 12.6, 13.4, 17.9, 21.0};

// How far a candidate is from the truth [m].
double error_m(const PoseCandidate& candidate, const Isometry3d& truth, const Cloud& source) {
  return testing::pose_rmse_m(truth, candidate.T_target_source, source.points);
}

TEST(SlideSearch, FindsHowFarApartTwoScansOfACorridorLie) {
  Rng rng = make_stream(1, "slide_search_test");
  const Isometry3d frame = testing::random_pose(30, rng);
  const Cloud target = corridor(0, 14, kPiers), source = transformed(corridor(6, 20, kPiers), frame.inverse());
  // Laid over one another as well as walls and floor can be.
  const Isometry3d start = Eigen::Translation3d(-6, 0, 0) * frame;
  ASSERT_GT(testing::pose_rmse_m(frame, start, source.points), 5);
  const auto found = slide_candidates(marks(target), marks(source), start, kVoxel_m, 8);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(error_m(found.front(), frame, source), kVoxel_m);
  for (std::size_t k = 1; k < found.size(); ++k) EXPECT_LE(found[k].score, found[k - 1].score);
  for (const auto& candidate : found) {
    EXPECT_EQ(candidate.method, CoarseMethod::kSlide);
    EXPECT_GT(error_m(candidate, start, source), 2 * kVoxel_m) << "the given pose is known";
    EXPECT_TRUE((candidate.T_target_source.linear() - start.linear()).isZero(1e-12)) << "a slide turns nothing";
  }
}

TEST(SlideSearch, IsTheSameInAnotherUnitAndFrame) {
  Rng rng = make_stream(2, "slide_search_test");
  const Isometry3d turn = testing::random_pose(30, rng);
  const Cloud target = corridor(0, 14, kPiers), source = corridor(6, 20, kPiers);
  const Isometry3d start(Eigen::Translation3d(-6, 0, 0));
  const auto plain = slide_candidates(marks(target), marks(source), start, kVoxel_m, 1);
  const auto scaled =
      slide_candidates(marks(testing::scaled_cloud(target, 1000)), marks(testing::scaled_cloud(source, 1000)),
                       testing::scaled_pose(start, 1000), 1000 * kVoxel_m, 1);
  const auto turned = slide_candidates(marks(transformed(target, turn)), marks(source), turn * start, kVoxel_m, 1);
  ASSERT_EQ(plain.size(), 1u);
  ASSERT_EQ(scaled.size(), 1u);
  ASSERT_EQ(turned.size(), 1u);
  EXPECT_LT(error_m(scaled[0], testing::scaled_pose(plain[0].T_target_source, 1000), source), 1e-6);
  EXPECT_LT(error_m(turned[0], turn * plain[0].T_target_source, source), kVoxel_m);
}

// One scan stood before the piers, the other behind them: each saw one face, 0.3 m apart.
TEST(SlideSearch, TheFacesOfAWallAreNotMistakenForOneAnotherWhereTheirSidesAreKnown) {
  const Cloud both = corridor(0, 22, kPiers, true);
  Cloud before, behind;
  for (std::size_t i = 0; i < both.size(); ++i) {
    for (auto& [cloud, hidden] : {std::pair(&before, 1.0), std::pair(&behind, -1.0)}) {
      if (both.normals[i].x() * hidden > 0.5) continue;
      cloud->points.push_back(both.points[i]);
      cloud->normals.push_back(both.normals[i]);
    }
  }
  const Isometry3d start(Eigen::Translation3d(0, 0, 0));
  const auto mistaken = slide_candidates(marks(before), marks(behind), start, kVoxel_m, 1);
  ASSERT_FALSE(mistaken.empty()) << "the faces of all piers agree 0.3 m off";
  EXPECT_NEAR(std::abs(mistaken[0].T_target_source.translation().x()), 0.3, kVoxel_m);
  EXPECT_TRUE(slide_candidates(marks(before, NormalSides::kSeen), marks(behind, NormalSides::kSeen), start, kVoxel_m, 1)
                  .empty());
}

// Openings in the wall at y = 1, each as wide as the others: no surface lies across the corridor.
Cloud borders_of_doors(double begin_m, double end_m, const std::vector<double>& doors_m) {
  Cloud out;
  for (const double at_m : doors_m) {
    for (const auto& [x, outwards] : {std::pair(at_m, 1.0), std::pair(at_m + 1, -1.0)}) {
      if (x < begin_m || x > end_m) continue;
      for (double z = 0.05; z < 2; z += kVoxel_m) {
        out.points.emplace_back(x, 1, z);
        out.normals.emplace_back(outwards, 0, 0);
      }
    }
  }
  return out;
}

TEST(SlideSearch, BordersOfDoorsTellWhereNoSurfaceDoes) {
  SlideMarks target = marks(corridor(0, 14, {})), source = marks(corridor(6, 20, {}));
  const Isometry3d start(Eigen::Translation3d(-6, 0, 0));
  ASSERT_TRUE(slide_candidates(target, source, start, kVoxel_m, 8).empty());
  const std::vector<double> doors{1, 4.1, 8.2, 10.6, 12.9, 17};
  target.borders = borders_of_doors(0, 14, doors);
  source.borders = borders_of_doors(6, 20, doors);
  const auto found = slide_candidates(target, source, start, kVoxel_m, 8);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(error_m(found.front(), Isometry3d::Identity(), source.surfaces), kVoxel_m);
}

// A door that stands open turned the direction by a degree and more: over six metres two voxels too far to one side.
TEST(SlideSearch, OpenDoorsDoNotLeadOffTheCorridor) {
  Cloud target = corridor(0, 14, kPiers), source = corridor(6, 20, kPiers);
  const Vector3d along = Vector3d(2, 1, 0).normalized();
  for (const double at_m : {8.0, 11.0}) {
    add_patch({at_m, -0.9, 0}, along, 1, Vector3d::UnitZ(), 3, target);
    add_patch({at_m, -0.9, 0}, along, 1, Vector3d::UnitZ(), 3, source);
  }
  const auto found =
      slide_candidates(marks(target), marks(source), Isometry3d(Eigen::Translation3d(-6, 0, 0)), kVoxel_m, 1);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(std::abs(found[0].T_target_source.translation().y()), 0.01);
  EXPECT_LT(error_m(found[0], Isometry3d::Identity(), source), kVoxel_m);
}

TEST(SlideSearch, FindsNothingWhereNothingTells) {
  const Isometry3d start(Eigen::Translation3d(-6, 0, 0));
  EXPECT_TRUE(slide_candidates(marks(corridor(0, 14, {})), marks(corridor(6, 20, {})), start, kVoxel_m, 8).empty());
  EXPECT_TRUE(slide_candidates({}, {}, start, kVoxel_m, 8).empty());
  EXPECT_TRUE(slide_candidates(marks(corridor(0, 9, kPiers)), {}, start, kVoxel_m, 8).empty());
  Cloud no_normals = corridor(0, 14, kPiers);
  for (auto& n : no_normals.normals) n.setZero();
  EXPECT_TRUE(slide_candidates(marks(no_normals), marks(no_normals), start, kVoxel_m, 8).empty());
}

TEST(SlideSearch, APointLightYearsAwayIsNoTrouble) {
  Cloud target = corridor(0, 14, kPiers);
  const Cloud source = corridor(6, 20, kPiers);
  target.points.emplace_back(1e19, 0.7, 1);
  target.normals.push_back(Vector3d::UnitX());
  const Isometry3d start(Eigen::Translation3d(-6, 0, 0));
  const auto found = slide_candidates(marks(target), marks(source), start, kVoxel_m, 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(error_m(found[0], Isometry3d::Identity(), source), kVoxel_m);
}

}  // namespace
}  // namespace tcm_icp
