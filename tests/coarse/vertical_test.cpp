#include "tcm_icp/coarse/vertical.hpp"

#include <limits>

#include "support/matchers.hpp"
#include "support/random_points.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::testing {
namespace {

constexpr double kTolerance_deg = 5;  // of an axis that levels a height map; the refinement takes 5 degrees

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / EIGEN_PI;
}

double best_angle_deg(const std::vector<Eigen::Vector3d>& directions, const Eigen::Vector3d& up) {
  double best = 180;
  for (const auto& d : directions) best = std::min(best, angle_deg(d, up));
  return best;
}

// A wavy ground with posts on it, in its own frame with z up; no normals.
Points ground_with_posts(Rng& rng, double noise_m) {
  Points points;
  for (int i = 0; i < 6000; ++i) {
    const double x = 40 * uniform01(rng), y = 30 * uniform01(rng);
    points.emplace_back(x, y, 0.3 * std::sin(x / 5) + noise_m * standard_normal(rng));
  }
  for (int post = 0; post < 60; ++post) {
    const double x = 40 * uniform01(rng), y = 30 * uniform01(rng), top = 2 + 4 * uniform01(rng);
    for (int i = 0; i < 40; ++i) {
      points.emplace_back(x + 0.4 * uniform01(rng), y + 0.4 * uniform01(rng), top * uniform01(rng));
    }
  }
  return points;
}

TEST(Vertical, IsFoundWithItsSignWhateverTheFrame) {
  Rng rng = make_stream(1, "test");
  for (const double noise_m : {0.0, 0.05}) {
    const Points level = ground_with_posts(rng, noise_m);
    for (int trial = 0; trial < 10; ++trial) {
      const Eigen::Isometry3d T = random_pose(100, rng);
      const auto directions = find_up_directions(transformed({level, {}}, T));
      ASSERT_FALSE(directions.empty());
      EXPECT_LT(angle_deg(directions.front(), T.linear() * Eigen::Vector3d::UnitZ()), kTolerance_deg);
    }
  }
}

// An axis of normals has no sign of its own. Hills have many axes that are nearly as good as one another.
TEST(Vertical, IsTheSameWhateverTheNormalsSigns) {
  Rng rng = make_stream(9, "test");
  for (int trial = 0; trial < 20; ++trial) {
    Cloud hills;
    for (int i = 0; i < 1500; ++i) {
      const double x = 40 * uniform01(rng), y = 40 * uniform01(rng);
      hills.points.emplace_back(x, y, 2 * std::sin(x / 4) * std::cos(y / 5));
      const double dx = std::cos(x / 4) * std::cos(y / 5) / 2, dy = -std::sin(x / 4) * std::sin(y / 5) / 2.5;
      hills.normals.push_back(Eigen::Vector3d(-dx, -dy, 1).normalized());
    }
    hills = transformed(hills, random_pose(100, rng));
    const auto directions = find_up_directions(hills);
    for (auto& n : hills.normals) {
      if (uniform01(rng) < 0.5) n = -n;
    }
    EXPECT_EQ(find_up_directions(hills), directions) << trial;
  }
}

// A wall is the larger surface, and a scan from below a ceiling would be taken for one upside down.
TEST(Vertical, OfALevelledScanIsZAsFloorsHaveIt) {
  Rng rng = make_stream(8, "test");
  Cloud floor{random_points(2000, 10, rng), {}};
  for (auto& p : floor.points) p.z() = 0.01 * standard_normal(rng);
  floor.normals.assign(floor.size(), Eigen::Vector3d::UnitZ());
  VerticalOptions options;
  options.levelled = true;
  const Eigen::AngleAxisd tilt(4 * EIGEN_PI / 180, Eigen::Vector3d::UnitX());
  const Cloud tilted = transformed(floor, Eigen::Isometry3d(tilt));
  const auto directions = find_up_directions(tilted, options);
  ASSERT_EQ(directions.size(), 1u);
  EXPECT_LT(angle_deg(directions[0], tilt * Eigen::Vector3d::UnitZ()), 0.01);
  const auto none = find_up_directions({floor.points, {}}, options);
  EXPECT_EQ(none, std::vector<Eigen::Vector3d>{Eigen::Vector3d::UnitZ()}) << "no normals, no floors";
  const Cloud wall = transformed(floor, Eigen::Isometry3d(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitX())));
  EXPECT_EQ(find_up_directions(wall, options), std::vector<Eigen::Vector3d>{Eigen::Vector3d::UnitZ()});
}

TEST(Vertical, TurnsWithTheCloud) {
  Rng rng = make_stream(2, "test");
  const Cloud level{ground_with_posts(rng, 0.02), {}};
  const Eigen::Isometry3d T = random_pose(100, rng);
  const auto before = find_up_directions(level), after = find_up_directions(transformed(level, T));
  ASSERT_EQ(before.size(), after.size());
  // Grids fall differently on a turned cloud; the axis hardly moves.
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT(angle_deg(T.linear() * before[i], after[i]), 0.5);
}

TEST(Vertical, OfAYardIsAmongTheDirections) {
  Rng rng = make_stream(3, "test");
  SyntheticSceneOptions options;
  options.num_scans = 4;
  options.points_per_scan = 8000;
  options.noise_m = 0.02;
  const SyntheticScene scene = synthetic_scene(options, rng);
  for (std::size_t i = 0; i < scene.scans.size(); ++i) {
    const Eigen::Vector3d up = scene.T_world_scan[i].linear().transpose() * Eigen::Vector3d::UnitZ();
    EXPECT_LT(best_angle_deg(find_up_directions(scene.scans[i]), up), kTolerance_deg);
  }
}

TEST(Vertical, HasBothSignsWhereFloorAndCeilingLookAlike) {
  Rng rng = make_stream(4, "test");
  SyntheticSceneOptions options;
  options.shape = SyntheticShape::kParallelPlanes;
  options.points_per_scan = 40000;  // both planes in nearly every cell
  options.noise_m = 0.02;
  const SyntheticScene scene = synthetic_scene(options, rng);
  const auto directions = find_up_directions(scene.scans[0]);
  ASSERT_GE(directions.size(), 2U);
  EXPECT_TRUE(is_near(directions[0], -directions[1], 1e-12));
}

TEST(Vertical, OfDegenerateCloudsIsAnErrorOrUnitVectors) {
  EXPECT_THROW(find_up_directions({}), InvalidInput);
  EXPECT_THROW(find_up_directions({Points(2, Eigen::Vector3d::Zero()), {}}), InvalidInput);
  EXPECT_THROW(find_up_directions({Points(50, Eigen::Vector3d::Ones()), {}}), InvalidInput);
  Points line;
  for (int i = 0; i < 50; ++i) line.emplace_back(0.1 * i, 0.2 * i, 0);
  for (const auto& direction : find_up_directions({line, {}})) EXPECT_NEAR(direction.norm(), 1, 1e-9);
}

TEST(Vertical, RejectsOptionsOutOfBounds) {
  VerticalOptions options;
  options.max_axes = 0;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.min_area_ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(options.validate(), InvalidOptions);
  options = {};
  options.max_roughness_ratio = 1.5;
  EXPECT_THROW(options.validate(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp::testing
