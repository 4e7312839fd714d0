// Scans in other units than metres, and the same scan under two names.

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "cli_test.hpp"
#include "result_files.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp::test {
namespace {

class Units : public CliTest {
 protected:
  // A scan of the town as text, its coordinates multiplied.
  void write_town(int number, const std::string& name, double factor) const {
    std::ostringstream text;
    text << std::setprecision(std::numeric_limits<double>::max_digits10);
    for (const auto& p : read_whole(town_scans({number})[0], ReadAttributes::kNo).block.points) {
      text << factor * p.x() << ' ' << factor * p.y() << ' ' << factor * p.z() << '\n';
    }
    folder_.write(name, text.str());
  }
  RunResult inspect(const Words& arguments) const {
    return run(Words{"inspect", "--json", "--quiet"} + arguments + kSmall);
  }
  static double extent_m(const RunResult& result, std::size_t scan) {
    return nlohmann::json::parse(result.out)["scans"][scan]["extent_m"].get<double>();
  }
};

constexpr double kRounding = 1e-9;  // of 17 digits, a division and a multiplication, with room

TEST_F(Units, AreAsTheyShouldBeInTheTown) { EXPECT_EQ(inspect(town_scans()).err, ""); }

TEST_F(Units, OfOneScanAreNamedAndPutRight) {
  const double plain_m = extent_m(inspect(town_scans({2})), 0);
  for (const auto& [unit, factor] : {std::pair("mm", 1000.0), {"ft", 1 / 0.3048}}) {
    write_town(2, "odd.xyz", factor);
    const Words scans = town_scans({0, 1, 3}) + Words{"odd.xyz"};
    const RunResult doubted = inspect(scans);
    EXPECT_EQ(doubted.exit_code, 0) << doubted.err;
    EXPECT_EQ(doubted.err.find("warning: odd.xyz: "), 0U) << doubted.err;
    EXPECT_NE(doubted.err.find(std::string("say --unit odd.xyz=") + unit + "\n"), std::string::npos) << doubted.err;
    EXPECT_NEAR(extent_m(doubted, 3) / plain_m, factor, kRounding * factor);
    for (const char* name : {"odd.xyz", "3"}) {
      const RunResult right = inspect(scans + Words{"--unit", std::string(name) + "=" + unit});
      EXPECT_EQ(right.err, "");
      EXPECT_NEAR(extent_m(right, 3), plain_m, kRounding * plain_m);
      EXPECT_EQ(nlohmann::json::parse(right.out)["scans"][3]["unit"], unit);
      EXPECT_EQ(nlohmann::json::parse(right.out)["scans"][0]["unit"], "m");
    }
  }
}

TEST_F(Units, OfAllScansWithOneExceptionAreRead) {
  write_town(0, "a.xyz", 3937.0 / 1200.0);
  write_town(1, "b.xyz", 1000);
  const RunResult right = inspect({"a.xyz", "b.xyz", "--unit", "us-ft", "--unit", "b.xyz=mm"});
  EXPECT_EQ(right.err, "");
  const RunResult plain = inspect(town_scans({0, 1}));
  for (std::size_t i : {0, 1}) EXPECT_NEAR(extent_m(right, i), extent_m(plain, i), 1e-9 * extent_m(plain, i));
}

TEST_F(Units, GiveTheSameRegistrationInMetres) {
  write_town(1, "001.xyz", 1000);
  const Words fixed{"--reference", "0", "--quiet"};
  ASSERT_EQ(run(Words{"register", "--out", "metres"} + fixed + town_scans({0, 1, 2}) + kSmall).exit_code, 0);
  const Words mixed = Words{town_scans({0})[0], "001.xyz", town_scans({2})[0], "--unit", "001.xyz=mm"};
  const RunResult result = run(Words{"register", "--out", "mixed"} + fixed + mixed + kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const PoseFile a = read_pose_file(folder() / "metres/poses.json"), b = read_pose_file(folder() / "mixed/poses.json");
  constexpr double kRadius_m = 100, kTolerance_m = 1e-3;  // rounding may take another point for a sample
  for (std::size_t i : {1, 2}) {
    EXPECT_LT(difference_m(a.scans[i].T_reference_scan, b.scans[i].T_reference_scan, kRadius_m), kTolerance_m);
  }
  EXPECT_EQ(a.scans[1].unit, "m");
  EXPECT_EQ(b.scans[1].unit, "mm");
  EXPECT_EQ(b.scans[2].unit, "m");
  const auto report = read_json(folder() / "mixed/report.json");
  EXPECT_EQ(report["scans"][1]["unit"], "mm");
  EXPECT_EQ(report["warnings"], nlohmann::json::array());
}

TEST_F(Units, AreDoubtedInTheReport) {
  write_town(1, "001.xyz", 1000);
  const Words scans = Words{town_scans({0})[0], "001.xyz"} + town_scans({2, 3});
  const RunResult result = run(Words{"register", "--out", "result", "--profile", "paper"} + scans + kSmall);
  EXPECT_NE(result.err.find("warning: 001.xyz: "), std::string::npos) << result.err;
  const auto report = read_json(folder() / "result/report.json");
  ASSERT_EQ(report["warnings"].size(), 1U);
  EXPECT_NE(report["warnings"][0].get<std::string>().find("--unit 001.xyz=mm"), std::string::npos);
  EXPECT_NE(read_text(folder() / "result/report.html").find("as if it were in mm"), std::string::npos);
}

TEST_F(Units, ThatAreNoneAreRefused) {
  const Words scans = Words{"inspect"} + town_scans({0, 1});
  expect_refusal(scans + Words{"--unit", "furlong"}, 1, {"--unit furlong", "m, mm, ft, us-ft"});
  expect_refusal(scans + Words{"--unit", "usft"}, 1, {"did you mean 'us-ft'?"});
  expect_refusal(scans + Words{"--unit", "001.ply=inch"}, 1, {"--unit 001.ply=inch", "choose one of"});
  expect_refusal(scans + Words{"--unit", "01.ply=mm"}, 1, {"no scan is called '01.ply'", "did you mean '0"});
}

TEST_F(Units, TheSameScanUnderTwoNamesIsRefused) {
  std::filesystem::copy(town_scans({1})[0], folder() / "copy.ply");
  const Words scans = town_scans({0, 1}) + Words{"copy.ply"};
  for (const char* method : {"robust", "paper"}) {
    expect_refusal(Words{"register", "--quiet", "--out", "new", "--profile", method} + scans + kSmall, 2,
                   {"copy.ply has the same points as 001.ply", "leave one of the two out"});
  }
  const RunResult inspected = inspect(scans);
  EXPECT_EQ(inspected.exit_code, 0);
  EXPECT_NE(inspected.err.find("warning: copy.ply has the same points as 001.ply"), std::string::npos) << inspected.err;
}

}  // namespace
}  // namespace tcm_icp::test
