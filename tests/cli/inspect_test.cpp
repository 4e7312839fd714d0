// tcm-icp inspect, as a user runs it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_test.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

using Json = nlohmann::json;

constexpr int kNumTownScans = 6;

const Words kTownAndGuess = town_scans() + Words{"--init", town_file("initial_poses.json").string()};
const Words kFirst = town_scans({0});

class Inspect : public CliTest {
 protected:
  Json inspect(const Words& arguments) const {
    const RunResult result = run(Words{"inspect", "--json"} + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out);
  }
};

void expect_symmetric(const Json& matrix) {
  ASSERT_EQ(matrix.size(), kNumTownScans);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    ASSERT_EQ(matrix[i].size(), matrix.size());
    EXPECT_TRUE(matrix[i][i].is_null());
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(matrix[i][j], matrix[j][i]) << i << ", " << j;
      EXPECT_GT(matrix[i][j].get<double>(), 0) << i << ", " << j;
    }
  }
}

TEST_F(Inspect, MeasuresEveryPairBothWaysAlike) {
  const Json json = inspect(kTownAndGuess);
  expect_symmetric(json["tcm"]["paper_m4"]);
  expect_symmetric(json["tcm"]["robust_m2"]);
}

// Stations follow a path, so of all pairs the two ends of it share least; the guess is near enough to see that.
TEST_F(Inspect, FindsTheNearestStationMoreCompatibleThanTheFarthest) {
  const Json robust = inspect(kTownAndGuess)["tcm"]["robust_m2"];
  EXPECT_LT(robust[0][1].get<double>(), robust[0][5].get<double>() / 2);
}

TEST_F(Inspect, CountsWhatTheFilesHold) {
  const Json json = inspect(kTownAndGuess);
  ASSERT_EQ(json["scans"].size(), kNumTownScans);
  for (int i = 0; i < kNumTownScans; ++i) {
    const Json& scan = json["scans"][static_cast<std::size_t>(i)];
    const WholeScan whole = read_whole(town_file(scan["file"]), ReadAttributes::kNo);
    EXPECT_EQ(scan["points"], whole.block.size());
    EXPECT_EQ(scan["dropped_points"], 0);
    EXPECT_LE(scan["working_points"].get<std::size_t>() + scan["outliers"]["working_points_removed"].get<std::size_t>(),
              whole.block.size());
    std::size_t inside = 0;  // voxel means lie inside the box of the points they stand for
    for (const auto& p : whole.block.points) {
      bool in = true;
      for (int axis = 0; axis < 3; ++axis) {
        in = in && p[axis] >= scan["box_min_m"][static_cast<std::size_t>(axis)].get<double>() - 1e-9 &&
             p[axis] <= scan["box_max_m"][static_cast<std::size_t>(axis)].get<double>() + 1e-9;
      }
      inside += in ? 1 : 0;
    }
    EXPECT_GT(static_cast<double>(inside), 0.99 * static_cast<double>(whole.block.size()));
  }
}

TEST_F(Inspect, BuildsTheGraphAndReferenceOfThePaperProfile) {
  // Of the profile that compares scans where they lie; robust has its graph from links.
  const Json graph = inspect(kTownAndGuess + Words{"--profile", "paper"})["graph"];
  const RunResult outcome =
      run(Words{"register"} + kTownAndGuess + Words{"--profile", "paper", "--refinement", "none", "--out", "paper"});
  ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  const Json report = read_json(folder() / "paper" / "report.json");
  EXPECT_EQ(report["options"]["paper"]["matches"], "mutual");
  EXPECT_EQ(graph, report["graph"]);
  EXPECT_EQ(graph["reference"], read_json(folder() / "paper" / "poses.json")["reference"]);
}

TEST_F(Inspect, SaysTheSameWhateverTheNumberOfThreads) {
  Json one = inspect(kTownAndGuess + Words{"--threads", "1"}), four = inspect(kTownAndGuess + Words{"--threads", "4"});
  one.erase("command_line");
  four.erase("command_line");
  EXPECT_EQ(one, four);
}

TEST_F(Inspect, PrintsTablesWithTheSameReference) {
  const RunResult outcome = run(Words{"inspect"} + kTownAndGuess);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string reference = inspect(kTownAndGuess)["graph"]["reference"];
  EXPECT_NE(outcome.out.find("reference: " + reference + "\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("TCM as printed"), std::string::npos);
  EXPECT_NE(outcome.out.find("26231"), std::string::npos) << "points of 000.ply";
}

TEST_F(Inspect, TellsOfOneScanWhatThereIs) {
  const Json json = inspect(kFirst);
  EXPECT_EQ(json["scans"].size(), 1);
  EXPECT_TRUE(json["tcm"].is_null());
  EXPECT_TRUE(json["graph"].is_null());
  const RunResult text = run(Words{"inspect"} + kFirst);
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_EQ(text.out.find("TCM"), std::string::npos);
}

TEST_F(Inspect, KeepsEveryPointWhereNoOutliersAreAskedFor) {
  const Json none = inspect(kFirst + Words{"--outliers", "none"})["scans"][0];
  EXPECT_EQ(none["outliers"]["working_points_removed"], 0);
  EXPECT_GT(none["working_points"], inspect(kFirst)["scans"][0]["working_points"]);
}

TEST_F(Inspect, RefusesWhatItCannotReadOrDo) {
  const std::string broken = folder_.write("broken.ply", "ply\nformat ascii 1.0\n").string();
  const Words inspect{"inspect"};
  expect_refusal(inspect + Words{"missing.ply"}, 2, {"missing.ply"});
  expect_refusal(inspect + Words{broken}, 2, {"broken.ply"});
  expect_refusal(inspect + kFirst + kFirst, 2, {"named twice"});
  expect_refusal(inspect + kFirst + Words{"--init", "missing.json"}, 2, {"missing.json"});
  expect_refusal(inspect, 1, {"no scan"});
  expect_refusal(inspect + Words{"--nonsense"} + kFirst, 1, {"--nonsense"});
  expect_refusal(inspect + Words{"--threads", "-1"} + kFirst, 1, {"--threads"});
  expect_refusal(inspect + Words{"--outliers", "nonsense"} + kFirst, 1, {"kmeans, distance, lof, none"});
  expect_refusal(inspect + Words{"--out", "result"} + kFirst, 1, {"--out"});
}

}  // namespace
}  // namespace tcm_icp::test
