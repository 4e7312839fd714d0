// tcm-icp inspect, as a user runs it.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/temp_files.hpp"

namespace tcm_icp::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kNumTownScans = 6;

class Inspect : public testing::Test {
 protected:
  struct Outcome {
    int exit_code = -1;
    std::string out, err;
  };

  Outcome run(const std::string& arguments) const {
    const fs::path out = folder_.path() / "out", err = folder_.path() / "err";
    const std::string line =
        "'" TCM_ICP_EXECUTABLE "' " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
  }

  static std::string town(int scan) { return " '" TCM_ICP_TOWN "/00" + std::to_string(scan) + ".ply'"; }
  static std::string town() {
    std::string all;
    for (int i = 0; i < kNumTownScans; ++i) all += town(i);
    return all + " --init '" TCM_ICP_TOWN "/initial_poses.json'";
  }

  Json run_json(const std::string& arguments) const {
    const Outcome outcome = run("inspect --json" + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  TempFolder folder_;
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
  const Json json = run_json(town());
  expect_symmetric(json["tcm"]["paper_m4"]);
  expect_symmetric(json["tcm"]["robust_m2"]);
}

// Stations follow a path, so of all pairs the two ends of it share least; the guess is near enough to see that.
TEST_F(Inspect, FindsTheNearestStationMoreCompatibleThanTheFarthest) {
  const Json robust = run_json(town())["tcm"]["robust_m2"];
  EXPECT_LT(robust[0][1].get<double>(), robust[0][5].get<double>() / 2);
}

TEST_F(Inspect, CountsWhatTheFilesHold) {
  const Json json = run_json(town());
  ASSERT_EQ(json["scans"].size(), kNumTownScans);
  for (int i = 0; i < kNumTownScans; ++i) {
    const Json& scan = json["scans"][static_cast<std::size_t>(i)];
    const WholeScan whole = read_whole(fs::path(TCM_ICP_TOWN) / scan["file"].get<std::string>(), ReadAttributes::kNo);
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

TEST_F(Inspect, BuildsTheGraphAndReferenceOfRegister) {
  for (const std::string profile : {"robust", "paper"}) {
    const Json graph = run_json(town() + " --profile " + profile)["graph"];
    const fs::path result = folder_.path() / profile;
    // Small fits: what comes before them is what is compared.
    const Outcome outcome =
        run("register" + town() + " --profile " + profile + " --refinement none --out '" + result.string() + "'");
    ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
    const Json report = Json::parse(read_text(result / "report.json"));
    EXPECT_EQ(graph, report["graph"]) << profile;
    EXPECT_EQ(graph["reference"], Json::parse(read_text(result / "poses.json"))["reference"]) << profile;
  }
}

TEST_F(Inspect, SaysTheSameWhateverTheNumberOfThreads) {
  Json one = run_json(town() + " --threads 1"), four = run_json(town() + " --threads 4");
  one.erase("command_line");
  four.erase("command_line");
  EXPECT_EQ(one, four);
}

TEST_F(Inspect, PrintsTablesWithTheSameReference) {
  const Outcome outcome = run("inspect" + town());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string reference = run_json(town())["graph"]["reference"];
  EXPECT_NE(outcome.out.find("reference: " + reference + "\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("TCM as printed"), std::string::npos);
  EXPECT_NE(outcome.out.find("26231"), std::string::npos) << "points of 000.ply";
}

TEST_F(Inspect, TellsOfOneScanWhatThereIs) {
  const Json json = run_json(town(0));
  EXPECT_EQ(json["scans"].size(), 1);
  EXPECT_TRUE(json["tcm"].is_null());
  EXPECT_TRUE(json["graph"].is_null());
  const Outcome text = run("inspect" + town(0));
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_EQ(text.out.find("TCM"), std::string::npos);
}

TEST_F(Inspect, KeepsEveryPointWhereNoOutliersAreAskedFor) {
  const Json none = run_json(town(0) + " --outliers none")["scans"][0];
  EXPECT_EQ(none["outliers"]["working_points_removed"], 0);
  EXPECT_GT(none["working_points"], run_json(town(0))["scans"][0]["working_points"]);
}

TEST_F(Inspect, RefusesWhatItCannotReadOrDo) {
  const auto broken = folder_.write("broken.ply", "ply\nformat ascii 1.0\n");
  const std::pair<std::string, int> cases[] = {{"inspect missing.ply", 2},
                                               {"inspect '" + broken.string() + "'", 2},
                                               {"inspect" + town(0) + town(0), 2},
                                               {"inspect" + town(0) + " --init missing.json", 2},
                                               {"inspect", 1},
                                               {"inspect --nonsense" + town(0), 1},
                                               {"inspect --threads -1" + town(0), 1},
                                               {"inspect --outliers nonsense" + town(0), 1},
                                               {"inspect --out result" + town(0), 1}};
  for (const auto& [arguments, code] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, code) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find("tcm-icp: "), std::string::npos) << arguments;
  }
}

}  // namespace
}  // namespace tcm_icp::test
