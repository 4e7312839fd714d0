// The same scans in other formats, under other names: the same poses, named as they were given.

#include <zlib.h>

#include "cli_test.hpp"
#include "io/e57_file.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

/// Coordinates of a scan of the town as doubles, those of one axis one behind the other.
E57Parts as_e57(std::size_t i) {
  const Points points = read_whole(town_file("00" + std::to_string(i) + ".ply"), ReadAttributes::kNo).block.points;
  E57Parts scan;
  scan.num_points = points.size();
  scan.num_packets = points.size() / 1000 + 1;
  for (int axis = 0; axis < 3; ++axis) {
    std::string bytes;
    for (const auto& p : points) bytes += bytes_of(p[axis]);
    scan.columns.push_back({std::string("cartesian") + static_cast<char>('X' + axis), "type=\"Float\"", bytes});
  }
  return scan;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string pose_xml(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  const auto t = T.translation();
  return "<pose><rotation><w>" + number(q.w()) + "</w><x>" + number(q.x()) + "</x><y>" + number(q.y()) + "</y><z>" +
         number(q.z()) + "</z></rotation><translation><x>" + number(t.x()) + "</x><y>" + number(t.y()) + "</y><z>" +
         number(t.z()) + "</z></translation></pose>";
}

class RegisterFormats : public CliTest {
 protected:
  PoseFile registered(const Words& scans, const std::string& out) const {
    const RunResult result = run(Words{"register"} + scans + Words{"--out", out, "--outliers", "none"} + kSmall);
    EXPECT_LE(result.exit_code, 3) << result.err;
    EXPECT_GE(result.exit_code, 0) << result.err;
    return read_pose_file(folder() / out / "poses.json");
  }
};

void expect_same_poses(const PoseFile& a, const PoseFile& b) {
  ASSERT_EQ(a.scans.size(), b.scans.size());
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_EQ(a.scans[i].status, b.scans[i].status) << i;
    EXPECT_EQ(a.scans[i].T_reference_scan.matrix(), b.scans[i].T_reference_scan.matrix()) << i;
  }
}

TEST_F(RegisterFormats, OneE57FileOfAllScansGivesTheSamePoses) {
  const PoseFile plain = registered(town_scans({0, 1, 2}), "plain");
  folder_.write("town.e57", e57_file({as_e57(0), as_e57(1), as_e57(2)}));
  const PoseFile e57 = registered({"town.e57"}, "e57");
  expect_same_poses(plain, e57);
  EXPECT_EQ(e57.scans.at(1).file, "town.e57#2");
  EXPECT_TRUE(std::filesystem::exists(folder() / "e57/transforms" / (e57.reference + ".txt")));
  const PoseFile two = registered({"town.e57#1", "town.e57#2", "--reference", "town.e57#2"}, "two");
  EXPECT_EQ(two.reference, "town.e57#2");
}

TEST_F(RegisterFormats, AFolderForEachSetUpGivesTheSamePoses) {
  const PoseFile plain = registered(town_scans({0, 1, 2}), "plain");
  for (int i = 0; i < 3; ++i) {
    const auto setup = folder() / "project" / ("Setup" + std::to_string(9 + i));  // 9, 10, 11
    std::filesystem::create_directories(setup);
    const std::string ply = read_text(town_file("00" + std::to_string(i) + ".ply"));
    const gzFile file = gzopen((setup / "scan.ply.gz").c_str(), "wb1");
    ASSERT_EQ(gzwrite(file, ply.data(), static_cast<unsigned>(ply.size())), static_cast<int>(ply.size()));
    ASSERT_EQ(gzclose(file), Z_OK);
  }
  const PoseFile setups = registered({"project"}, "setups");
  expect_same_poses(plain, setups);
  EXPECT_EQ(setups.scans.at(0).file, "Setup9/scan.ply.gz");
  EXPECT_EQ(setups.scans.at(1).file, "Setup10/scan.ply.gz");
  EXPECT_TRUE(std::filesystem::exists(folder() / "setups/transforms/Setup10" / "scan.ply.gz.txt") ||
              setups.scans[1].status == ScanStatus::kUnregistered);
  // The result goes by its names into the next command.
  folder_.write("truth.json",
                R"({"scans": [{"file": "Setup9/scan.ply.gz", "pose": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]})");
  const RunResult evaluated =
      run({"evaluate", "--scans", "project", "--poses", "setups/poses.json", "--truth", "truth.json"});
  if (setups.reference == "Setup9/scan.ply.gz") {
    EXPECT_EQ(evaluated.exit_code, 0) << evaluated.err;
  }
  const RunResult init = run({"inspect", "project", "--init", "setups/poses.json", "-q"});
  EXPECT_EQ(init.exit_code, 0) << init.err;
  EXPECT_NE(init.out.find("Setup11/scan.ply.gz"), std::string::npos);
}

TEST_F(RegisterFormats, PosesInHeadersAreInitialPosesOnRequestOnly) {
  const Truth truth = read_truth(town_file("truth.json"));
  std::vector<E57Parts> scans{as_e57(0), as_e57(1)};
  for (std::size_t i = 0; i < 2; ++i) scans[i].pose = pose_xml(truth.scans[i].T_world_scan);
  folder_.write("town.e57", e57_file(scans));
  nlohmann::json guess;
  for (std::size_t i = 0; i < 2; ++i) {
    nlohmann::json entry = read_json(town_file("truth.json"))["scans"][i];
    entry["file"] = "town.e57#" + std::to_string(i + 1);
    guess["scans"].push_back(entry);
  }
  folder_.write("guess.json", guess.dump());
  // The measures of a pair are those at the initial poses.
  const auto inspected = [&](const Words& options) {
    const RunResult result = run(Words{"inspect", "town.e57", "-q"} + kSmall + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  const std::string with_headers = inspected({"--init", "headers"});
  EXPECT_EQ(with_headers, inspected({"--init", "guess.json"}));
  EXPECT_NE(with_headers, inspected({}));
  expect_refusal(Words{"register"} + town_scans({0, 1}) + Words{"--init", "headers", "--out", "none"}, 1,
                 {"--init headers", "no scan has a pose"});
}

}  // namespace
}  // namespace tcm_icp::test
