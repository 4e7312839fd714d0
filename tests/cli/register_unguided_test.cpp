// `tcm-icp register` without --init: scans in frames of their own come together, and what does not belong stays out.

#include <algorithm>
#include <cmath>

#include "cli_test.hpp"
#include "result_files.hpp"
#include "rewritten_town.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp::test {
namespace {

using Moves = std::vector<Eigen::Affine3d>;

class RegisterUnguided : public CliTest {
 protected:
  RunResult register_to(const std::string& out, const Words& arguments) const {
    return run(Words{"register", "--out", out} + arguments);
  }
  PoseFile poses(const std::string& out) const { return read_pose_file(folder() / out / "poses.json"); }

  /// All six are right within the truth's tolerance, though the files' own frames are far off.
  void expect_all_right(const PoseFile& file) const {
    const SceneScore score = score_town(file);
    for (const auto& scan : score.scans) {
      EXPECT_EQ(scan.verdict, PoseVerdict::kOk) << scan.file << ": " << (scan.error ? scan.error->rmse_m : -1) << " m";
    }
  }
  /// The same verdicts, and poses that put points within 50 m no further apart.
  void expect_near(const PoseFile& a, const PoseFile& b, double tolerance_m) const {
    ASSERT_EQ(a.scans.size(), b.scans.size());
    EXPECT_EQ(a.reference, b.reference);
    for (std::size_t i = 0; i < a.scans.size(); ++i) {
      EXPECT_EQ(a.scans[i].verdict, b.scans[i].verdict);
      EXPECT_LT(difference_m(a.scans[i].T_reference_scan, b.scans[i].T_reference_scan, 50), tolerance_m) << i;
    }
  }
  /// Registers the town as it is, and with each scan moved by what changes nothing but the rounding.
  void expect_same_when_moved(const Moves& moves, double tolerance_m) const {
    ASSERT_EQ(register_to("unmoved", town_scans() + kSmall).exit_code, 0);
    expect_right_when_moved(moves);
    expect_near(poses("unmoved"), moved_back(poses("result"), moves), tolerance_m);
  }
  /// Registers the town with each scan moved.
  void expect_right_when_moved(const Moves& moves) const {
    Words files;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      write_moved(folder_, i, moves[i]);
      files.push_back(town_name(i));
    }
    const RunResult result = register_to("result", files + kSmall);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_all_right(moved_back(poses("result"), moves));
  }
  /// What registering the simulated scans of a folder came to.
  nlohmann::json score_of(const std::string& scans, int num_scans, const Words& options = {}) const {
    Words files;
    for (int i = 0; i < num_scans; ++i) files.push_back(scans + (i < 10 ? "/00" : "/0") + std::to_string(i) + ".ply");
    register_to("result", files + Words{"--force"} + options);
    run({"evaluate", "--poses", "result/poses.json", "--truth", scans + "/truth.json", "--scans", scans, "--json",
         "score.json"});
    return read_json(folder() / "score.json");
  }
  /// What registering six simulated scans of equal rooms along a corridor came to.
  nlohmann::json score_of_rooms(const std::string& seed) const {
    EXPECT_EQ(run({"simulate", "--scene", "interior", "--scans", "6", "--seed", seed, "--out", "rooms"}).exit_code, 0);
    return score_of("rooms", 6);
  }
};

TEST_F(RegisterUnguided, PlacesEveryScanOfTheTown) {
  const std::vector<std::optional<Eigen::Isometry3d>> as_they_lie(6, Eigen::Isometry3d::Identity());
  ASSERT_EQ(score_town(as_they_lie, 2).count(PoseVerdict::kWrong), 5U) << "the start must fail";
  const RunResult result = register_to("result", town_scans());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_all_right(poses("result"));
  for (const auto& scan : poses("result").scans) {
    EXPECT_EQ(scan.verdict, Verdict::kAccepted);
    EXPECT_EQ(scan.component, 0);
    EXPECT_FALSE(scan.pose_in_component);
  }
  const auto report = read_json(folder() / "result/report.json");
  EXPECT_EQ(report["merges"].size(), 5u);
  for (const auto& scan : report["scans"]) {
    const auto& decision = scan["decision"];
    EXPECT_TRUE(decision["reason"] == "accepted" || decision["reason"] == "the reference") << decision["reason"];
    EXPECT_GT(decision["lead"], 0) << scan["file"];
    EXPECT_GE(decision["support"], decision["lead"]) << scan["file"];
  }
}

// A fifth of all points hangs in the air, as in rain or snow: so many that k-means takes them for clusters.
TEST_F(RegisterUnguided, AmongIsolatedPoints) {
  ASSERT_EQ(run(Words{"degrade", "--isolated", "0.2", "--seed", "1", "--out", "rain"} + town_scans()).exit_code, 0);
  Words scans;
  for (const std::string& file : town_scans()) {
    scans.push_back((folder() / "rain" / std::filesystem::path(file).filename()).string());
  }
  const RunResult result = register_to("result", scans);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_all_right(poses("result"));
}

TEST_F(RegisterUnguided, LevelledScansUpright) {
  const RunResult result = register_to("result", town_scans() + kSmall + Words{"--level"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_all_right(poses("result"));
  const auto report = read_json(folder() / "result/report.json");
  EXPECT_EQ(report["options"]["level"], true);
  for (const auto& h : report["hypotheses"]) {
    EXPECT_GT(h["pose_of_b_in_a"][2][2].get<double>(), 0.9) << "no link is upside down";
  }
}

TEST_F(RegisterUnguided, InAnyOrderOfTheFiles) {
  const Words reference = Words{"--reference", "002.ply"} + kSmall;
  ASSERT_EQ(register_to("forwards", town_scans() + reference).exit_code, 0);
  ASSERT_EQ(register_to("mixed", town_scans({3, 5, 1, 0, 4, 2}) + reference).exit_code, 0);
  const PoseFile a = poses("forwards"), b = poses("mixed");
  expect_all_right(b);
  for (const auto& scan : a.scans) {
    const auto at = std::find_if(b.scans.begin(), b.scans.end(), [&](const auto& s) { return s.file == scan.file; });
    ASSERT_NE(at, b.scans.end());
    EXPECT_EQ(at->verdict, scan.verdict);
    EXPECT_TRUE(scan.T_reference_scan.matrix() == at->T_reference_scan.matrix()) << scan.file;
  }
}

TEST_F(RegisterUnguided, TurnedInAnyWay) {
  Rng rng = make_stream(1, "register_unguided_test");
  Moves moves;
  for (int i = 0; i < 6; ++i) moves.emplace_back(testing::random_pose(100, rng));
  expect_right_when_moved(moves);
}

TEST_F(RegisterUnguided, InMillimetres) {
  expect_same_when_moved(Moves(6, Eigen::Affine3d(Eigen::Scaling(1000.0))), 1e-9);
}

TEST_F(RegisterUnguided, InKilometres) {
  expect_same_when_moved(Moves(6, Eigen::Affine3d(Eigen::Scaling(0.001))), 1e-9);
}

TEST_F(RegisterUnguided, FarFromTheOrigin) {
  Moves moves;
  for (int i = 0; i < 6; ++i) moves.emplace_back(Eigen::Translation3d(5e6, (i - 3) * 1e6, 100 * i));
  // The files round 5,000 km by 1e-9 m.
  expect_same_when_moved(moves, 1e-7);
}

// Two of its scans share so little that a height map pose is left without a shared cell: its margin was 0 by 0, and the
// graph's measure not a number.
TEST_F(RegisterUnguided, PairsThatShareNextToNothingDoNotStopTheRun) {
  ASSERT_EQ(run({"simulate", "--scene", "town", "--out", "town", "--seed", "1"}).exit_code, 0);
  Words scans;
  for (int i = 0; i < 6; ++i) scans.push_back("town/00" + std::to_string(i) + ".ply");
  const RunResult result = register_to("result", scans);
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(RegisterUnguided, TwoPlacesAreTwoGroups) {
  const Words tripod{"--sensor", "terrestrial", "--max-range", "40"};
  ASSERT_EQ(
      run(Words{"simulate", "--scene", "street", "--scans", "2", "--out", "street", "--seed", "5"} + tripod).exit_code,
      0);
  std::filesystem::rename(folder() / "street/000.ply", folder() / "street_a.ply");
  std::filesystem::rename(folder() / "street/001.ply", folder() / "street_b.ply");
  const RunResult result = register_to(
      "result", town_scans({2, 3}) + Words{"street_a.ply", "street_b.ply", "--reference", "002.ply"} + kSmall);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const PoseFile file = poses("result");
  ASSERT_EQ(file.scans.size(), 4U);
  EXPECT_EQ(file.scans[0].status, ScanStatus::kReference);
  EXPECT_EQ(file.scans[1].status, ScanStatus::kRegistered) << file.scans[1].reason;
  EXPECT_EQ(file.scans[1].component, 0);
  const auto json = read_json(folder() / "result/poses.json");
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(file.scans[i].status, ScanStatus::kUnregistered);
    EXPECT_EQ(file.scans[i].component, 1);
    EXPECT_TRUE(json["scans"][i]["pose"].is_null());
    ASSERT_TRUE(json["scans"][i].contains("pose_in_component")) << file.scans[i].reason;
    EXPECT_FALSE(json["scans"][i]["pose_in_component"].is_null());
  }
  // Their poses are right against each other, and the town's against the town.
  const auto T_of = [](const Truth& truth, std::size_t a, std::size_t b) {
    return Eigen::Isometry3d(truth.scans[a].T_world_scan.inverse() * truth.scans[b].T_world_scan);
  };
  const Truth town = read_truth(town_file("truth.json")), street = read_truth(folder() / "street/truth.json");
  EXPECT_LT(difference_m(file.scans[1].T_reference_scan, T_of(town, 2, 3), 20), 0.1);
  ASSERT_TRUE(file.scans[2].pose_in_component && file.scans[3].pose_in_component);
  const Eigen::Isometry3d T_a_b = file.scans[2].pose_in_component->inverse() * *file.scans[3].pose_in_component;
  ASSERT_GT(difference_m(Eigen::Isometry3d::Identity(), T_of(street, 0, 1), 20), 1);
  EXPECT_LT(difference_m(T_a_b, T_of(street, 0, 1), 20), 0.1);
}

// Equal rooms along a corridor: pairs alone agree at many poses, and what was seen through tells them apart.
TEST_F(RegisterUnguided, RoomsThatRepeatAreToldApartByFreeSpace) {
  const auto score = score_of_rooms("1");
  EXPECT_EQ(score["wrong"], 0);
  EXPECT_GE(score["ok"], 4) << "pairs alone placed none but the reference";
  const auto report = read_json(folder() / "result/report.json"), truth = read_json(folder() / "rooms/truth.json");
  std::size_t determined = 0, vetoed = 0, likely = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& viewpoint = report["scans"][i]["viewpoint"];
    if (!viewpoint["determined"]) continue;
    ++determined;
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
      const double apart = viewpoint["place"][k].get<double>() - truth["scans"][i]["scanner"][k].get<double>();
      squared += apart * apart;
    }
    EXPECT_LT(std::sqrt(squared), 0.3) << "of rooms of 4 to 8 m";
  }
  EXPECT_GE(determined, 4U);
  for (const auto& h : report["hypotheses"]) {
    if (h["free_space"].is_null() || !h["free_space"]["veto"]) continue;
    ++vetoed;
    EXPECT_LT(h["log_odds"], 1) << "none is likely";
    likely += h["log_odds"] >= 0 ? 1 : 0;
  }
  EXPECT_LE(10 * likely, vetoed) << "more likely wrong than right, most of them";
  EXPECT_GT(vetoed, 10U) << "beside the poses that were not even fitted";
}

// Along a corridor scans fit best where they overlap most; slides of such poses, and what other links imply, find where
// they belong.
TEST_F(RegisterUnguided, ScansOfACorridorAreNotLaidOverOneAnother) {
  const auto score = score_of_rooms("11");
  EXPECT_EQ(score["wrong"], 0);
  EXPECT_GE(score["ok"], 5) << "without slides three";
  const auto report = read_json(folder() / "result/report.json");
  std::size_t led_there = 0;
  for (const auto& h : report["hypotheses"]) {
    const bool searched = h["method"] == "height map" || h["method"] == "features";
    if (!searched && h["fate"] == "confirmed") ++led_there;
  }
  EXPECT_GE(led_there, 1U);
}

TEST_F(RegisterUnguided, LinesOfASpinningScannerTellWhereItStood) {
  ASSERT_EQ(
      run({"simulate", "--scene", "street", "--sensor", "spinning", "--scans", "3", "--seed", "5", "--out", "street"})
          .exit_code,
      0);
  ASSERT_EQ(register_to("result", {"street/000.ply", "street/001.ply", "street/002.ply"}).exit_code, 0);
  const auto report = read_json(folder() / "result/report.json"), truth = read_json(folder() / "street/truth.json");
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& viewpoint = report["scans"][i]["viewpoint"];
    EXPECT_TRUE(viewpoint["determined"]);
    EXPECT_EQ(viewpoint["evidence"], "scan lines");
    EXPECT_GT(viewpoint["line_share"], 0.9);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(viewpoint["place"][k].get<double>(), truth["scans"][i]["scanner"][k].get<double>(), 0.1);
    }
    EXPECT_FALSE(report["scans"][i]["free_space"]["veto"]);
  }
}

TEST_F(RegisterUnguided, AMirroredScanStaysOut) {
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror(0, 0) = -1;
  write_moved(folder_, 3, mirror);
  const RunResult result = register_to("result", town_scans({0, 1, 2, 4, 5}) + Words{"003.ply"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const PoseFile file = poses("result");
  EXPECT_EQ(file.scans[5].status, ScanStatus::kUnregistered) << file.scans[5].reason;
  const SceneScore score = score_town(file);
  EXPECT_EQ(score.count(PoseVerdict::kOk), 5U) << "the others are none the worse";
  EXPECT_EQ(score.count(PoseVerdict::kWrong), 0U);
}

// A building of bays with few things in them: its halves agree the other way about, too, but for what is seen through.
TEST_F(RegisterUnguided, HalvesThatAreAlikeAreNotHungTheWrongWay) {
  ASSERT_EQ(run({"simulate", "--scene", "bays", "--scans", "10", "--clutter", "0.3", "--thinning", "0.1", "--seed", "4",
                 "--out", "bays"})
                .exit_code,
            0);
  const auto score = score_of("bays", 10);
  EXPECT_EQ(score["wrong"], 0) << "five were";
  EXPECT_GE(score["ok"], 5);
}

// A car at 10 m/s whose scanner turns ten times a second, and nobody corrects for it: each sweep is bent by a metre.
TEST_F(RegisterUnguided, SweepsOfAMovingScannerDoNotBendTheStreet) {
  ASSERT_EQ(
      run({"simulate", "--scene",         "street", "--sensor", "spinning", "--lines",       "32",   "--min-elevation",
           "-25",      "--max-elevation", "15",     "--step",   "0.5",      "--spacing",     "1.5",  "--scans",
           "12",       "--thinning",      "0",      "--speed",  "10",       "--range-noise", "0.01", "--seed",
           "5",        "--out",           "street"})
          .exit_code,
      0);
  const auto rigid = score_of("street", 12, {"--adjustment.bending", "no"});
  EXPECT_EQ(read_json(folder() / "result/report.json")["adjustment"]["motion_m"], 0);
  const auto bent = score_of("street", 12);
  EXPECT_EQ(bent["ok"], 12);
  EXPECT_LT(bent["max_rmse"].get<double>(), 0.7 * rigid["max_rmse"].get<double>());
  const double motion_m = read_json(folder() / "result/report.json")["adjustment"]["motion_m"];
  EXPECT_GT(motion_m, 0.4) << "rather less than too much";
  EXPECT_LT(motion_m, 1.1);
}

}  // namespace
}  // namespace tcm_icp::test
