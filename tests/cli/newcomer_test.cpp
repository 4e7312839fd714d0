// Mistakes that everyone makes at first: each message says which file or option, what is wrong, and what to do.

#include <unistd.h>

#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>

#include "cli_test.hpp"
#include "io/las_file.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

struct Mistake {
  std::string what;
  Words command;
  int code;
  Words says;  ///< where, why and what to do
};

class Newcomer : public CliTest {
 protected:
  Newcomer() {
    for (const char* const name : {"000.ply", "001.ply", "003.ply"}) {
      std::filesystem::copy_file(town_file(name), folder() / name);
    }
    folder_.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
    std::filesystem::copy_file(town_file("000.ply"), folder() / "copy.ply");
    std::filesystem::create_directory(folder() / "empty_folder");
    std::filesystem::create_directory(folder() / "finished");
    folder_.write("finished/keep.txt", "precious");
    folder_.write("text.las", "1 2 3\n4 5 6\n7 8 9\n");
    folder_.write("scan.fls", std::string("\0\1\2\3", 4));
    folder_.write("mesh.obj", "v 1 2 3\n");
    folder_.write("cut.ply", read_text(town_file("000.ply")).substr(0, 50'000));
    folder_.write("commas.csv", "1,25,2,05,3,75\n4,50,5,25,6,125\n7,00,8,5,9,5\n");
    folder_.write("nan.xyz", "nan nan nan\nnan nan nan\nnan nan nan\n");
    folder_.write("zeros.xyz", "0 0 0\n0 0 0\n0 0 0\n");
    folder_.write("empty.ply", "");
    folder_.write("notes.txt", "station 3 was moved\n");
    folder_.write("pointer.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a2146\nsize 12345\n");
    folder_.write("page.ply", "<!DOCTYPE html>\n<html><head><title>404</title></head></html>\n");
    folder_.write("packed.ply", std::string("PK\x03\x04\x14\0\0\0", 8));
    folder_.write("other.json", R"({"scans": [{"file": "else.ply", "pose": null}]})");
    folder_.write("broken.json", "{\"scans\": [");
    write_laz("scan.laz", "");
    write_laz("scan.las", "");
    write_laz("scan.copc.laz", "copc");
  }

  /// The header of a compressed file.
  void write_laz(const std::string& name, const std::string& user) const {
    LasParts parts;
    parts.minor = 4;
    parts.records = las_record(user, 1, std::string(160, '\0'));
    parts.num_records = 1;
    std::string file = las_file(parts);
    put(file, 104, static_cast<std::uint8_t>(128));
    folder_.write(name, file);
  }
};

TEST_F(Newcomer, IsToldWhereWhyAndWhatToDo) {
  const auto with = [](const std::string& scan) { return Words{"register", scan, "000.ply", "--out", "result"}; };
  const auto and_options = [](const Words& options) { return Words{"register", "000.ply", "001.ply"} + options; };
  const std::vector<Mistake> mistakes = {
      {"a path that is wrong", with("scans/1.ply"), 2, {"scans/1.ply", "no such file", "check the path"}},
      {"a pattern without a match", with("*.e57"), 2, {"*.e57", "no file matches", "check the path"}},
      {"an extension of another format",
       with("text.las"),
       2,
       {"text.las", "not a LAS file", "extension of its format"}},
      {"a mesh", with("mesh.obj"), 2, {"mesh.obj", "no known format", "convert it"}},
      {"a scanner's own format", with("scan.fls"), 2, {"scan.fls", "scanner's own format", "export the scans as E57"}},
      {"LAZ", with("scan.laz"), 2, {"scan.laz", "compressed (LAZ)", "pdal translate scan.laz scan.las"}},
      {"LAZ named .las", with("scan.las"), 2, {"scan.las", "compressed (LAZ)", "scan.las scan_unpacked.las"}},
      {"COPC", with("scan.copc.laz"), 2, {"scan.copc.laz", "compressed (COPC)", "pdal translate"}},
      {"a folder without scans", with("empty_folder"), 2, {"empty_folder", "folder without a scan", "name the files"}},
      {"one scan only", {"register", "000.ply", "--out", "result"}, 1, {"two scans, not 1", "name the files"}},
      {"no folder for the result", and_options({}), 1, {"--out DIR is missing"}},
      {"a download that stopped", with("cut.ply"), 2, {"cut.ply", "of 26231", "write or copy it again"}},
      {"a pointer of Git LFS", with("pointer.ply"), 2, {"pointer.ply", "Git LFS", "git lfs pull"}},
      {"a page in place of data", with("page.ply"), 2, {"page.ply", "web page", "download the scan again"}},
      {"an archive", with("packed.ply"), 2, {"packed.ply", "zip archive", "unpack it"}},
      {"an empty file", with("empty.ply"), 2, {"empty.ply", "is empty", "make it again"}},
      {"NaN everywhere", with("nan.xyz"), 2, {"nan.xyz", "0 finite points", "export it again"}},
      {"zeros everywhere", with("zeros.xyz"), 2, {"zeros.xyz", "1 place", "check the file's columns"}},
      {"commas for all", with("commas.csv"), 2, {"commas.csv", "line 1", "within numbers", "semicolons between"}},
      {"notes among scans", with("notes.txt"), 2, {"notes.txt", "'station'", "put # before a comment"}},
      {"a copy", with("copy.ply"), 2, {"000.ply has the same points as copy.ply", "leave one of the two out"}},
      {"a scan named twice", with("./000.ply"), 2, {"000.ply", "named twice", "name each scan once"}},
      {"a result that is there", and_options({"--out", "finished"}), 4, {"finished", "exists already", "--force"}},
      {"--force on something else", and_options({"--out", "finished", "--force"}), 4, {"finished", "not an earlier"}},
      {"a file for the result", and_options({"--out", "a.xyz"}), 4, {"a.xyz", "is a file", "name a folder"}},
      {"a parent that is a file",
       and_options({"--out", "a.xyz/result"}),
       4,
       {"a.xyz/result", "cannot be made", "parent"}},
      {"a typo in an option", and_options({"--solvr", "glpk"}), 1, {"--solvr", "did you mean '--solver'"}},
      {"a typo in a value", and_options({"--profile", "robst"}), 1, {"robst", "did you mean 'robust'"}},
      {"a typo in a command", {"registr", "000.ply"}, 1, {"registr", "did you mean 'register'"}},
      {"a command left out", {"000.ply", "001.ply", "--out", "result"}, 1, {"000.ply", "tcm-icp --help"}},
      {"a unit that is none", and_options({"--out", "result", "--unit", "cm"}), 1, {"--unit cm", "m, mm, ft"}},
      {"LAZ wanted", and_options({"--out", "result", "--format", "laz"}), 1, {"'laz'", "did you mean 'las'"}},
      {"poses of another set",
       and_options({"--out", "result", "--init", "other.json"}),
       2,
       {"other.json", "'else.ply'", "not among the scans", "remove the entry"}},
      {"poses that are cut off",
       and_options({"--out", "result", "--init", "broken.json"}),
       2,
       {"broken.json", "not JSON", "byte"}},
      {"poses in headers that have none",
       and_options({"--out", "result", "--init", "headers"}),
       1,
       {"--init headers", "no scan has a pose", "leave it out"}},
      {"a reference that is no scan",
       and_options({"--out", "result", "--reference", "9.ply"}),
       1,
       {"--reference 9.ply", "one of the files given"}}};
  EXPECT_GE(mistakes.size(), 20U);
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.what);
    expect_refusal(mistake.command, mistake.code, mistake.says);
  }
}

TEST_F(Newcomer, IsToldOfAFileThatMustNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  std::filesystem::permissions(folder() / "a.xyz", std::filesystem::perms::none);
  expect_refusal({"register", "a.xyz", "000.ply", "--out", "result"}, 2, {"a.xyz", "cannot be opened", "permissions"});
}

TEST_F(Newcomer, IsToldOfMillimetresAmongMetres) {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const auto& p : read_whole(town_file("002.ply"), ReadAttributes::kNo).block.points) {
    text << 1000 * p.x() << ' ' << 1000 * p.y() << ' ' << 1000 * p.z() << '\n';
  }
  folder_.write("mm.xyz", text.str());
  const RunResult result = run(Words{"inspect", "000.ply", "001.ply", "003.ply", "mm.xyz"} + kSmall);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("mm.xyz: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("say --unit mm.xyz=mm"), std::string::npos) << result.err;
}

TEST_F(Newcomer, MayNameAFolderThatIsYetToBeMade) {
  const RunResult result = run(Words{"register", "000.ply", "001.ply", "--out", "new/deep/result"} + kSmall);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder() / "new/deep/result/poses.json"));
}

}  // namespace
}  // namespace tcm_icp::test
