// --work: a run that was killed goes on where it was, to the same bits, and does no step twice.

#include <algorithm>
#include <map>
#include <random>
#include <sstream>

#include "cli_test.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

namespace fs = std::filesystem;

class WorkFolder : public CliTest {
 protected:
  RunResult register_to(const std::string& out, const Words& more, const RunSettings& settings = {}) const {
    return run(Words{"register", "--out", out} + town_scans() + more + kSmall, settings);
  }
  /// How often each step was done, by key.
  std::map<std::string, int> steps_done() const {
    std::map<std::string, int> out;
    for (const auto& file : fs::directory_iterator(folder() / "work/log")) {
      std::istringstream lines(read_text(file.path()));
      std::string time, kind, key, rest;
      while (lines >> time >> kind >> key && std::getline(lines, rest)) ++out[key];
    }
    return out;
  }
  std::size_t num_steps_kept() const {
    const auto all = everything_in(folder() / "work/steps");
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const fs::path& path) { return fs::is_regular_file(path); }));
  }
  void expect_same_result(const std::string& a, const std::string& b) const {
    for (const char* file : {"poses.json", "registered.ply"}) {
      const std::string content = read_text(folder() / a / file);
      EXPECT_FALSE(content.empty()) << file;
      EXPECT_TRUE(content == read_text(folder() / b / file)) << a << " and " << b << " differ in " << file;
    }
  }
};

TEST_F(WorkFolder, GivesTheSameBitsAsNoneAndDoesNothingASecondTime) {
  ASSERT_EQ(register_to("plain", {}).exit_code, 0);
  ASSERT_EQ(register_to("kept", {"--work", "work"}).exit_code, 0);
  expect_same_result("plain", "kept");
  const auto done = steps_done();
  EXPECT_GT(done.size(), 6U + 6 + 5);  // samples, viewpoints, pairs
  EXPECT_EQ(num_steps_kept(), done.size());
  ASSERT_EQ(register_to("again", {"--work", "work", "--threads", "1"}).exit_code, 0);
  expect_same_result("plain", "again");
  EXPECT_EQ(steps_done(), done);
}

TEST_F(WorkFolder, KeepsOutliersOfEveryMethod) {
  for (const char* method : {"distance", "lof"}) {
    const std::string name(method);
    const Words options{"--outliers", method, "--work", "work"};
    ASSERT_EQ(register_to("first-" + name, options).exit_code, 0);
    ASSERT_EQ(register_to("again-" + name, options).exit_code, 0);
    expect_same_result("first-" + name, "again-" + name);
  }
}

TEST_F(WorkFolder, KeepsResolutionsWhereAScanIsAdded) {
  const Words work{"--work", "work"};
  ASSERT_EQ(run(Words{"register", "--out", "five"} + town_scans({0, 1, 2, 3, 4}) + work + kSmall).exit_code, 0);
  const auto before = steps_done();
  ASSERT_EQ(register_to("six", work).exit_code, 0);
  const auto five = read_json(folder() / "five/report.json"), six = read_json(folder() / "six/report.json");
  EXPECT_EQ(five["coarse_voxel_m"], six["coarse_voxel_m"]);
  std::string said;
  for (const auto& warning : six["warnings"]) said += warning;
  EXPECT_NE(said.find("the resolutions are kept from the 5 scans that"), std::string::npos) << said;
  std::map<std::string, int> kinds;
  for (const auto& file : fs::directory_iterator(folder() / "work/log")) {
    std::istringstream lines(read_text(file.path()));
    std::string time, kind, rest;
    while (lines >> time >> kind && std::getline(lines, rest)) ++kinds[kind];
  }
  EXPECT_EQ(kinds["samples"], 6);
  EXPECT_EQ(kinds["height-maps"], 15);  // ten pairs of five scans, and those of the sixth
  for (const auto& [key, times] : steps_done()) EXPECT_EQ(times, 1) << key;
}

TEST_F(WorkFolder, GoesOnWhereARunWasKilled) {
  ASSERT_EQ(register_to("plain", {}).exit_code, 0);
  std::mt19937 random(1);
  RunSettings settings;
  int num_killed = 0;
  for (; num_killed < 100; ++num_killed) {
    // Longer and longer: on a busy machine reading what is there and writing the result take seconds, too.
    settings.kill_after_ms = std::uniform_int_distribution<int>(1, 100 + 50 * num_killed)(random);
    const RunResult result = register_to("killed", {"--work", "work"}, settings);
    if (result.signal == 0) {
      ASSERT_EQ(result.exit_code, 0) << result.err;
      break;
    }
    if (fs::exists(folder() / "killed")) break;  // behind its last step: a result is there whole or not at all
  }
  EXPECT_GT(num_killed, 0);
  EXPECT_TRUE(fs::exists(folder() / "killed")) << num_killed << " runs were killed";
  expect_same_result("plain", "killed");
  for (const auto& [key, times] : steps_done()) EXPECT_EQ(times, 1) << key;
}

TEST_F(WorkFolder, IsKeyedByWhatFilesHoldAndNotByTheirNames) {
  fs::create_directory(folder() / "copies");
  Words copies;
  for (int i = 0; i < 6; ++i) {
    copies.push_back((folder() / "copies" / ("scan" + std::to_string(5 - i) + ".ply")).string());
    fs::copy_file(town_file("00" + std::to_string(i) + ".ply"), copies.back());
  }
  ASSERT_EQ(register_to("first", {"--work", "work"}).exit_code, 0);
  const auto done = steps_done();
  ASSERT_EQ(run(Words{"register", "--out", "renamed", "--work", "work"} + copies + kSmall).exit_code, 0);
  EXPECT_EQ(steps_done(), done);
  // Another option of the samples makes all anew.
  ASSERT_EQ(register_to("other", {"--work", "work", "--seed", "7"}).exit_code, 0);
  EXPECT_GT(steps_done().size(), done.size() + 12);
}

TEST_F(WorkFolder, DoesADamagedStepAgain) {
  ASSERT_EQ(register_to("first", {"--work", "work"}).exit_code, 0);
  for (const auto& path : everything_in(folder() / "work/steps")) {
    if (fs::is_regular_file(path)) fs::resize_file(path, fs::file_size(path) - 1);
  }
  const RunResult result = register_to("second", {"--work", "work"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("is damaged; this step is done again"), std::string::npos);
  expect_same_result("first", "second");
}

TEST_F(WorkFolder, RefusesWhatItCannotServe) {
  expect_refusal(Words{"register", "--out", "new", "--work", "work", "--method", "icp"} + town_scans(), 1,
                 {"--work", "--method tcm"});
  folder_.write("file", "");
  expect_refusal(Words{"register", "--out", "new", "--work", "file"} + town_scans(), 4, {"file", "cannot be written"});
}

}  // namespace
}  // namespace tcm_icp::test
