// What stands on the terminal when a registration is done.

#include <algorithm>
#include <sstream>

#include "cli_test.hpp"
#include "result_files.hpp"

namespace tcm_icp::test {
namespace {

class EndOfRun : public CliTest {
 protected:
  // Scans of the town under names of the lengths that scanners give.
  Words named_at_length() const {
    Words names;
    for (const int i : {0, 1, 2}) {
      const std::string name = "Ernst-Reuter-Platz_Süd Setup 00" + std::to_string(i) + " (high resolution).ply";
      std::filesystem::copy(town_scans({i})[0], folder() / name);
      names.push_back(name);
    }
    return names;
  }
};

std::size_t width_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

TEST_F(EndOfRun, TableFitsAndNamesItsUnits) {
  const RunResult result = run(Words{"register", "--out", "result"} + named_at_length() + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::size_t start = result.err.find("no.  scan");
  ASSERT_NE(start, std::string::npos) << result.err;
  std::istringstream lines(result.err.substr(start));
  Words table;
  for (std::string line; std::getline(lines, line);) table.push_back(line);
  ASSERT_EQ(table.size(), 2U + 3U + 1U) << result.err;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) EXPECT_LE(width_of(table[i]), 80U) << table[i];
  EXPECT_EQ(width_of(table[0]), width_of(table[1])) << "every column of figures has its unit below";
  for (const char* unit : {"[%]", "[mm]", "[deg]"}) EXPECT_NE(table[1].find(unit), std::string::npos) << unit;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(table[2 + i].substr(0, 5), "  " + std::to_string(i) + "  ");
    EXPECT_NE(table[2 + i].find("..."), std::string::npos) << "shortened in the middle: " << table[2 + i];
  }
  EXPECT_EQ(table.back().find("3 of 3 registered, worst 1 sigma "), 0U) << table.back();
  EXPECT_NE(table.back().find(" mm (Ernst-Reuter-Platz_Süd Setup 00"), std::string::npos) << "the whole name";
  EXPECT_TRUE(table.back().ends_with(", open result/report.html")) << table.back();
}

TEST_F(EndOfRun, NumberOfAScanNamesTheReference) {
  const Words fast{"--out", "result", "--profile", "paper", "--reference", "1"};
  ASSERT_EQ(run(Words{"register"} + fast + town_scans({5, 4, 3}) + kSmall).exit_code, 0);
  EXPECT_EQ(read_json(folder() / "result/poses.json")["reference"], "004.ply");
}

TEST_F(EndOfRun, SaysWhatIsNotVerified) {
  const RunResult result =
      run(Words{"register", "--out", "result", "--profile", "paper"} + town_scans({0, 1}) + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("\n2 of 2 have a pose, none verified, open result/report.html\n"), std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace tcm_icp::test
