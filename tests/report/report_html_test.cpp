#include "report/report_html.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "report/page_texts.hpp"
#include "support/markup.hpp"

namespace tcm_icp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> kNames{"<script>alert(1)</script>.ply", "a&b \"c\" 'd'.ply",
                                      "Gr\u00FC\u00DFe \u70B9.ply", "bad\xFF\x01.ply"};
const std::vector<std::string> kEscaped{"&lt;script&gt;alert(1)&lt;/script&gt;.ply",
                                        "a&amp;b &quot;c&quot; &#39;d&#39;.ply", "Gr\u00FC\u00DFe \u70B9.ply",
                                        "bad\uFFFD\uFFFD.ply"};

// Three scans placed, the fourth not; of three pairs one contradicts, and one holds nothing in its weakest direction.
PipelineResult three_of_four() {
  PipelineResult result;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    ScanSummary scan;
    scan.file = kNames[i];
    scan.num_points = 1234567;
    scan.extent_m = 20;
    result.scans.push_back(scan);
    ScanPose pose{kNames[i],          ScanStatus::kRegistered, Eigen::Isometry3d::Identity(), {}, 0,
                  Verdict::kAccepted, "agrees at 70 %"};
    pose.T_reference_scan.translation().x() = 10.0 * static_cast<double>(i);
    result.poses.push_back(pose);
    result.evidence.emplace_back(AlignmentEvidence{});
    result.uncertainty.poses.emplace_back();
  }
  result.poses[0].status = ScanStatus::kReference;
  result.evidence[0].reset();
  result.poses[3] = {kNames[3],  ScanStatus::kUnregistered, Eigen::Isometry3d::Identity(), {}, 1, Verdict::kRejected,
                     "of <Mars>"};
  result.uncertainty.poses[1].determined = true;
  result.uncertainty.poses[1].covariance = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
  result.graph.measure = Eigen::MatrixXd::Zero(4, 4);
  result.graph.adjacency.resize(4);
  result.links.push_back({0, 1, {}, {}, 0.97, Verdict::kAccepted, "agrees", LinkStrength{}});
  result.links.push_back({1, 2, {}, {}, 0.02, Verdict::kRejected, "only 1 % agree", {}});
  LinkHypothesisRecord contradicted;
  contradicted.a = 0;
  contradicted.b = 2;
  contradicted.log_odds = 2;
  contradicted.status = HypothesisStatus::kContradicted;
  result.hypotheses.push_back(contradicted);
  MergeRecord merge;
  merge.scan = 1;
  merge.accepted = true;
  merge.tcm.f = kNaN;
  result.merges.push_back(merge);
  result.stages.push_back({"link & merge", 1.5, 100});
  return result;
}

Json report_of(const PipelineResult& result, const PipelineOptions& options = {}) {
  return report_object(result, options, {}, {"0.1.0", "tcm-icp register <&>", "", "2026-01-02T03:04:05+01:00"});
}

bool has(const std::string& page, const std::string& part) { return page.find(part) != std::string::npos; }

TEST(ReportHtml, IsWellFormedWhateverTheFilesAreCalled) {
  const std::string page = report_html(report_of(three_of_four()));
  EXPECT_EQ(testing::markup_error(page), "");
  for (const auto& name : kEscaped) EXPECT_TRUE(has(page, name)) << name;
  EXPECT_FALSE(has(page, "<script")) << "there are no points to look at";
  EXPECT_TRUE(has(page, "tcm-icp register &lt;&amp;&gt;"));
  EXPECT_TRUE(has(page, "2026-01-02 03:04:05+01:00"));
}

TEST(ReportHtml, LoadsNothing) {
  const std::string page = report_html(report_of(three_of_four()));
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:)|url\\(|@import|onload", std::regex::icase)));
}

TEST(ReportHtml, ShowsPointsAndNoNameBecomesMarkupInItsScripts) {
  const PipelineResult result = three_of_four();
  const Scene scene = make_scene(result, {{{1, 2, 3}}, {{4, 5, 6}, {7, 8, 9}}, {}, {}}, 1);
  const std::string page = report_html(report_of(result), scene);
  EXPECT_EQ(testing::markup_error(page), "");
  EXPECT_TRUE(has(page, "id=\"view\""));
  EXPECT_TRUE(has(page, "src=\"data:image/png;base64,")) << "for browsers without WebGL";
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_TRUE(has(page, "default-src 'none'")) << "browsers refuse to load anything";
  EXPECT_EQ(has(page, "id=\"view-data\""), !html::three_script().empty());
}

TEST(ReportHtml, ShowsNoNaNAndNoInfinity) {
  const std::string page = report_html(report_of(three_of_four()));
  EXPECT_FALSE(std::regex_search(page, std::regex("[^a-z](nan|inf|null)[^a-z]", std::regex::icase)));
}

TEST(ReportHtml, NamesWhatIsNotRegisteredAndWhy) {
  const PipelineResult result = three_of_four();
  const std::string page = report_html(report_of(result));
  EXPECT_TRUE(has(page, "3 of 4 scans are registered."));
  EXPECT_TRUE(has(page, kEscaped[3] + "</bdi>: of &lt;Mars&gt;"));
  PipelineResult alone = result;
  for (const std::size_t i : {0UL, 1UL, 2UL, 3UL}) {
    if (i == alone.reference) continue;
    alone.poses[i].status = ScanStatus::kUnregistered;
    alone.poses[i].component = static_cast<int>(i) + 1;
  }
  EXPECT_TRUE(has(report_html(report_of(alone)), "No scan is registered with another"));
  PipelineResult complete = result;
  complete.poses[3] = complete.poses[2];
  complete.poses[3].file = kNames[3];
  EXPECT_TRUE(has(report_html(report_of(complete)), "All 4 scans are registered."));
}

TEST(ReportHtml, SaysWhereNothingIsVerified) {
  PipelineOptions paper;
  paper.profile = Profile::kPaper;
  EXPECT_TRUE(has(report_html(report_of(three_of_four(), paper)), "3 of 4 scans have a pose, none of them verified."));
  PipelineResult conventional = three_of_four();
  conventional.method = "icp";
  conventional.pairs.push_back({});
  const std::string page = report_html(report_of(conventional));
  EXPECT_TRUE(has(page, "none of them verified"));
  EXPECT_TRUE(has(page, "Pairs fitted by icp"));
}

TEST(ReportHtml, DrawsPlacedScansAndTheirLinksByVerdict) {
  const std::string page = report_html(report_of(three_of_four()));
  const auto count = [&](const std::string& part) {
    std::size_t n = 0;
    for (auto at = page.find(part); at != std::string::npos; at = page.find(part, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<g><circle"), 3U);
  // One line of each kind, and one in the legend.
  for (const char* kind : {"good", "fair", "bad"}) EXPECT_EQ(count(std::string("class=\"link ") + kind), 2U) << kind;
  EXPECT_EQ(count("not held"), 1U);
}

TEST(ReportHtml, DrawsEachGroupInItsOwnFrame) {
  PipelineResult result = three_of_four();
  for (const std::size_t i : {2UL, 3UL}) {
    result.poses[i].status = ScanStatus::kUnregistered;
    result.poses[i].component = 1;
    result.poses[i].pose_in_component = Eigen::Isometry3d::Identity();
  }
  const std::string page = report_html(report_of(result));
  EXPECT_TRUE(has(page, "Group 0, in the frame of"));
  EXPECT_TRUE(has(page, "Group 1, not registered with the others, in a frame of its own"));
  EXPECT_FALSE(has(page, "view-group")) << "there are no points to look at";
  const Scene scene = make_scene(result, {{{1, 2, 3}}, {{4, 5, 6}}, {{7, 8, 9}}, {{1, 1, 1}}}, 1);
  const std::string with_points = report_html(report_of(result), scene);
  EXPECT_EQ(testing::markup_error(with_points), "");
  EXPECT_TRUE(has(with_points, "group 1: 2 scans not registered with them"));
  EXPECT_TRUE(has(with_points, "hold together (group 1), but are not registered with the others"));
}

// Control points may tie scans to the rest that no link ties to it.
TEST(ReportHtml, DrawsScansInOneFrameWhereControlPointsTieThem) {
  PipelineResult result = three_of_four();
  result.survey.has_frame = true;
  result.survey.defined_by = "control points";
  result.poses[2].component = 1;
  const std::string page = report_html(report_of(result));
  EXPECT_TRUE(has(page, "Group 0, in the survey frame"));
  EXPECT_FALSE(has(page, "frame of its own,"));
}

// A control point used, a blunder, and one whose scan is nowhere, with names that are markup.
PipelineResult surveyed() {
  PipelineResult result = three_of_four();
  SurveyRecord& survey = result.survey;
  survey.has_frame = true;
  survey.defined_by = "control points";
  survey.crs = "PROJCS[\"a <b> & c\"]";
  survey.num_rotations = 2;
  survey.remarks = {"determined <little>"};
  for (const PointStatus status : {PointStatus::kUsed, PointStatus::kBlunder, PointStatus::kNotRegistered}) {
    PointResidual point;
    point.point.name = "T<" + std::to_string(survey.points.size()) + ">";
    point.point.scan = kNames[survey.points.size()];
    point.status = status;
    if (status != PointStatus::kNotRegistered) point.residual_m = point.sigma_m = {0.001, -0.002, 0.0531};
    survey.points.push_back(point);
  }
  result.uncertainty.poses[0] = result.uncertainty.poses[1];
  return result;
}

TEST(ReportHtml, ListsControlPointsAndNamesBlunders) {
  const std::string page = report_html(report_of(surveyed()));
  EXPECT_EQ(testing::markup_error(page), "");
  for (const char* const text : {"Survey frame", "T&lt;1&gt;", "contradicts the others", "53.1", "not registered",
                                 "PROJCS[&quot;a &lt;b&gt; &amp; c&quot;]", "determined &lt;little&gt;"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
  EXPECT_FALSE(std::regex_search(page, std::regex("[^a-z](nan|inf|null)[^a-z]", std::regex::icase)));
  const std::string plain = report_html(report_of(three_of_four()));
  EXPECT_EQ(plain.find("Survey frame"), std::string::npos);
}

TEST(ReportJson, SurveyIsThereWhereAskedForAndKnowsNoNaN) {
  EXPECT_FALSE(report_of(three_of_four()).contains("survey"));
  const Json survey = report_of(surveyed()).at("survey");
  EXPECT_EQ(survey.at("points").at(1).at("status"), "blunder");
  EXPECT_EQ(survey.at("points").at(1).at("residual_m").at(2), 0.0531);
  EXPECT_TRUE(survey.at("points").at(2).at("residual_m").is_null());
  EXPECT_TRUE(survey.at("points").at(0).at("test").is_null());
  EXPECT_TRUE(survey.at("variance_factor").is_null());
}

TEST(ReportJson, IsJsonWhateverTheFilesAreCalled) {
  const PipelineResult result = three_of_four();
  const Json read = Json::parse(report_json(result, {}, {}, {}));
  EXPECT_EQ(read["scans"][3]["file"], "bad\uFFFD\x01.ply");
  EXPECT_EQ(read["scans"][2]["middle_m"][0], 20.0);
  EXPECT_TRUE(read["scans"][3]["middle_m"].is_null());
  EXPECT_TRUE(read["started"].is_null());
}

TEST(ReportJson, SaysWhatEachScanWasDecidedFrom) {
  PipelineResult result = three_of_four();
  result.measurements.resize(4);
  result.decisions.resize(4);
  result.measurements[1].emplace().lead = 7;
  result.measurements[1]->support = 9;
  result.measurements[1]->other_distance = 12.5;
  result.measurements[1]->num_moved = 3;
  result.decisions[1].reason = Reason::kAmbiguous;
  result.decisions[1].probability = 0.4;
  result.decisions[1].features[0] = 7;
  result.measurements[2].emplace();
  result.decisions[3].reason = Reason::kNoLink;
  const Json scans = Json::parse(report_json(result, {}, {}, {}))["scans"];
  const Json& decision = scans[1]["decision"];
  EXPECT_EQ(decision["reason"], std::string(to_string(Reason::kAmbiguous)));
  EXPECT_EQ(decision["probability"], 0.4);
  EXPECT_EQ(decision["lead"], 7);
  EXPECT_EQ(decision["support"], 9);
  EXPECT_EQ(decision["other_place_m"], 12.5);
  EXPECT_EQ(decision["moves_with"], 2) << "beside itself";
  EXPECT_EQ(decision["features"].size(), kDecisionFeatureNames.size());
  EXPECT_TRUE(scans[2]["decision"]["other_place_m"].is_null());
  EXPECT_EQ(scans[3]["decision"]["reason"], std::string(to_string(Reason::kNoLink)));
  EXPECT_FALSE(scans[3]["decision"].contains("lead")) << "nothing was measured";
}

}  // namespace
}  // namespace tcm_icp
