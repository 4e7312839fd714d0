// The output folder of `tcm-icp register`: there whole or not at all, and never at the cost of what is there.

#include "cli_test.hpp"

namespace tcm_icp::test {
namespace {

namespace fs = std::filesystem;

class OutputFolders : public CliTest {
 protected:
  Words to(const std::string& out) const {
    return Words{"register"} + town_scans({0, 1}) + Words{"--outliers", "none", "--out", out} + kSmall;
  }
  void expect_done(const Words& arguments) const {
    const RunResult result = run(arguments);
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.exit_code << '\n' << result.err;
  }
};

TEST_F(OutputFolders, AreMadeWithTheirParents) {
  expect_done(to("new/deep/result/"));
  EXPECT_EQ(everything_in(folder() / "new/deep").count(folder() / "new/deep/result/poses.json"), 1U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "new/deep"), {}), 1);
}

TEST_F(OutputFolders, AreReplacedByForceOnly) {
  expect_done(to("result"));
  folder_.write("result/note.txt", "of the first run");
  expect_refusal(to("result"), 4, {"result", "exists", "--force"});
  expect_done(to("result") + Words{"--force"});
  EXPECT_FALSE(fs::exists(folder() / "result/note.txt"));
  EXPECT_TRUE(fs::exists(folder() / "result/poses.json"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), {}), 1);
}

TEST_F(OutputFolders, MayBeEmptyWithForce) {
  fs::create_directory(folder() / "result");
  expect_refusal(to("result"), 4, {"exists"});
  expect_done(to("result") + Words{"--force"});
}

TEST_F(OutputFolders, ThatAreNoResultStayEvenWithForce) {
  fs::create_directory(folder() / "photos");
  folder_.write("photos/picture", "precious");
  expect_refusal(to("photos") + Words{"--force"}, 4, {"photos", "not an earlier result", "another folder"});
  folder_.write("file", "precious");
  expect_refusal(to("file") + Words{"--force"}, 4, {"file", "is a file"});
  fs::create_directory_symlink("photos", folder() / "link");
  expect_refusal(to("link") + Words{"--force"}, 4, {"link", "is a link"});
  EXPECT_EQ(read_text(folder() / "photos/picture") + read_text(folder() / "file"), "preciousprecious");
}

TEST_F(OutputFolders, ThatCannotBeMadeAreRefusedBeforeTheWork) {
  folder_.write("file", "precious");
  for (const char* out : {"file/result", "file/deep/result"}) {
    expect_refusal(to(out), 4, {out, "cannot be made", "can be written to"});
    EXPECT_EQ(run(to(out)).err.find("reading"), std::string::npos);
  }
}

TEST_F(OutputFolders, LeaveNoParentsWhereTheInputIsBad) {
  expect_refusal(to("new/deep/result") + Words{"missing.ply"}, 2, {"missing.ply"});
}

// A limit on the size of files acts like a full disk: the header finds room, or some of the points.
TEST_F(OutputFolders, AreGoneWhereTheDiskIsFull) {
  for (const std::size_t room : {std::size_t{1000}, std::size_t{100'000}}) {
    RunSettings full;
    full.max_file_bytes = room;
    expect_refusal(to("new/result") + Words{"--quiet"}, 4, {"registered.ply", "cannot be written", "free space"}, full);
  }
}

TEST_F(OutputFolders, KeepTheEarlierResultWhereTheDiskIsFull) {
  expect_done(to("result"));
  const std::string poses = read_text(folder() / "result/poses.json");
  RunSettings full;
  full.max_file_bytes = 100'000;
  expect_refusal(to("result") + Words{"--force", "--quiet"}, 4, {"registered.ply"}, full);
  EXPECT_EQ(read_text(folder() / "result/poses.json"), poses);
}

TEST_F(OutputFolders, KeepNamesWithBlanksAndUmlauts) {
  fs::copy_file(town_file("000.ply"), folder() / "scan 100 % ä.ply");
  fs::copy_file(town_file("001.ply"), folder() / "001.ply");
  expect_done(
      Words{"register", "scan 100 % ä.ply", "001.ply", "--out", "my result", "--reference", "scan 100 % ä.ply"} +
      kSmall);
  EXPECT_TRUE(fs::exists(folder() / "my result/transforms/scan 100 % ä.ply.txt"));
}

}  // namespace
}  // namespace tcm_icp::test
