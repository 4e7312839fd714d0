#include "survey/survey_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kVoxel_m = 0.1, kSigma_m = 0.05;

// Two scans in a survey frame, of which nothing is known yet.
class SurveyEvidenceTest : public ::testing::Test {
 protected:
  SurveyEvidenceTest() : scans_(2) {
    Rng rng = make_stream(1, "survey_evidence_test");
    for (auto& T : T_) T = Eigen::Translation3d(5e5, 5.4e6, 300) * testing::random_pose(20, rng);
    T_a_b_ = T_[0].inverse() * T_[1];
    for (auto& scan : scans_) scan.radius_m = 10;
  }

  void add_point(std::size_t scan, const std::string& name, const Vector3d& measured, const Vector3d& off = {0, 0, 0}) {
    scans_[scan].points.push_back({name, measured, T_[scan] * measured + off, kSigma_m, 0.01});
  }
  void add_pose(std::size_t scan, double sigma_rotation_rad) {
    scans_[scan].pose = {T_[scan], kSigma_m, sigma_rotation_rad};
  }
  double log_odds(const Isometry3d& T_a_b) const { return SurveyEvidence(scans_, kVoxel_m).log_odds(0, 1, T_a_b); }
  // Of b, in its own frame.
  Isometry3d moved(double by_m) const { return T_a_b_ * Eigen::Translation3d(0, by_m, 0); }
  Isometry3d turned(double by_rad) const { return T_a_b_ * Eigen::AngleAxisd(by_rad, Vector3d::UnitX()); }

  std::vector<SurveyedScan> scans_;
  Isometry3d T_[2], T_a_b_;
};

TEST_F(SurveyEvidenceTest, SaysNothingWhereNothingIsKnown) {
  EXPECT_EQ(SurveyEvidence().log_odds(0, 1, moved(100)), 0);
  EXPECT_EQ(log_odds(moved(100)), 0);
  add_point(0, "P", {1, 2, 3});
  EXPECT_EQ(log_odds(moved(100)), 0) << "of one of both";
}

TEST_F(SurveyEvidenceTest, DistancesBetweenPositionsSpeakAgainstOthers) {
  add_point(0, "A", Vector3d::Zero());
  add_point(1, "B", Vector3d::Zero());
  EXPECT_EQ(log_odds(T_a_b_), 0);
  EXPECT_EQ(log_odds(turned(1)), 0) << "about a position nothing is known";
  const Isometry3d on_a(Isometry3d(Eigen::Translation3d(0, 0, 0)).linear());
  ASSERT_GT(T_a_b_.translation().norm(), 2);
  EXPECT_EQ(log_odds(on_a), -8) << "both at one place";
}

TEST_F(SurveyEvidenceTest, CountsWhatIsBeyondThreeStandardDeviations) {
  add_point(0, "P", {3, 0, 0});
  scans_[1].points.push_back(scans_[0].points[0]);
  scans_[1].points[0].measured = T_a_b_.inverse() * Vector3d(3, 0, 0);
  // Given places of one name have no part in it: measured ones, and the pose's own deviation.
  const double sigma_m = std::sqrt(2 * 0.01 * 0.01 + kVoxel_m * kVoxel_m);
  const auto at = [&](double sigmas) { return log_odds(Eigen::Translation3d(0, 0, sigmas * sigma_m) * T_a_b_); };
  EXPECT_EQ(at(0), 0);
  EXPECT_EQ(at(2.9), 0);
  EXPECT_NEAR(at(4), -(16.0 - 9) / 2, 1e-6);
  EXPECT_EQ(at(20), -8) << "it may be a blunder";
}

TEST_F(SurveyEvidenceTest, PosesSpeakAgainstOtherPlacesAndTurns) {
  add_pose(0, 0.01);
  add_pose(1, 0.01);
  EXPECT_EQ(log_odds(T_a_b_), 0);
  EXPECT_LT(log_odds(moved(3)), -5);
  EXPECT_LT(log_odds(turned(0.2)), -5);
}

TEST_F(SurveyEvidenceTest, APoseIsComparedWithThePointsOfTheOther) {
  add_pose(0, 0.001);
  add_point(1, "P", {1, 1, 0});
  EXPECT_EQ(log_odds(T_a_b_), 0);
  EXPECT_EQ(log_odds(moved(3)), -8);
  const SurveyEvidence other_way({scans_[1], scans_[0]}, kVoxel_m);
  EXPECT_EQ(other_way.log_odds(0, 1, T_a_b_.inverse()), 0);
  EXPECT_EQ(other_way.log_odds(0, 1, moved(3).inverse()), -8);
}

TEST_F(SurveyEvidenceTest, ARotationThatIsKnownLooselyPutsFarPointsLoosely) {
  add_pose(0, 0.2);
  add_point(1, "P", {0, 0, 0});
  ASSERT_GT(T_a_b_.translation().norm(), 5) << "far from the middle of the other";
  EXPECT_EQ(log_odds(moved(1)), 0);
  scans_[0].pose->sigma_rotation_rad = 0.001;
  EXPECT_EQ(log_odds(moved(1)), -8);
}

TEST_F(SurveyEvidenceTest, UprightScansAreNotTilted) {
  for (auto& scan : scans_) scan.sigma_level_rad = 0.002;
  const Isometry3d upright =
      Eigen::Translation3d(7, 1, 0) * Eigen::AngleAxisd(2, Vector3d::UnitZ()) * Isometry3d::Identity();
  EXPECT_EQ(log_odds(upright), 0);
  EXPECT_EQ(log_odds(upright * Eigen::AngleAxisd(0.2, Vector3d::UnitY())), -8);
  scans_[1].sigma_level_rad = 0;
  EXPECT_EQ(log_odds(upright * Eigen::AngleAxisd(0.2, Vector3d::UnitY())), 0) << "one of both is not known to be";
}

// Pairs of all of ten scans.
std::vector<PairBySurvey> all_pairs(const std::function<bool(std::size_t, std::size_t)>& contradicted) {
  std::vector<PairBySurvey> out;
  for (std::size_t a = 0; a < 10; ++a) {
    for (std::size_t b = a + 1; b < 10; ++b) out.push_back({a, b, contradicted(a, b) ? -8.0 : 0.0});
  }
  return out;
}

TEST(SurveyBlunders, AreScansThatAllOthersContradict) {
  const std::vector<bool> none(11, false);
  EXPECT_EQ(survey_blunders({}, 11), none);
  EXPECT_EQ(survey_blunders(all_pairs([](auto, auto) { return false; }), 11), none);
  for (const std::size_t wrong : {0U, 3U, 9U}) {
    std::vector<bool> expected = none;
    expected[wrong] = true;
    EXPECT_EQ(survey_blunders(all_pairs([&](auto a, auto b) { return a == wrong || b == wrong; }), 11), expected);
  }
  // A scan with few pairs among many that agree.
  std::vector<PairBySurvey> pairs = all_pairs([](auto, auto) { return false; });
  pairs.push_back({10, 2, -8});
  EXPECT_EQ(survey_blunders(pairs, 11), none) << "a single pair may be wrong";
  pairs.push_back({10, 7, -8});
  EXPECT_TRUE(survey_blunders(pairs, 11)[10]);
  EXPECT_EQ(std::ranges::count(survey_blunders(pairs, 11), true), 1);
  std::vector<bool> two = none;
  two[1] = two[4] = true;
  EXPECT_EQ(survey_blunders(all_pairs([&](auto a, auto b) { return two[a] || two[b]; }), 11), two);
}

TEST(SurveyBlunders, OneOfThreeMayBeOne) {
  EXPECT_EQ(survey_blunders({{0, 1, 0}, {0, 2, -8}, {1, 2, -8}}, 3), (std::vector<bool>{false, false, true}));
}

TEST(SurveyBlunders, WhereManyScansWouldBeItIsPairsThatAreWrong) {
  const std::vector<bool> none(10, false);
  EXPECT_EQ(survey_blunders(all_pairs([](auto, auto) { return true; }), 10), none);
  EXPECT_EQ(survey_blunders(all_pairs([](auto a, auto b) { return a < 3 || b < 3; }), 10), none);
  EXPECT_EQ(survey_blunders(all_pairs([](auto a, auto b) { return a / 5 != b / 5; }), 10), none) << "two groups";
  EXPECT_EQ(survey_blunders({{0, 1, -8}}, 2), std::vector<bool>(2, false)) << "nobody knows which";
}

}  // namespace
}  // namespace tcm_icp
