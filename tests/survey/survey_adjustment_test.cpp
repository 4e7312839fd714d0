#include "survey/survey_adjustment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/cross_matrix.hpp"
#include "survey/survey_equations.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

Eigen::Vector3d normal3(Rng& rng) { return {standard_normal(rng), standard_normal(rng), standard_normal(rng)}; }

std::string target(std::size_t k) { return std::string("T").append(std::to_string(k)); }

Eigen::Isometry3d random_pose(Rng& rng, double reach_m) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() =
      Eigen::Quaterniond(standard_normal(rng), standard_normal(rng), standard_normal(rng), standard_normal(rng))
          .normalized()
          .toRotationMatrix();
  T.translation() = reach_m * normal3(rng);
  return T;
}

// Scans about 30 m apart that the joint adjustment left with errors drawn from the covariance it states.
struct Scene {
  ScanNetwork network;
  std::vector<Eigen::Isometry3d> T_local_true;
  Eigen::Isometry3d T_survey_local;
  SurveyObservations observations;

  Scene(std::size_t num_scans, double sigma_m, Rng& rng) : T_survey_local(random_pose(rng, 1000)) {
    const auto size = static_cast<Eigen::Index>(6 * num_scans);
    Eigen::MatrixXd root = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index i = 6; i < size; ++i) {
      for (Eigen::Index j = 6; j <= i; ++j) root(i, j) = sigma_m * (i == j ? 1 : 0.3 * standard_normal(rng));
    }
    network.covariance_m2 = root * root.transpose();
    Eigen::VectorXd draw(size);
    for (auto& value : draw) value = standard_normal(rng);
    const Eigen::VectorXd error = root * draw;
    for (std::size_t i = 0; i < num_scans; ++i) {
      const Eigen::Isometry3d T = i == 0 ? Eigen::Isometry3d::Identity() : random_pose(rng, 30);
      network.T_local_scan.push_back(T);
      network.frames.push_back({T.translation() + normal3(rng), 15});
      T_local_true.push_back(network.frames[i].moved(T, error.segment<6>(static_cast<Eigen::Index>(6 * i))));
    }
  }

  Eigen::Isometry3d true_pose(std::size_t scan) const { return T_survey_local * T_local_true[scan]; }

  PointObservation& add(const std::string& name, std::size_t scan, const Eigen::Vector3d& place, double sigma_given_m,
                        double sigma_measured_m, Rng& rng) {
    PointObservation p;
    p.name = name;
    p.scan = scan;
    for (const auto& other : observations.points) {
      if (other.name == name) p.given = other.given;
    }
    if (p.given.isZero()) p.given = place + sigma_given_m * normal3(rng);
    p.measured = true_pose(scan).inverse() * place + sigma_measured_m * normal3(rng);
    p.sigma_given_m.setConstant(sigma_given_m);
    p.sigma_measured_m.setConstant(sigma_measured_m);
    observations.points.push_back(p);
    return observations.points.back();
  }
  Eigen::Vector3d place_near(std::size_t scan, Rng& rng) const { return true_pose(scan) * (10 * normal3(rng)); }
};

double error_m(const Scene& scene, const SurveySolution& solution, std::size_t scan) {
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d p = 15 * Eigen::Vector3d::Unit(axis);
    worst = std::max(worst, (solution.T_survey_scan[scan] * p - scene.true_pose(scan) * p).norm());
  }
  return worst;
}

TEST(SurveyAdjustment, ExactPointsGiveTheFrame) {
  Rng rng = make_stream(1, "survey");
  Scene scene(4, 0, rng);
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t scan = k % 4;
    scene.add(target(k), scan, scene.place_near(scan, rng), 1e-12, 0, rng);
  }
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  ASSERT_GT(scene.T_survey_local.translation().norm(), 10);
  ASSERT_TRUE(solution.is_determined());
  EXPECT_EQ(solution.degrees_of_freedom, 9);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(error_m(scene, solution, i), 1e-8);  // rounding at 1000 m
}

// The same by normal equations in all unknowns, written out.
TEST(SurveyAdjustment, AgreesWithLeastSquaresInAllUnknowns) {
  Rng rng = make_stream(2, "survey");
  Scene scene(3, 0.004, rng);
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t scan = k % 3;
    scene.add(target(k), scan, scene.place_near(scan, rng), 0.003, 0.002, rng);
  }
  const Eigen::Vector3d shared = scene.place_near(1, rng);
  scene.add("shared", 0, shared, 0.003, 0.002, rng);
  scene.add("shared", 1, shared, 0.003, 0.002, rng);
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  for (const auto& point : solution.points) ASSERT_FALSE(point.is_blunder);

  // Unknowns: the frame, the steps of scans 1 and 2, all by numerical derivatives of the observations.
  const TwistFrame whole = frame_of_network(scene.network);
  const auto residuals = [&](const Eigen::VectorXd& x) {
    const Eigen::Isometry3d T =
        TwistFrame{solution.T_survey_local * whole.centre, whole.radius_m}.moved(solution.T_survey_local, x.head<6>());
    Eigen::VectorXd out(24);
    for (std::size_t k = 0; k < 8; ++k) {
      const PointObservation& p = scene.observations.points[k];
      Eigen::Isometry3d T_local = scene.network.T_local_scan[p.scan];
      if (p.scan > 0) {
        T_local = scene.network.frames[p.scan].moved(T_local, x.segment<6>(static_cast<Eigen::Index>(6 * p.scan)));
      }
      out.segment<3>(static_cast<Eigen::Index>(3 * k)) = p.given - T * (T_local * p.measured);
    }
    return out;
  };
  Eigen::MatrixXd R = Eigen::MatrixXd::Identity(24, 24) * (9e-6 + 4e-6);
  R.block<3, 3>(18, 21) = R.block<3, 3>(21, 18) = 9e-6 * Eigen::Matrix3d::Identity();
  Eigen::MatrixXd J(24, 18);
  const double h = 1e-4;
  for (Eigen::Index j = 0; j < 18; ++j) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(18, j);
    J.col(j) = -(residuals(step) - residuals(-step)) / (2 * h);
  }
  Eigen::MatrixXd N = J.transpose() * R.inverse() * J;
  N.bottomRightCorner<12, 12>() += scene.network.covariance_m2.bottomRightCorner<12, 12>().inverse();
  const Eigen::VectorXd x = N.ldlt().solve(J.transpose() * R.inverse() * residuals(Eigen::VectorXd::Zero(18)));
  EXPECT_LT(x.head<6>().norm(), 1e-6);  // the frame is at its optimum; rotations of a scan's step are squares of 1e-3
  const Eigen::MatrixXd C = N.inverse();
  for (std::size_t i = 1; i < 3; ++i) {
    const TwistFrame& frame = scene.network.frames[i];
    const Eigen::Isometry3d expected =
        solution.T_survey_local *
        frame.moved(scene.network.T_local_scan[i], x.segment<6>(static_cast<Eigen::Index>(6 * i)));
    EXPECT_LT((expected.translation() - solution.T_survey_scan[i].translation()).norm(), 1e-6);
    EXPECT_LT((expected.linear() - solution.T_survey_scan[i].linear()).norm(), 1e-7);
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(6, 18);
    const Eigen::Matrix3d turn = solution.T_survey_local.linear();
    motion.block<3, 3>(0, 0).diagonal().setConstant(1 / whole.radius_m);
    motion.block<3, 3>(3, 0) = -cross_matrix(turn * (frame.centre - whole.centre)) / whole.radius_m;
    motion.block<3, 3>(3, 3).setIdentity();
    motion.block<3, 3>(0, static_cast<Eigen::Index>(6 * i)) = turn / frame.radius_m;
    motion.block<3, 3>(3, static_cast<Eigen::Index>(6 * i + 3)) = turn;
    const Matrix6 covariance = motion * C * motion.transpose();
    EXPECT_LT((covariance - solution.covariance[i]).norm(), 1e-4 * covariance.norm());
  }
}

TEST(SurveyAdjustment, StatesHowFarOffItIs) {
  double sum = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng = make_stream(static_cast<std::uint64_t>(run), "covered");
    Scene scene(5, 0.01, rng);
    for (std::size_t k = 0; k < 5; ++k) {
      scene.add(target(k), k, scene.place_near(k, rng), 0.02, 0.005, rng);
    }
    const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
    const std::size_t scan = 1 + static_cast<std::size_t>(run % 4);
    const Eigen::Vector3d centre = solution.T_survey_local * scene.network.frames[scan].centre;
    const Eigen::Isometry3d off = scene.true_pose(scan) * solution.T_survey_scan[scan].inverse();
    const Eigen::AngleAxisd angle(off.linear());
    Twist twist;
    twist << angle.angle() * angle.axis(), off * centre - centre;
    sum += twist.dot(solution.covariance[scan].ldlt().solve(twist));
  }
  EXPECT_NEAR(sum / kRuns, 6, 6 * 4 * std::sqrt(2.0 / (6 * kRuns)));  // four standard deviations of the mean
}

TEST(SurveyAdjustment, NamesTwoBlundersOfFiveCentimetresAmongEight) {
  int false_alarms = 0;
  double squares_m2 = 0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng = make_stream(static_cast<std::uint64_t>(run), "blunders");
    Scene scene(4, 0.001, rng);
    for (std::size_t k = 0; k < 8; ++k) {
      scene.add(target(k), k % 4, scene.place_near(k % 4, rng), 0.002, 0.002, rng);
    }
    scene.observations.points[2].given += Eigen::Vector3d(0.04, -0.03, 0);
    scene.observations.points[5].measured += Eigen::Vector3d(0, 0.03, 0.04);
    PointObservation& check = scene.add("check", 1, scene.place_near(1, rng), 0.002, 0.002, rng);
    check.is_check = true;
    const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
    EXPECT_TRUE(solution.points[2].is_blunder) << run;
    EXPECT_TRUE(solution.points[5].is_blunder) << run;
    EXPECT_GT(*solution.points[2].test, chi_squared_limit(3));
    EXPECT_LT(*solution.points[8].test, 21.1) << run;  // once in 10,000 times
    EXPECT_FALSE(solution.points[8].is_used || solution.points[8].is_blunder);
    for (const std::size_t k : {0U, 1U, 3U, 4U, 6U, 7U}) false_alarms += solution.points[k].is_blunder ? 1 : 0;
    const Eigen::Isometry3d off = solution.T_survey_local * scene.T_survey_local.inverse();
    const Eigen::Vector3d centre = scene.T_survey_local * frame_of_network(scene.network).centre;
    squares_m2 += (off * centre - centre).squaredNorm();
  }
  EXPECT_LE(false_alarms, 2);                       // one in a thousand each
  EXPECT_LT(std::sqrt(squares_m2 / kRuns), 0.003);  // 2.8 mm by six points and three axes, and the arm to the middle
}

TEST(SurveyAdjustment, APlaceGivenWrongIsABlunderInEveryScan) {
  Rng rng = make_stream(5, "survey");
  Scene scene(4, 0.001, rng);
  for (std::size_t k = 0; k < 6; ++k) {
    const Eigen::Vector3d place = scene.place_near(k % 4, rng);
    for (const std::size_t scan : {k % 4, (k + 1) % 4}) {
      scene.add(target(k), scan, place, 0.002, 0.002, rng);
    }
  }
  for (auto& point : scene.observations.points) {
    if (point.name == "T3") point.given += Eigen::Vector3d(0.05, 0, 0);
  }
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  for (std::size_t k = 0; k < solution.points.size(); ++k) {
    EXPECT_EQ(solution.points[k].is_blunder, scene.observations.points[k].name == "T3") << k;
  }
  scene.observations.points[6].given = scene.observations.points[7].given -= Eigen::Vector3d(0.05, 0, 0);
  scene.observations.points[6].measured += Eigen::Vector3d(0.05, 0, 0);  // now one scan's alone
  const SurveySolution other = adjust_to_survey(scene.network, scene.observations);
  for (std::size_t k = 0; k < other.points.size(); ++k) EXPECT_EQ(other.points[k].is_blunder, k == 6) << k;
}

TEST(SurveyAdjustment, SaysWhichOfTwoMayBeTheBlunder) {
  Rng rng = make_stream(6, "survey");
  Scene scene(1, 0, rng);
  scene.T_survey_local.linear().setIdentity();
  const Eigen::Vector3d corners[] = {{10, 0, 0}, {-10, 0, 0}, {0, 1, 0}, {0, -1, 0.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    auto& point = scene.add(target(k), 0, scene.true_pose(0) * corners[k], 0.001, 0.001, rng);
    if (k >= 2) point.sigma_given_m.x() = 10;  // says nothing of places along the line of the other two
  }
  scene.observations.points[0].measured += Eigen::Vector3d(0.1, 0, 0);
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  ASSERT_EQ(solution.remarks.size(), 1U);
  EXPECT_NE(solution.remarks[0].find("instead the others would agree as well"), std::string::npos);
  EXPECT_NE(solution.points[0].is_blunder, solution.points[1].is_blunder);
}

TEST(SurveyAdjustment, OnePointMovesAndDoesNotTurn) {
  Rng rng = make_stream(7, "survey");
  Scene scene(2, 0.001, rng);
  scene.add("T", 0, scene.place_near(0, rng), 0.002, 0.002, rng);
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  EXPECT_EQ(solution.num_rotations, 0);
  EXPECT_TRUE(solution.T_survey_local.linear().isIdentity(1e-12));
  EXPECT_LT(solution.points[0].residual_m.norm(), 1e-9);
  EXPECT_FALSE(solution.points[0].test.has_value());
  EXPECT_NEAR(solution.points[0].redundancy, 0, 1e-9);
  ASSERT_EQ(solution.remarks.size(), 2U);
}

TEST(SurveyAdjustment, PointsOnALineLeaveOneRotation) {
  Rng rng = make_stream(8, "survey");
  Scene scene(1, 0, rng);
  const Eigen::Vector3d start = scene.place_near(0, rng), along = normal3(rng).normalized();
  for (std::size_t k = 0; k < 4; ++k)
    scene.add(target(k), 0, start + 8.0 * static_cast<double>(k) * along, 0.001, 0.001, rng);
  const SurveySolution line = adjust_to_survey(scene.network, scene.observations);
  EXPECT_EQ(line.num_rotations, 2);
  for (const auto& point : line.points) EXPECT_LT(point.residual_m.norm(), 0.01);
  scene.observations.levels.push_back({0, 1e-3});
  const Eigen::Isometry3d upright(Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()));
  for (auto& point : scene.observations.points) {
    point.measured = scene.true_pose(0) * point.measured;  // the scan stands upright now
    point.given = upright * point.measured;
  }
  const SurveySolution level = adjust_to_survey(scene.network, scene.observations);
  EXPECT_EQ(level.num_rotations, 3);
  EXPECT_LT(rotation_angle_rad(level.T_survey_scan[0].linear().transpose() * upright.linear()), 3e-3);
}

TEST(SurveyAdjustment, FixedScansStayAndOthersFollow) {
  Rng rng = make_stream(9, "survey");
  Scene scene(4, 0.005, rng);
  for (const std::size_t i : {1U, 2U}) scene.observations.poses.push_back({"s", i, scene.true_pose(i), 1e-7, 1e-6});
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  EXPECT_TRUE(solution.is_determined());
  EXPECT_LT(error_m(scene, solution, 1), 1e-4);
  EXPECT_LT(error_m(scene, solution, 2), 1e-4);
  const Matrix6& free = solution.covariance[3];
  EXPECT_LT(solution.covariance[1].norm(), 1e-3 * free.norm());
  EXPECT_LT(error_m(scene, solution, 3), 6 * std::sqrt(free.trace() * 15 * 15));
}

bool says(const SurveySolution& solution, const std::string& text) {
  return std::any_of(solution.remarks.begin(), solution.remarks.end(),
                     [&](const std::string& remark) { return remark.find(text) != std::string::npos; });
}

/// Poses of the scans 0, 1 and 2 are known; that of scan 1 is 0.3 m and 0.05 rad off.
Scene scene_with_one_wrong_pose(bool is_fixed) {
  Rng rng = make_stream(10, "survey");
  Scene scene(4, 0.005, rng);
  for (const std::size_t i : {0U, 1U, 2U}) {
    scene.observations.poses.push_back({"scan " + std::to_string(i), i, scene.true_pose(i), 1e-4, 1e-3, is_fixed});
  }
  EXPECT_TRUE(adjust_to_survey(scene.network, scene.observations).remarks.empty());
  Eigen::Isometry3d& wrong = scene.observations.poses[1].T_survey_scan;
  wrong.pretranslate(Eigen::Vector3d(0.3, 0, 0));
  wrong.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()));
  return scene;
}

TEST(SurveyAdjustment, AnInitialPoseThatContradictsTheOthersIsNamedAndLeftOut) {
  Scene scene = scene_with_one_wrong_pose(false);
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  EXPECT_TRUE(says(solution, "scan 1 contradicts links and other observations and was left out"));
  EXPECT_EQ(solution.remarks.size(), 1U);
  scene.observations.poses.erase(scene.observations.poses.begin() + 1);
  const SurveySolution without = adjust_to_survey(scene.network, scene.observations);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((solution.T_survey_scan[i].matrix() - without.T_survey_scan[i].matrix()).norm(), 1e-9);
  }
  EXPECT_LT(error_m(scene, solution, 1), 0.05);
}

TEST(SurveyAdjustment, AFixedPoseThatContradictsTheOthersIsNamedAndKept) {
  const Scene scene = scene_with_one_wrong_pose(true);
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  EXPECT_TRUE(says(solution, "scan 1 contradicts links and other observations: these put it"));
  EXPECT_FALSE(says(solution, "left out"));
}

TEST(SurveyAdjustment, OfTwoInitialPosesThatContradictEachOtherNoneIsLeftOut) {
  Scene scene = scene_with_one_wrong_pose(false);
  scene.observations.poses.erase(scene.observations.poses.begin());
  const SurveySolution solution = adjust_to_survey(scene.network, scene.observations);
  EXPECT_TRUE(says(solution, "contradicts"));
  EXPECT_FALSE(says(solution, "left out"));
}

TEST(SurveyAdjustment, LimitsOfChiSquaredAreThoseOfTables) {
  EXPECT_NEAR(chi_squared_limit(3), 16.27, 0.01);
  EXPECT_NEAR(chi_squared_limit(10), 29.59, 0.2);
  EXPECT_NEAR(chi_squared_limit(100), 149.45, 0.3);
}

}  // namespace
}  // namespace tcm_icp
