#include "tcm_icp/registration/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "support/matchers.hpp"
#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// A bowl over poses: mean squared distance of six points, `radius_m` from the frame's centre, from where the goal puts
// them.
class Bowl {
 public:
  Bowl() {
    Rng rng = make_stream(1, "refinement_test");
    goal = testing::random_pose(20, rng);
    frame.centre = goal * Vector3d(1, 2, 3);
    frame.radius_m = 4;
    for (int k = 0; k < 3; ++k) {
      for (const double sign : {-1.0, 1.0})
        points.push_back(Vector3d(1, 2, 3) + sign * frame.radius_m * Vector3d::Unit(k));
    }
    Twist off;
    off << 0.5, -0.3, 0.7, -0.4, 0.2, 0.6;
    start = frame.moved(goal, off);
  }
  double distance_m(const Isometry3d& T) const { return testing::pose_rmse_m(goal, T, points); }
  PoseCost cost() const {
    return [this](const Isometry3d& T) { return std::pow(distance_m(T), 2); };
  }

  Isometry3d goal, start;
  TwistFrame frame;
  Points points;
};

DescentOptions descent() { return {.initial_step_m = 0.4, .min_step_m = 1e-4, .step_shrink = 0.5, .max_steps = 400}; }

AnnealingOptions annealing() {
  return {.initial_step_m = 0.4,
          .final_step_m = 0.02,
          .initial_temperature = 1,
          .final_temperature = 1e-3,
          .num_steps = 400};
}

TEST(Descend, EndsInTheBowlsMinimumWithinItsLeastStep) {
  const Bowl bowl;
  const auto options = descent();
  // Where no combination improves at step s, the bowl's curvatures (6 and 4 an axis) bound the distance by 15/4 s, and
  // the last s tried is below twice min_step_m.
  const double tolerance = 15.0 / 4 * 2 * options.min_step_m;
  ASSERT_GT(bowl.distance_m(bowl.start), 100 * tolerance);
  const RefinementTrace trace = descend(bowl.cost(), {}, bowl.cost(), bowl.frame, bowl.start, options);
  EXPECT_LT(trace.num_steps, options.max_steps);
  EXPECT_TRUE(trace.kept);
  EXPECT_LE(bowl.distance_m(trace.T_target_source), tolerance);
  EXPECT_EQ(trace.final_cost, bowl.cost()(trace.T_target_source));
}

TEST(Descend, TriesAll64CombinationsOfEachStepAndNoOther) {
  const Bowl bowl;
  std::vector<Isometry3d> tried;
  const PoseCost counting = [&](const Isometry3d& T) {
    tried.push_back(T);
    return bowl.cost()(T);
  };
  auto options = descent();
  options.max_steps = 1;
  descend(counting, {}, bowl.cost(), bowl.frame, bowl.start, options);
  ASSERT_EQ(tried.size(), 1u + 64u);
  std::set<int> combinations;
  for (std::size_t i = 1; i < tried.size(); ++i) {
    // What was applied about the frame's centre: six entries of plus or minus the step.
    const Isometry3d step = tried[i] * bowl.start.inverse();
    const Eigen::AngleAxisd rotation(step.linear());
    Twist entries;
    entries << rotation.angle() * rotation.axis() * bowl.frame.radius_m, step * bowl.frame.centre - bowl.frame.centre;
    int signs = 0;
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(std::abs(entries[k]), options.initial_step_m, 1e-12);
      signs |= (entries[k] > 0 ? 1 : 0) << k;
    }
    combinations.insert(signs);
  }
  EXPECT_EQ(combinations.size(), 64u);
}

TEST(Descend, TheSlopeIsOneMoreCandidateAndTheBestIsTaken) {
  const Bowl bowl;
  int evaluations = 0;
  const PoseCost counting = [&](const Isometry3d& T) {
    ++evaluations;
    return bowl.cost()(T);
  };
  // Off along x only: the slope leads straight there, every combination goes astray in the other five.
  Twist off = Twist::Zero();
  off[3] = 0.4;
  const Isometry3d start = bowl.frame.moved(bowl.goal, off);
  const PoseGradient slope = [&](const Isometry3d& T, Twist& gradient) {
    gradient = Twist::Unit(3);
    return bowl.cost()(T);
  };
  auto options = descent();
  options.max_steps = 1;
  const RefinementTrace trace = descend(counting, slope, bowl.cost(), bowl.frame, start, options);
  EXPECT_EQ(evaluations, 1 + 64 + 1);
  ASSERT_GT(bowl.distance_m(start), 0.3);
  EXPECT_LE(bowl.distance_m(trace.T_target_source), 1e-12);
}

TEST(Descend, NeverRaisesTheCostAndStaysWhereNothingImproves) {
  Rng rng = make_stream(2, "refinement_test");
  const Bowl bowl;
  const PoseCost rough = [&](const Isometry3d& T) {
    return bowl.cost()(T) + 0.3 * std::sin(40 * T.translation().sum()) + 0.3 * std::cos(30 * T(0, 1));
  };
  for (int i = 0; i < 10; ++i) {
    const Isometry3d start = testing::perturbed(bowl.goal, bowl.points, 0.5 * uniform01(rng), uniform01(rng), rng);
    auto options = descent();
    options.max_steps = 12;
    const RefinementTrace trace = descend(rough, {}, rough, bowl.frame, start, options);
    EXPECT_LE(trace.final_cost, trace.initial_cost);
    EXPECT_LE(rough(trace.T_target_source), rough(start));
  }
  const RefinementTrace still = descend(bowl.cost(), {}, bowl.cost(), bowl.frame, bowl.goal, descent());
  EXPECT_EQ(still.num_accepted, 0);
  EXPECT_FALSE(still.kept);
  EXPECT_TRUE(still.T_target_source.isApprox(bowl.goal, 0));
}

TEST(Descend, GivesThePoseBackWhereHeldOutPointsGetWorse) {
  const Bowl bowl;
  const PoseCost contrary = [&](const Isometry3d& T) { return 10 - bowl.cost()(T); };
  const RefinementTrace trace = descend(bowl.cost(), {}, contrary, bowl.frame, bowl.start, descent());
  EXPECT_LT(trace.final_cost, trace.initial_cost);
  EXPECT_GT(trace.final_held_out_cost, trace.initial_held_out_cost);
  EXPECT_FALSE(trace.kept);
  EXPECT_TRUE(trace.T_target_source.isApprox(bowl.start, 0));
}

// Two wells along x, the deeper at -1; the barrier at 0 is higher than either by about 1.
double two_wells(const Isometry3d& T) {
  const double x = T.translation().x();
  return std::pow(x * x - 1, 2) + 0.3 * x + 0.5;
}

TEST(Anneal, LeavesALocalMinimumWhereDescentStays) {
  const Isometry3d start(Eigen::Translation3d(1, 0, 0));
  const RefinementTrace descended = descend(two_wells, {}, two_wells, {}, start, descent());
  ASSERT_GT(descended.T_target_source.translation().x(), 0.5) << "descent was meant to stay in the upper well";
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng = make_stream(seed, "refinement_test annealing");
    const RefinementTrace trace = anneal(two_wells, two_wells, {}, start, annealing(), rng);
    EXPECT_TRUE(trace.kept);
    EXPECT_LT(trace.T_target_source.translation().x(), -0.8) << "seed " << seed;
    EXPECT_LT(trace.final_cost, descended.final_cost);
    EXPECT_EQ(trace.num_steps, annealing().num_steps);
  }
}

TEST(Anneal, KeepsTheBestPoseOnlyIfHeldOutPointsAgree) {
  const Isometry3d start(Eigen::Translation3d(1, 0, 0));
  for (const bool indifferent : {true, false}) {
    const PoseCost held_out = [&](const Isometry3d& T) { return indifferent ? 1 : -two_wells(T); };
    Rng rng = make_stream(4, "refinement_test annealing");
    const RefinementTrace trace = anneal(two_wells, held_out, {}, start, annealing(), rng);
    EXPECT_LT(trace.final_cost, trace.initial_cost);
    EXPECT_FALSE(trace.kept);
    EXPECT_TRUE(trace.T_target_source.isApprox(start, 0));
  }
}

TEST(Anneal, NoStepsGiveThePoseBack) {
  const Bowl bowl;
  auto options = annealing();
  options.num_steps = 0;
  Rng rng = make_stream(5, "refinement_test annealing");
  const RefinementTrace trace = anneal(bowl.cost(), bowl.cost(), bowl.frame, bowl.start, options, rng);
  EXPECT_EQ(trace.num_steps, 0);
  EXPECT_EQ(trace.final_cost, trace.initial_cost);
  EXPECT_FALSE(trace.kept);
  EXPECT_TRUE(trace.T_target_source.isApprox(bowl.start, 0));
}

TEST(Anneal, TheSeedDecidesTheWalk) {
  const Bowl bowl;
  const auto walk = [&](std::uint64_t seed) {
    Rng rng = make_stream(seed, "refinement_test annealing");
    return anneal(bowl.cost(), bowl.cost(), bowl.frame, bowl.start, annealing(), rng).T_target_source.matrix().eval();
  };
  EXPECT_TRUE(walk(6) == walk(6));
  EXPECT_FALSE(walk(6) == walk(7));
}

TEST(TwistFrame, ALengthMovesAPointAtTheRadiusByThatMuch) {
  const Bowl bowl;
  for (int k = 0; k < 3; ++k) {
    const Isometry3d T = bowl.frame.moved(Isometry3d::Identity(), 1e-4 * Twist::Unit(k));
    const Vector3d p = bowl.frame.centre + bowl.frame.radius_m * Vector3d::Unit((k + 1) % 3);
    EXPECT_NEAR((T * p - p).norm(), 1e-4, 1e-12);  // a chord is shorter than its arc by its cube over 24 radius^2
    EXPECT_TRUE(testing::is_near(bowl.frame.centre, T * bowl.frame.centre, 1e-13));
  }
}

TEST(RefinementStepOptions, RejectValuesOutOfRange) {
  const auto descent_throws = [](auto change) {
    DescentOptions o = descent();
    change(o);
    EXPECT_THROW(o.validate(), InvalidOptions);
  };
  EXPECT_NO_THROW(descent().validate());
  descent_throws([](auto& o) { o.initial_step_m = 0; });
  descent_throws([](auto& o) { o.min_step_m = 2 * o.initial_step_m; });
  descent_throws([](auto& o) { o.step_shrink = 1; });
  descent_throws([](auto& o) { o.max_steps = 0; });
  const auto annealing_throws = [](auto change) {
    AnnealingOptions o = annealing();
    change(o);
    EXPECT_THROW(o.validate(), InvalidOptions);
  };
  EXPECT_NO_THROW(annealing().validate());
  annealing_throws([](auto& o) { o.initial_step_m = std::nan(""); });
  annealing_throws([](auto& o) { o.final_step_m = 2 * o.initial_step_m; });
  annealing_throws([](auto& o) { o.initial_temperature = 0; });
  annealing_throws([](auto& o) { o.final_temperature = 2 * o.initial_temperature; });
  annealing_throws([](auto& o) { o.num_steps = -1; });
}

}  // namespace
}  // namespace tcm_icp
