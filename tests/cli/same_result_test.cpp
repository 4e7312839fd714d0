// The same input gives the same result: for any number of threads, from run to run, for any order of the files, and up
// to rounding for any place on earth.

#include <algorithm>

#include "cli_test.hpp"
#include "io/ply_text.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

class SameResult : public CliTest {
 protected:
  int run_to(const std::string& out, const Words& arguments) const {
    const RunResult result = run(Words{"register", "--quiet", "--out", out} + arguments + kSmall);
    EXPECT_EQ(result.err, "");
    return result.exit_code;
  }
  Words town() const { return town_scans() + Words{"--init", town_file("initial_poses.json").string()}; }

  void expect_same_files(const std::string& a, const std::string& b) const {
    for (const char* file : {"poses.json", "registered.ply", "transforms/000.ply.txt"}) {
      const std::string content = read_text(folder() / a / file);
      EXPECT_FALSE(content.empty()) << file;
      EXPECT_TRUE(content == read_text(folder() / b / file)) << a << " and " << b << " differ in " << file;
    }
  }
  PoseFile poses(const std::string& out) const { return read_pose_file(folder() / out / "poses.json"); }
};

TEST_F(SameResult, ForOneThreadAndTwoAndFromRunToRun) {
  for (const char* profile : {"robust", "paper"}) {
    const std::string name(profile);
    const Words arguments = town() + Words{"--profile", profile};
    EXPECT_EQ(run_to(name + "1", arguments + Words{"--threads", "1"}), 0);
    EXPECT_EQ(run_to(name + "2", arguments + Words{"--threads", "2"}), 0);
    EXPECT_EQ(run_to(name + "again", arguments + Words{"--threads", "2"}), 0);
    expect_same_files(name + "1", name + "2");
    expect_same_files(name + "2", name + "again");
  }
}

// With the least memory that may be asked for, what is prepared of scans lies in a file and leaves memory all the time.
TEST_F(SameResult, ForAnyLimitOfTheMemory) {
  EXPECT_EQ(run_to("none", town() + Words{"--memory", "none"}), 0);
  EXPECT_EQ(run_to("least", town() + Words{"--memory", "64M"}), 0);
  expect_same_files("none", "least");
}

TEST_F(SameResult, ForAnyOrderOfTheFiles) {
  const Words guess{"--init", town_file("initial_poses.json").string()};
  EXPECT_EQ(run_to("forwards", town_scans() + guess), 0);
  EXPECT_EQ(run_to("mixed", town_scans({3, 5, 1, 0, 4, 2}) + guess), 0);
  EXPECT_EQ(poses("forwards").reference, poses("mixed").reference);
  for (const char* file : {"transforms/000.ply.txt", "transforms/003.ply.txt", "transforms/005.ply.txt"}) {
    const std::string content = read_text(folder() / "forwards" / file);
    EXPECT_FALSE(content.empty()) << file;
    EXPECT_EQ(content, read_text(folder() / "mixed" / file)) << file;
  }
}

// Both solvers find an optimum of the same programs; where it is not unique they may end at different ones, far below
// the accuracy of the poses.
TEST_F(SameResult, ForBothSolversUpToTheAccuracyOfThePoses) {
  const Words arguments = town() + Words{"--lp.coarse-points", "200", "--lp.fine-points", "200"};
  EXPECT_EQ(run_to("glpk", arguments), 0);
  EXPECT_EQ(run_to("cgal", arguments + Words{"--solver", "cgal"}), 0);
  EXPECT_EQ(read_json(folder() / "cgal/report.json")["options"]["solver"], "cgal");
  const PoseFile a = poses("glpk"), b = poses("cgal");
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_EQ(a.scans[i].status, b.scans[i].status);
    EXPECT_LT(difference_m(a.scans[i].T_reference_scan, b.scans[i].T_reference_scan, 50), 0.05) << i;
  }
}

// Survey coordinates: each file 5,000 km from its origin, in a direction of its own.
TEST_F(SameResult, FarFromTheOrigin) {
  const std::vector<Eigen::Vector3d> offsets{{5e6, 0, 0},     {4e6, 3e6, 100},  {-5e6, 1e5, 0},
                                             {0, 5e6, -1000}, {3e6, -4e6, 500}, {0, 0, 0}};
  const Truth truth = read_truth(town_file("truth.json"));
  const auto guess = read_json(town_file("initial_poses.json"));
  nlohmann::json far_guess{{"scans", nlohmann::json::array()}};
  Words far_scans;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const WholeScan scan = read_whole(town_file(truth.scans[i].file), ReadAttributes::kNo);
    std::string content = ply_header("binary_little_endian", xyz_vertices(scan.block.size(), "double"));
    for (const auto& p : scan.block.points) {
      for (int axis = 0; axis < 3; ++axis) content += bytes_of(p[axis] + offsets[i][axis]);
    }
    folder_.write(truth.scans[i].file, content);
    far_scans.push_back(truth.scans[i].file);
    auto rows = guess["scans"][i]["pose"];
    for (int r = 0; r < 3; ++r) {
      double shift = rows[r][3];
      for (int c = 0; c < 3; ++c) shift -= rows[r][c].get<double>() * offsets[i][c];
      rows[r][3] = shift;
    }
    far_guess["scans"].push_back({{"file", truth.scans[i].file}, {"pose", rows}});
  }
  folder_.write("guess.json", far_guess.dump());
  const Words reference{"--reference", "002.ply"};
  EXPECT_EQ(run_to("near", town() + reference + Words{"--outliers", "none"}), 0);
  EXPECT_EQ(run_to("far", far_scans + Words{"--init", "guess.json"} + reference + Words{"--outliers", "none"}), 0);

  const PoseFile near = poses("near"), far = poses("far");
  const WholeScan cloud = read_whole(folder() / "far/registered.ply", ReadAttributes::kNo);
  const WholeScan near_cloud = read_whole(folder() / "near/registered.ply", ReadAttributes::kNo);
  ASSERT_EQ(cloud.block.size(), near_cloud.block.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < far.scans.size(); ++i) {
    ASSERT_EQ(far.scans[i].status, near.scans[i].status);
    // Raw coordinates back to those of the town: both offsets are taken off.
    const Eigen::Isometry3d T =
        Eigen::Translation3d(-offsets[2]) * far.scans[i].T_reference_scan * Eigen::Translation3d(offsets[i]);
    // A double holds 5,000 km to a nanometre; a rotation's last digits move the far origin by some of them.
    EXPECT_LT(difference_m(T, near.scans[i].T_reference_scan, 50), 1e-4) << far.scans[i].file;
    const std::size_t size = read_whole(town_file(far.scans[i].file), ReadAttributes::kNo).block.size();
    for (std::size_t k = 0; k < size; k += 101) {
      ASSERT_LT((cloud.block.points[at + k] - offsets[2] - near_cloud.block.points[at + k]).norm(), 1e-4);
    }
    at += size;
  }
}

}  // namespace
}  // namespace tcm_icp::test
