// report.html after `tcm-icp register`: there with every method, well-formed, and of one mind with report.json.

#include "cli_test.hpp"
#include "result_files.hpp"
#include "support/markup.hpp"

namespace tcm_icp::test {
namespace {

class ReportHtmlFile : public CliTest {
 protected:
  // Two scans of the town under these names; the name of a file is all the page can be attacked by.
  RunResult register_as(const std::string& a, const std::string& b, const Words& options = {}) const {
    std::filesystem::copy_file(town_file("000.ply"), folder() / a);
    std::filesystem::copy_file(town_file("001.ply"), folder() / b);
    return run(Words{"register", a, b, "--out", "result"} + kSmall + options);
  }
  std::string page() const { return read_text(folder() / "result/report.html"); }
  bool page_has(const std::string& part) const { return page().find(part) != std::string::npos; }
};

TEST_F(ReportHtmlFile, NamesEveryScanWhateverItIsCalled) {
  const RunResult result = register_as("Gr\u00FC\u00DFe & <script>.ply", "\u70B9 '\"1\".ply");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(testing::markup_error(page()), "");
  EXPECT_TRUE(page_has("Gr\u00FC\u00DFe &amp; &lt;script&gt;.ply"));
  EXPECT_TRUE(page_has("\u70B9 &#39;&quot;1&quot;.ply"));
  EXPECT_FALSE(page_has("<script>.ply"));
  EXPECT_TRUE(page_has("All 2 scans are registered."));
}

TEST_F(ReportHtmlFile, AgreesWithReportJson) {
  ASSERT_EQ(register_as("a.ply", "b.ply").exit_code, 0);
  const auto json = read_json(folder() / "result/report.json");
  for (const auto& scan : json["scans"]) EXPECT_TRUE(page_has(scan["file"])) << scan["file"];
  EXPECT_TRUE(page_has("tcm-icp " + json["version"].get<std::string>()));
  const auto started = json["started"].get<std::string>();
  ASSERT_EQ(started.size(), std::string("2026-01-02T03:04:05+01:00").size());
  EXPECT_TRUE(page_has(started.substr(0, 10) + " " + started.substr(11)));
  for (const auto& stage : json["stages"]) EXPECT_TRUE(page_has(stage["name"].get<std::string>() + "</text>"));
}

TEST_F(ReportHtmlFile, SaysThatThePaperVerifiesNothing) {
  ASSERT_EQ(register_as("a.ply", "b.ply", {"--profile", "paper"}).exit_code, 0);
  EXPECT_EQ(testing::markup_error(page()), "");
  EXPECT_TRUE(page_has("none of them verified"));
}

TEST_F(ReportHtmlFile, HoldsScansAndLinksAgainstTheLimits) {
  ASSERT_EQ(
      register_as("a.ply", "b.ply", {"--accept-residual", "10m", "--accept-overlap", "1%", "--project", "A & <B>"})
          .exit_code,
      0);
  EXPECT_EQ(testing::markup_error(page()), "");
  EXPECT_TRUE(page_has("<h1>A &amp; &lt;B&gt;</h1>"));
  EXPECT_TRUE(page_has("Within the limits"));
  const auto passed = read_json(folder() / "result/report.json");
  EXPECT_EQ(passed["acceptance"]["passed"], true);
  const auto asked = passed["command_line"].get<std::string>();
  EXPECT_NE(asked.find(" --accept-overlap 1% --project 'A & <B>'"), std::string::npos)
      << "as a shell takes it: " << asked;
  const RunResult strict =
      run(Words{"register", "a.ply", "b.ply", "--out", "strict", "--accept-residual", "1um"} + kSmall);
  EXPECT_EQ(strict.exit_code, 0) << "limits are for the report; the scans are registered all the same";
  const auto json = read_json(folder() / "strict/report.json");
  EXPECT_EQ(json["acceptance"]["passed"], false);
  EXPECT_EQ(json["acceptance"]["failed_scans"], 2);
  EXPECT_EQ(json["links"][0]["acceptance"]["passed"], false);
  EXPECT_GT(json["links"][0]["residuals"]["rms_m"], 1e-6) << "by which it failed";
  EXPECT_NE(read_text(folder() / "strict/report.html").find("Outside the limits"), std::string::npos);
}

TEST_F(ReportHtmlFile, RefusesLimitsWithoutSense) {
  for (const Words& wrong :
       {Words{"--accept-residual", "6kg"}, Words{"--accept-overlap", "130%"}, Words{"--accept-sigma", "-1mm"}}) {
    const RunResult result = run(Words{"register", "a.ply", "b.ply", "--out", "result"} + wrong);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find(wrong[0] + " '" + wrong[1] + "': give"), std::string::npos) << result.err;
  }
}

TEST_F(ReportHtmlFile, HasPicturesThatAreTheSameEachTime) {
  ASSERT_EQ(register_as("a.ply", "b.ply").exit_code, 0);
  const std::string preview = read_text(folder() / "result/preview.png");
  EXPECT_EQ(preview.substr(1, 3), "PNG");
  EXPECT_GT(preview.size(), 10000U) << "not blank";
  for (const char* const name : {"one.png", "two.png"}) {
    const RunResult drawn = run({"render", "result", "--out", name, "--size", "300x200"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  }
  EXPECT_EQ(read_text(folder() / "one.png"), read_text(folder() / "two.png"));
  EXPECT_EQ(run({"render", "result", "--out", "one.png"}).exit_code, 4) << "it is there already";
  EXPECT_EQ(run({"render", "nothing", "--out", "three.png"}).exit_code, 2);
  EXPECT_EQ(run({"render", "result", "--out", "three.png", "--size", "wide"}).exit_code, 1);
}

// JSON and HTML are UTF-8; the name of a file need not be.
TEST_F(ReportHtmlFile, ReplacesBytesThatAreNoCharacters) {
  const RunResult result = register_as("bad\xFF.ply", "b.ply");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_json(folder() / "result/report.json")["scans"][0]["file"], "bad\uFFFD.ply");
  EXPECT_TRUE(page_has("bad\uFFFD.ply"));
}

}  // namespace
}  // namespace tcm_icp::test
