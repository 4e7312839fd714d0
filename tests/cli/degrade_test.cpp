// tcm-icp degrade as a user meets it.

#include "cli_test.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

class Degrade : public CliTest {
 protected:
  Words degrade(const Words& options) const {
    return Words{"degrade"} + town_scans({0, 1}) + Words{"--out", "worse"} + options;
  }
};

TEST_F(Degrade, WritesScansOfTheSameNamesAndSaysWhatItDid) {
  const RunResult result = run(degrade({"--noise", "0.2", "--sigma", "0.05", "--remove", "0.5", "--isolated", "0.01"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto report = read_json(folder() / "worse/degraded.json");
  ASSERT_EQ(report["scans"].size(), 2u);
  const std::size_t before = read_whole(town_file("001.ply")).block.size();
  const WholeScan after = read_whole(folder() / "worse/001.ply");
  EXPECT_EQ(report["scans"][1]["file"], "001.ply");
  EXPECT_EQ(report["scans"][1]["points_before"], before);
  EXPECT_EQ(report["scans"][1]["points_after"], after.block.size());
  EXPECT_EQ(report["scans"][1]["steps"][0]["kind"], "removal");
  EXPECT_EQ(report["scans"][1]["steps"][1]["changed"], std::lround(0.2 * std::ceil(before / 2.0 - 0.5)));
  EXPECT_EQ(after.attributes, read_whole(town_file("001.ply")).attributes);       // intensity
  EXPECT_EQ(attribute_of<float>(after, after.block.size() - 1, "intensity"), 0);  // added
  EXPECT_NE(result.out.find("001.ply  " + std::to_string(before)), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("sigma 0.05"), std::string::npos) << result.out;
}

TEST_F(Degrade, TheSameSeedGivesTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(run(degrade({"--blur", "0.1", "--occlusion", "0.2", "--threads", "1"})).exit_code, 0);
  const std::string first = read_text(folder() / "worse/000.ply");
  ASSERT_EQ(run(degrade({"--blur", "0.1", "--occlusion", "0.2", "--threads", "2", "--force"})).exit_code, 0);
  EXPECT_EQ(read_text(folder() / "worse/000.ply"), first);
  ASSERT_EQ(run(degrade({"--blur", "0.1", "--occlusion", "0.2", "--seed", "2", "--force"})).exit_code, 0);
  EXPECT_NE(read_text(folder() / "worse/000.ply"), first);
}

TEST_F(Degrade, RefusesWhatCannotBeDone) {
  expect_refusal(degrade({}), 1, {"nothing to do", "--noise"});
  expect_refusal(degrade({"--noise", "2"}), 1, {"noise_share", "2"});
  expect_refusal(degrade({"--noise", "0.1", "--threads", "-1"}), 1, {"--threads"});
  expect_refusal({"degrade", "--out", "worse", "--noise", "0.1"}, 1, {"no scan is named"});
  expect_refusal(Words{"degrade"} + town_scans({0}) + Words{"--noise", "0.1"}, 1, {"out"});
  expect_refusal(Words{"degrade", "none.ply", "--out", "worse", "--noise", "0.1"}, 2, {"none.ply", "no such file"});
  expect_refusal(Words{"degrade"} + town_scans({0, 0}) + Words{"--out", "worse", "--noise", "0.1"}, 2,
                 {"000.ply", "named twice"});
  folder_.write("a.xyz", "0 0 0\n1 1 1\n");
  expect_refusal({"degrade", "a.xyz", "--out", "worse", "--noise", "0.1"}, 2, {"a.xyz", "at least 3"});
  std::filesystem::create_directory(folder() / "photos");
  folder_.write("photos/a", "precious");
  expect_refusal(Words{"degrade"} + town_scans({0}) + Words{"--out", "photos", "--force", "--noise", "0.1"}, 4,
                 {"photos", "not an earlier result"});
}

TEST_F(Degrade, AFullDiskLeavesNothing) {
  RunSettings full;
  full.max_file_bytes = 100'000;
  expect_refusal(degrade({"--noise", "0.1"}), 4, {"000.ply", "cannot be written"}, full);
}

}  // namespace
}  // namespace tcm_icp::test
