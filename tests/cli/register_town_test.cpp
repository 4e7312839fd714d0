// `tcm-icp register` on datasets/town: the poses are right, and every file holds what docs/formats.md promises.

#include <algorithm>
#include <fstream>

#include "cli_test.hpp"
#include "result_files.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp::test {
namespace {

class RegisterTown : public CliTest {
 protected:
  RunResult register_town(const Words& options) const {
    return run(Words{"register"} + town_scans() + Words{"--out", "result"} + options);
  }
  Words guess() const { return {"--init", town_file("initial_poses.json").string()}; }
  PoseFile poses() const { return read_pose_file(folder() / "result/poses.json"); }
};

// JSON writes a NaN as null. Only the distance to another place may be unknown, the evidence of the reference, what
// free space says where no viewpoint was found, and what nobody was told: limits, and whose project it is; and what
// fits would have found where none ran.
void expect_every_number_known(const nlohmann::json& value, const std::string& place) {
  EXPECT_TRUE(!value.is_null() || place.ends_with(".other_place_m") || place.ends_with(".evidence") ||
              place.ends_with(".free_space") || place.ends_with(".share_within_limit") ||
              place.starts_with("report.project.") || place.find(".simplex.") != std::string::npos)
      << place << " is null";
  if (!value.is_structured()) return;
  for (const auto& [key, entry] : value.items()) expect_every_number_known(entry, place + "." + key);
}

TEST_F(RegisterTown, PlacesEveryScanWithinTolerance) {
  const Truth truth = read_truth(town_file("truth.json"));
  std::vector<std::string> files;
  for (const auto& scan : truth.scans) files.push_back(scan.file);
  // The start fails, so that a program that hands it through fails, too.
  const SceneScore start = score_town(read_initial_poses(town_file("initial_poses.json"), files), 2);
  ASSERT_EQ(start.count(PoseVerdict::kWrong), 5U);

  const RunResult result = register_town(guess());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("tcm-icp:"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("\n  5  005.ply  accepted"), std::string::npos) << result.err;
  EXPECT_EQ(score_town(poses()).count(PoseVerdict::kOk), 6U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder()), {}), 1);
}

TEST_F(RegisterTown, WritesPosesAndTransformsByTheContract) {
  ASSERT_EQ(register_town(guess() + Words{"--reference", "004.ply"} + kSmall).exit_code, 0);
  const nlohmann::json json = read_json(folder() / "result/poses.json");
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["reference"], "004.ply");
  const PoseFile file = poses();
  ASSERT_EQ(file.scans.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const ScanPose& scan = file.scans[i];
    EXPECT_EQ(scan.file, "00" + std::to_string(i) + ".ply");
    EXPECT_EQ(scan.status, i == 4 ? ScanStatus::kReference : ScanStatus::kRegistered);
    EXPECT_EQ(scan.verdict, Verdict::kAccepted);
    EXPECT_FALSE(scan.reason.empty());
    EXPECT_TRUE(is_rigid(scan.T_reference_scan.matrix(), 1e-9));
    std::ifstream text(folder() / "result/transforms" / (scan.file + ".txt"));
    for (int k = 0; k < 16; ++k) {
      double number = 0;
      EXPECT_TRUE(text >> number);
      EXPECT_EQ(number, scan.T_reference_scan.matrix()(k / 4, k % 4)) << scan.file << " " << k;
    }
  }
  EXPECT_TRUE(file.scans[4].T_reference_scan.matrix().isIdentity(0));
  const auto lines = [&](const std::string& name) {
    const std::string text = read_text(folder() / "result/poses" / name);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("poses.csv"), 7);
  EXPECT_EQ(lines("tum.txt"), 6);
  EXPECT_EQ(lines("kitti.txt"), 6);
  EXPECT_GE(lines("graph.g2o"), 6);
}

TEST_F(RegisterTown, WritesEveryPointMovedWithAttributesIndexAndColour) {
  ASSERT_EQ(register_town(guess() + kSmall + Words{"--outliers", "none"}).exit_code, 0);
  const PoseFile file = poses();
  const WholeScan cloud = read_whole(folder() / "result/registered.ply");
  std::size_t at = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const WholeScan raw = read_whole(town_file(file.scans[i].file));
    ASSERT_LE(at + raw.block.size(), cloud.block.size());
    for (std::size_t k = 0; k < raw.block.size(); k += 97) {
      ASSERT_LT((cloud.block.points[at + k] - file.scans[i].T_reference_scan * raw.block.points[k]).norm(), 1e-9);
      ASSERT_EQ(attribute_of<float>(cloud, at + k, "intensity"), attribute_of<float>(raw, k, "intensity"));
      ASSERT_EQ(attribute_of<std::uint16_t>(cloud, at + k, "scan"), i);
      ASSERT_EQ(attribute_of<std::uint8_t>(cloud, at + k, "red"), scan_colour(i)[0]);
    }
    at += raw.block.size();
  }
  EXPECT_EQ(at, cloud.block.size());
}

TEST_F(RegisterTown, DropsOutliersAndPointsThatAreNotFinite) {
  const std::string town = read_text(town_file("000.ply"));
  const std::size_t header = town.find("end_header\n") + 11;
  std::string damaged = town;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::size_t point : {0U, 500U, 26230U}) std::memcpy(damaged.data() + header + 16 * point, &nan, 4);
  // One return 30 km away.
  const float far = 3e4F;
  std::memcpy(damaged.data() + header + 16 * 700, &far, 4);
  folder_.write("000.ply", damaged);
  const RunResult result =
      run(Words{"register", "000.ply"} + town_scans({1, 2, 3, 4, 5}) + guess() + Words{"--out", "result"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(score_town(poses()).count(PoseVerdict::kOk), 6U);
  const nlohmann::json scan = read_json(folder() / "result/report.json")["scans"][0];
  EXPECT_EQ(scan["points"], 26228);
  EXPECT_EQ(scan["dropped_points"], 3);
  const WholeScan cloud = read_whole(folder() / "result/registered.ply");
  std::size_t of_first = 0;
  for (std::size_t k = 0; k < cloud.block.size(); ++k) {
    ASSERT_LT(cloud.block.points[k].norm(), 1000);
    if (attribute_of<std::uint16_t>(cloud, k, "scan") == 0) ++of_first;
  }
  EXPECT_LT(of_first, 26228U);
  EXPECT_GT(of_first, 25000U);  // what is removed are strays, not the scene
}

TEST_F(RegisterTown, ReportsWhatItDid) {
  ASSERT_EQ(register_town(guess() + Words{"--seed", "9", "--threads", "1"} + kSmall).exit_code, 0);
  const nlohmann::json report = read_json(folder() / "result/report.json");
  for (const char* key : {"schema", "program", "version", "command_line", "initial_poses", "options", "scans", "graph",
                          "merges", "adjustment", "links", "stages"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["options"]["seed"], 9);
  EXPECT_EQ(report["options"]["threads"], 1);
  EXPECT_EQ(report["options"]["coarse_voxels"], 4000);
  EXPECT_EQ(report["scans"].size(), 6U);
  EXPECT_GE(report["merges"].size(), 5U);
  for (const auto& merge : report["merges"]) {
    EXPECT_GE(merge["tcm"]["tau"], 0);
    EXPECT_EQ(merge["simplex"]["termination"], "not run") << "inferred poses are adjusted";
    EXPECT_EQ(merge["iterations"]["sum"], merge["iterations"]["simplex_pivots"].get<int>() +
                                              merge["iterations"]["descent_steps"].get<int>() +
                                              merge["iterations"]["annealing_steps"].get<int>());
  }
  EXPECT_EQ(report["adjustment"]["lp_status"], "optimal");
  EXPECT_EQ(report["adjustment"]["lp"]["programs"], 2);
  EXPECT_GT(report["adjustment"]["lp"]["pivots"], 0);
  EXPECT_LT(report["adjustment"]["lp"]["largest_relative_duality_gap"], 1e-7);
  EXPECT_GE(report["links"].size(), 5U);
  for (const auto& link : report["links"]) {
    ASSERT_EQ(link["strength"]["axes"].size(), 6U);
    for (std::size_t k = 1; k < 6; ++k) {
      EXPECT_LE(link["strength"]["axes"][k]["slide_m"], link["strength"]["axes"][k - 1]["slide_m"]);
    }
  }
  for (const auto& stage : report["stages"]) EXPECT_GT(stage["peak_memory_mb"], 0);
  expect_every_number_known(report, "report");
}

// Errors by their standard deviations are about 1: sigma neither boasts nor hides behind caution.
TEST_F(RegisterTown, KnowsHowWrongItIs) {
  ASSERT_EQ(register_town(guess()).exit_code, 0);
  const Truth truth = read_truth(town_file("truth.json"));
  const PoseFile file = poses();
  const nlohmann::json report = read_json(folder() / "result/report.json");
  std::size_t reference = 0;
  while (file.scans.at(reference).status != ScanStatus::kReference) ++reference;
  double squares = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& uncertainty = report["scans"][i]["uncertainty"];
    const auto sigma_m = uncertainty["sigma_position_m"].get<std::vector<double>>();
    const auto sigma_deg = uncertainty["sigma_rotation_deg"].get<std::vector<double>>();
    if (i == reference) {
      EXPECT_EQ(sigma_m, std::vector<double>(3, 0));
      continue;
    }
    const auto c = uncertainty["centre_m"].get<std::vector<double>>();
    const Eigen::Isometry3d error = truth.scans[reference].T_world_scan.inverse() * truth.scans[i].T_world_scan *
                                    file.scans[i].T_reference_scan.inverse();
    const Eigen::Vector3d centre(c[0], c[1], c[2]), shift = error * centre - centre;
    const Eigen::AngleAxisd turn(error.linear());
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      squares += std::pow(shift[k] / sigma_m[at], 2);
      squares += std::pow(turn.angle() * turn.axis()[k] * 57.29577951 / sigma_deg[at], 2);
    }
  }
  // 30 errors, those of a scan correlated: over five seeds the root mean square was 0.9 to 1.1.
  EXPECT_GT(std::sqrt(squares / 30), 0.5);
  EXPECT_LT(std::sqrt(squares / 30), 2);
}

TEST_F(RegisterTown, LeavesAScanOfAnotherPlaceUnregistered) {
  // A ball has nothing of a town.
  std::ostringstream ball;
  for (int k = 0; k < 5000; ++k) {
    const double z = 1 - (2 * k + 1) / 5000.0, angle = 2.399963229728653 * k, r = std::sqrt(1 - z * z);
    ball << 20 * r * std::cos(angle) << ' ' << 20 * r * std::sin(angle) << ' ' << 20 * z << '\n';
  }
  folder_.write("ball.xyz", ball.str());
  const RunResult result =
      run(Words{"register"} + town_scans() + Words{"ball.xyz", "--out", "result"} + guess() + kSmall);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const PoseFile file = poses();
  const auto json = read_json(folder() / "result/poses.json");
  for (std::size_t i = 0; i < 7; ++i) {
    const bool is_ball = i == 6;
    EXPECT_EQ(file.scans[i].status == ScanStatus::kUnregistered, is_ball) << file.scans[i].reason;
    EXPECT_EQ(json["scans"][i]["pose"].is_null(), is_ball);
    EXPECT_EQ(std::filesystem::exists(folder() / "result/transforms" / (file.scans[i].file + ".txt")), !is_ball);
    EXPECT_FALSE(file.scans[i].reason.empty());
  }
  EXPECT_NE(result.err.find("  6  ball.xyz  unregistered"), std::string::npos) << result.err;
  const std::string page = read_text(folder() / "result/report.html");
  EXPECT_NE(page.find("6 of 7 scans are registered."), std::string::npos);
  EXPECT_NE(page.find("6\u00A0<bdi class=\"file\">ball.xyz</bdi>: "), std::string::npos) << "named with the reason";
  EXPECT_EQ(score_town(file).count(PoseVerdict::kOk), 6U);
}

TEST_F(RegisterTown, QuietSaysNothingAndVerboseMore) {
  const RunResult quiet = register_town(guess() + kSmall + Words{"--quiet"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  const RunResult usual = register_town(guess() + kSmall + Words{"--force"});
  const RunResult verbose = register_town(guess() + kSmall + Words{"--force", "--verbose"});
  EXPECT_EQ(usual.out + verbose.out, "");
  EXPECT_NE(usual.err.find("merging"), std::string::npos);
  EXPECT_EQ(usual.err.find("005.ply merged"), std::string::npos);
  EXPECT_NE(verbose.err.find("005.ply merged"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp::test
