// Scans, initial poses and option files that cannot be used: exit code 2 or 1, a message that says where and what to
// do, and nothing left behind.

#include "cli_test.hpp"

namespace tcm_icp::test {
namespace {

class BadInput : public CliTest {
 protected:
  BadInput() {
    folder_.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    folder_.write("b.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 2\n");
  }
  void expect_bad(const Words& scans, int code, const Words& parts) const {
    expect_refusal(Words{"register"} + scans + Words{"--out", "result"}, code, parts);
  }
  void expect_bad_guess(const std::string& json, const Words& parts) const {
    folder_.write("guess.json", json);
    expect_bad({"a.xyz", "b.xyz", "--init", "guess.json"}, 2, Words{"guess.json"} + parts);
  }
};

TEST_F(BadInput, IsAFileThatIsNotThere) {
  expect_bad({"a.xyz", "c.xyz"}, 2, {"c.xyz", "no such file", "check the path"});
}

TEST_F(BadInput, IsAFolder) {
  std::filesystem::create_directory(folder() / "scans");
  expect_bad({"a.xyz", "scans"}, 2, {"scans", "is a folder without a scan", "name the files"});
}

TEST_F(BadInput, IsAnUnknownExtension) {
  folder_.write("c.doc", "0 0 0\n");
  expect_bad({"a.xyz", "c.doc"}, 2, {"c.doc", "no known format", "convert it"});
}

TEST_F(BadInput, IsFewerThanThreePoints) {
  folder_.write("c.xyz", "0 0 0\n1 0 0\n");
  expect_bad({"a.xyz", "c.xyz"}, 2, {"c.xyz", "2 finite points", "at least 3"});
  folder_.write("c.xyz", "");
  expect_bad({"a.xyz", "c.xyz"}, 2, {"c.xyz"});
  folder_.write("c.xyz", "0 0 0\n1 0 0\nnan 0 0\ninf 1 2\n");
  expect_bad({"a.xyz", "c.xyz"}, 2, {"c.xyz", "2 finite points"});
}

TEST_F(BadInput, IsAllPointsInOnePlace) {
  folder_.write("c.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n");
  expect_bad({"a.xyz", "c.xyz"}, 2, {"c.xyz", "1 place", "different points"});
}

TEST_F(BadInput, IsALineThatIsNoPoint) {
  folder_.write("c.xyz", "0 0 0\n1 0 0\n0 one 0\n");
  expect_bad({"a.xyz", "c.xyz"}, 2, {"c.xyz: line 3"});
}

TEST_F(BadInput, IsATruncatedPly) {
  folder_.write("c.ply", read_text(town_file("000.ply")).substr(0, 50'000));
  expect_bad({"a.xyz", "c.ply"}, 2, {"c.ply", "26231"});
}

TEST_F(BadInput, IsOneScanOnly) {
  expect_bad({"a.xyz"}, 1, {"at least two scans"});
  expect_bad({}, 1, {"at least two scans"});
}

TEST_F(BadInput, IsTheSameFileTwice) {
  std::filesystem::create_symlink("a.xyz", folder() / "link.xyz");
  for (const char* again : {"a.xyz", "./a.xyz", "link.xyz"}) expect_bad({"a.xyz", again}, 2, {again, "named twice"});
}

TEST_F(BadInput, IsAPatternThatMatchesNothing) {
  expect_bad({"a.xyz", "c*.xyz"}, 2, {"c*.xyz", "no file matches", "check the path"});
}

TEST_F(BadInput, IsAScanThatAFileDoesNotHold) {
  expect_bad({"a.xyz", "b.xyz#3"}, 2, {"b.xyz", "no scan 3", "b.xyz#1"});
}

TEST_F(BadInput, IsAReferenceThatIsNoScan) {
  expect_bad({"a.xyz", "b.xyz", "--reference", "c.xyz"}, 1, {"--reference c.xyz", "one of the files given"});
}

TEST_F(BadInput, IsInitialPosesThatCannotBeRead) {
  expect_bad({"a.xyz", "b.xyz", "--init", "none.json"}, 2, {"none.json", "cannot be opened", "check the path"});
  expect_bad_guess("0 0 0", {"byte", "not JSON"});
  expect_bad_guess("[]", {"scans"});
}

TEST_F(BadInput, IsAnInitialPoseOfNoScan) {
  expect_bad_guess(R"({"scans": [{"file": "c.xyz", "pose": null}]})", {"scans[0]", "c.xyz", "not among the scans"});
}

TEST_F(BadInput, IsAnInitialPoseThatIsNotRigid) {
  expect_bad_guess(R"({"scans": [{"file": "a.xyz", "pose": [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]}]})",
                   {"scans[0].pose", "not a rigid motion"});
  expect_bad_guess(R"({"scans": [{"file": "a.xyz", "pose": [[1,0,0],[0,1,0],[0,0,1]]}]})", {"4 x 4"});
}

TEST_F(BadInput, IsAnOptionFileWithAnUnknownName) {
  folder_.write("options.ini", "seed = 1\nsolvr = glpk\n");
  expect_bad({"a.xyz", "b.xyz", "--config", "options.ini"}, 1, {"options.ini", "solvr", "--print-config"});
  folder_.write("options.ini", "threads = many\n");
  expect_bad({"a.xyz", "b.xyz", "--config", "options.ini"}, 1, {"options.ini", "threads", "many"});
  expect_bad({"a.xyz", "b.xyz", "--config", "none.ini"}, 2, {"none.ini", "cannot be opened"});
}

// Boost replaces such words in its messages by what was typed: for ever, where that holds them.
TEST_F(BadInput, IsAWordThatMessagesReplace) {
  for (const char* const word : {"--%original_token%s", "--threads=%value%", "%option%.xyz"}) {
    expect_bad({"a.xyz", "b.xyz", word}, 1, {"the command line holds %", "write it otherwise"});
  }
  folder_.write("options.ini", "seeds%original_token% = 1\n");
  expect_bad({"a.xyz", "b.xyz", "--config", "options.ini"}, 1, {"options.ini holds %original_token%"});
  folder_.write("options.ini", "no option, but %invalid_line% and more\n");
  expect_bad({"a.xyz", "b.xyz", "--config", "options.ini"}, 1, {"options.ini holds %invalid_line%"});
}

}  // namespace
}  // namespace tcm_icp::test
