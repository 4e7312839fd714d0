// Ctrl-C: exit code 130, a word about it, and nothing left behind, whatever the program was doing.

#include <algorithm>

#include "cli_test.hpp"

namespace tcm_icp::test {
namespace {

class Interrupt : public CliTest {
 protected:
  void expect_interrupted(const Words& arguments, const std::string& stage) const {
    RunSettings settings;
    settings.interrupt_at = stage;
    SCOPED_TRACE("interrupted while " + stage);
    expect_refusal(arguments, 130, {"interrupted"}, settings);
  }
  Words register_town() const {
    return Words{"register"} + town_scans() +
           Words{"--init", town_file("initial_poses.json").string(), "--out", "new/result"};
  }
};

TEST_F(Interrupt, EndsReading) { expect_interrupted(register_town(), "reading"); }
TEST_F(Interrupt, EndsMerging) { expect_interrupted(register_town(), "merging"); }

// Many points in a scan make the writing last long enough to be interrupted.
TEST_F(Interrupt, EndsWritingAndKeepsTheEarlierResult) {
  constexpr std::size_t kCopies = 60;
  const std::string town = read_text(town_file("000.ply"));
  const std::size_t header = town.find("end_header\n") + 11;
  const std::string points = town.substr(header);
  std::string head = town.substr(0, header);
  const std::string count = std::to_string(points.size() / 16);
  head.replace(head.find(count), count.size(), std::to_string(kCopies * points.size() / 16));
  std::string large = head;
  for (std::size_t i = 0; i < kCopies; ++i) large += points;
  folder_.write("large.ply", large);

  const Words arguments = Words{"register", "large.ply"} + town_scans({1}) +
                          Words{"--reference", "large.ply", "--outliers", "none", "--out"} + Words{"result"} + kSmall;
  expect_interrupted(arguments, "writing");
  std::filesystem::create_directory(folder() / "result");
  folder_.write("result/poses.json", "of an earlier run");
  expect_interrupted(arguments + Words{"--force"}, "writing");
  EXPECT_EQ(read_text(folder() / "result/poses.json"), "of an earlier run");
}

TEST_F(Interrupt, EndsSimulation) {
  expect_interrupted({"simulate", "--scans", "6", "--step", "0.2", "--out", "new/scene"}, "simulate");
}

}  // namespace
}  // namespace tcm_icp::test
