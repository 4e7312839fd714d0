// Blunders that show in scans: another unit, the same points twice.

#include "pipeline/scan_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tcm_icp {
namespace {

constexpr double kMPerFt = 0.3048;

ScanSummary scan(const std::string& file, double extent_m, double spacing_m, double noise_m, double factor = 1) {
  ScanSummary s;
  s.file = file;
  s.extent_m = factor * extent_m;
  s.spacing_m = factor * spacing_m;
  s.noise_m = factor * noise_m;
  return s;
}

// As scans of a street differ: some hold more of it, some are sparser.
std::vector<ScanSummary> street() {
  return {scan("0", 20, 0.10, 0.004), scan("1", 24, 0.12, 0.0045), scan("2", 27, 0.11, 0.005),
          scan("3", 22, 0.14, 0.0038), scan("4", 31, 0.13, 0.0042)};
}

void multiply(ScanSummary& s, double factor) {
  s.extent_m *= factor;
  s.spacing_m *= factor;
  s.noise_m *= factor;
}

TEST(UnitDoubts, NoneInAnOrdinarySet) {
  EXPECT_TRUE(unit_doubts(street()).empty());
  auto in_mm = street();
  for (auto& s : in_mm) multiply(s, 1000);
  EXPECT_TRUE(unit_doubts(in_mm).empty()) << "all in one unit, whichever";
}

TEST(UnitDoubts, NameTheScanAndItsUnit) {
  struct Case {
    double set, odd;
    const char* remedy;
  };
  for (const Case& c : {Case{1, 1000, "--unit 2=mm"},
                        {1, 1 / kMPerFt, "--unit 2=ft"},
                        {1000, 1, "--unit mm --unit 2=m"},
                        {1 / kMPerFt, 1, "--unit ft --unit 2=m"},
                        {1 / kMPerFt, 1000, "--unit ft --unit 2=mm"},
                        {1000, 1 / kMPerFt, "--unit mm --unit 2=ft"}}) {
    auto scans = street();
    for (auto& s : scans) multiply(s, &s == &scans[2] ? c.odd : c.set);
    const auto doubts = unit_doubts(scans);
    ASSERT_EQ(doubts.size(), 1U) << c.remedy;
    EXPECT_EQ(doubts[0].find("2: "), 0U) << doubts[0];
    EXPECT_TRUE(doubts[0].ends_with("say " + std::string(c.remedy))) << doubts[0];
  }
}

TEST(UnitDoubts, SeveralScansDoNotHideOneAnother) {
  auto scans = street();
  multiply(scans[1], 1000);
  multiply(scans[3], 1000);
  EXPECT_EQ(unit_doubts(scans).size(), 2U);
}

TEST(UnitDoubts, OfTwoScansTheLargerIsNamed) {
  const auto doubts = unit_doubts({scan("a", 20, 0.1, 0.004), scan("b", 20, 0.1, 0.004, 1000)});
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts[0].find("b: "), 0U) << doubts[0];
}

TEST(UnitDoubts, ARoomOfAnotherSizeIsInTheSameUnit) {
  // Three times as large, three times as sparse, the same instrument.
  EXPECT_TRUE(unit_doubts({scan("hall", 20, 0.1, 0.004), scan("closet", 20 * kMPerFt, 0.1 * kMPerFt, 0.004)}).empty());
  EXPECT_TRUE(unit_doubts({scan("a", 6, 0.03, 0.003), scan("b", 20, 0.1, 0.004), scan("c", 7, 0.03, 0.003),
                           scan("d", 18, 0.09, 0.005), scan("e", 22, 0.1, 0.003)})
                  .empty());
}

TEST(UnitDoubts, OtherRatiosAreNoUnits) {
  for (const double factor : {10.0, 100.0, 30.0}) {
    auto scans = street();
    multiply(scans[0], factor);
    EXPECT_TRUE(unit_doubts(scans).empty()) << factor;
  }
}

TEST(UnitDoubts, FiguresThatAreNotKnownDoNotCount) {
  auto scans = street();
  for (auto& s : scans) s.noise_m = 0;
  EXPECT_TRUE(unit_doubts(scans).empty());
  multiply(scans[4], 1000);
  const auto doubts = unit_doubts(scans);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts[0].find("noise"), std::string::npos) << doubts[0];
  EXPECT_TRUE(unit_doubts({}).empty());
  EXPECT_TRUE(unit_doubts({scan("alone", 20, 0.1, 0.004)}).empty());
  EXPECT_TRUE(unit_doubts({scan("a", 0, 0, 0), scan("b", 0, 0, 0)}).empty());
}

SampledScan sampled(const std::string& file, Points points) {
  SampledScan s;
  s.scan.file = file;
  s.scan.num_raw_points = points.size();
  s.scan.cloud.points = std::move(points);
  return s;
}

TEST(Twins, AreFoundByTheirPoints) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  Points other = points;
  other[2].y() = std::nextafter(1.0, 2.0);
  const std::vector<SampledScan> scans{sampled("a", points), sampled("b", other), sampled("c", points)};
  const auto twins = find_twins(scans);
  ASSERT_EQ(twins.size(), 1U);
  EXPECT_EQ(twins[0], std::pair(std::string("c"), std::string("a")));
  EXPECT_THROW(refuse_twins(scans), std::exception);
  EXPECT_NO_THROW(refuse_twins({scans[0], scans[1]}));
}

TEST(Twins, AtAnotherOriginAreOtherPoints) {
  std::vector<SampledScan> scans{sampled("a", {{0, 0, 0}, {1, 0, 0}}), sampled("b", {{0, 0, 0}, {1, 0, 0}})};
  scans[1].scan.origin.x() = 5;
  EXPECT_TRUE(find_twins(scans).empty());
}

}  // namespace
}  // namespace tcm_icp
