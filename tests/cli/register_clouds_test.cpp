// --format, --each, --voxel, --colour: the clouds a registration writes.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "cli_test.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

class RegisterClouds : public CliTest {
 protected:
  RunResult register_to(const std::string& out, const Words& options) const {
    RunResult result = run(Words{"register"} + town_scans({0, 1, 2}) + Words{"--out", out} + options + kSmall);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  }
  std::filesystem::path file(const std::string& name) const { return folder() / name; }
};

TEST_F(RegisterClouds, EveryFormatHasTheSamePoints) {
  register_to("ply", {"--each"});
  const WholeScan expected = read_whole(file("ply/registered.ply"));
  const std::map<std::string, std::string> formats{{"las", "las"}, {"pcd", "pcd"}, {"text", "xyz"}};
  for (const auto& [format, extension] : formats) {
    register_to(format, {"--format", format, "--each", "--threads", "2"});
    EXPECT_FALSE(std::filesystem::exists(file(format + "/registered.ply")));
    const WholeScan cloud = read_whole(file(format + "/registered." + extension));
    ASSERT_EQ(cloud.block.size(), expected.block.size());
    for (std::size_t k = 0; k < cloud.block.size(); ++k) {
      ASSERT_LT((cloud.block.points[k] - expected.block.points[k]).norm(), 1e-5) << format;
    }
    std::size_t num_points = 0;
    for (int i = 0; i < 3; ++i) {
      const WholeScan one = read_whole(file(format + "/scans/00" + std::to_string(i) + ".ply." + extension));
      const WholeScan plain = read_whole(file("ply/scans/00" + std::to_string(i) + ".ply"));
      EXPECT_EQ(plain.attributes, read_whole(town_file("00" + std::to_string(i) + ".ply")).attributes);
      ASSERT_EQ(one.block.size(), plain.block.size());
      for (std::size_t k = 0; k < one.block.size(); ++k) {
        ASSERT_LT((one.block.points[k] - expected.block.points[num_points + k]).norm(), 1e-5) << format;
      }
      num_points += one.block.size();
    }
    EXPECT_EQ(num_points, cloud.block.size());
  }
}

TEST_F(RegisterClouds, VoxelKeepsTheFirstOfItsPoints) {
  register_to("all", {});
  register_to("thin", {"--voxel", "0.4"});
  EXPECT_EQ(read_json(file("thin/report.json"))["options"]["voxel_m"], 0.4);
  const WholeScan all = read_whole(file("all/registered.ply")), thin = read_whole(file("thin/registered.ply"));
  std::set<std::array<double, 3>> voxels;
  std::size_t at = 0;
  for (std::size_t k = 0; k < all.block.size(); ++k) {
    const auto& p = all.block.points[k];
    if (!voxels.insert({std::floor(p.x() / 0.4), std::floor(p.y() / 0.4), std::floor(p.z() / 0.4)}).second) continue;
    ASSERT_LT(at, thin.block.size());
    ASSERT_EQ(thin.block.points[at], p);
    ASSERT_EQ(attribute_of<float>(thin, at, "intensity"), attribute_of<float>(all, k, "intensity"));
    ++at;
  }
  EXPECT_EQ(at, thin.block.size());
  EXPECT_LT(at, all.block.size() / 2);
}

TEST_F(RegisterClouds, AnUnregisteredScanHasNoFileAndNoLine) {
  folder_.write("alone.xyz", [] {
    std::string text;
    for (int i = 0; i < 3000; ++i) {
      text += std::to_string(std::sin(i) * 5) + " " + std::to_string(std::cos(7.0 * i) * 5) + " " +
              std::to_string(std::sin(3.0 * i * i)) + "\n";
    }
    return text;
  }());
  const RunResult result = run(Words{"register"} + town_scans({0, 1, 2}) +
                               Words{"alone.xyz", "--out", "out", "--each", "--format", "las"} + kSmall);
  ASSERT_EQ(result.exit_code, 3) << result.err;
  EXPECT_TRUE(std::filesystem::exists(file("out/scans/002.ply.las")));
  EXPECT_FALSE(std::filesystem::exists(file("out/scans/alone.xyz.las")));
  const std::string tum = read_text(file("out/poses/tum.txt")), csv = read_text(file("out/poses/poses.csv"));
  EXPECT_EQ(std::count(tum.begin(), tum.end(), '\n'), 3);
  EXPECT_NE(csv.find("3,alone.xyz,unregistered,"), std::string::npos);
}

TEST_F(RegisterClouds, AResultInAFolderOfScansIsNoScan) {
  std::filesystem::create_directory(file("scans"));
  for (const char* const name : {"000.ply", "001.ply"}) {
    std::filesystem::copy_file(town_file(name), file("scans") / name);
  }
  for (int round = 0; round < 2; ++round) {
    const RunResult result =
        run(Words{"register", "scans", "--out", "scans/result", "--force", "--format", "las"} + kSmall);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_pose_file(file("scans/result/poses.json")).scans.size(), 2U);
  }
}

TEST_F(RegisterClouds, RefusesOptionsThatMakeNoSense) {
  const Words start = Words{"register"} + town_scans({0, 1}) + Words{"--out", "out"};
  expect_refusal(start + Words{"--format", "laz"}, 1, {"--format 'laz'", "ply, las, pcd, text"});
  expect_refusal(start + Words{"--colour", "red"}, 1, {"--colour 'red'", "keep, scan"});
  expect_refusal(start + Words{"--voxel", "-1"}, 1, {"--voxel", "-1", "unit of the scans"});
  expect_refusal(start + Words{"--voxel", "5cm"}, 1, {"--voxel", "5cm", "unit of the scans"});
  expect_refusal(start + Words{"--voxel", "nan"}, 1, {"--voxel", "unit of the scans"});
}

}  // namespace
}  // namespace tcm_icp::test
