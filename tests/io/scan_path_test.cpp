#include "tcm_icp/io/scan_path.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

using test::TempFolder;
using Names = std::vector<std::string>;
using Paths = std::vector<std::filesystem::path>;

constexpr const char* kTwoClouds = "1\n1 2 3\n2\n4 5 6\n7 8 9\n";

TEST(ScanPath, ANumberBehindTheFileIsTheScanInIt) {
  const ScanPath scan = parse_scan_path("some/hall.e57#12");
  EXPECT_EQ(scan.file, "some/hall.e57");
  EXPECT_EQ(scan.number, 12u);
}

TEST(ScanPath, AUnitMayStandBehindAllElse) {
  for (const auto& [text, number, bin, unit] :
       {std::tuple("hall.e57#2#mm", 2u, BinLayout::kNone, LengthUnit::kMillimetre),
        {"hall.e57#ft", 0u, BinLayout::kNone, LengthUnit::kFoot},
        {"hall.e57#kitti#us-ft", 0u, BinLayout::kKitti, LengthUnit::kUsFoot}}) {
    const ScanPath scan = parse_scan_path(text);
    EXPECT_EQ(scan.file, "hall.e57") << text;
    EXPECT_EQ(scan.number, number) << text;
    EXPECT_EQ(scan.bin, bin) << text;
    EXPECT_EQ(scan.unit, unit) << text;
    EXPECT_EQ(with_unit(text, unit), text);
  }
  EXPECT_EQ(with_unit("hall.e57#2#mm", LengthUnit::kMetre), "hall.e57#2");
  EXPECT_EQ(with_unit("hall.e57", LengthUnit::kFoot), "hall.e57#ft");
  EXPECT_EQ(parse_scan_path("hall.e57#mm#2").file, "hall.e57#mm") << "not in front";
  EXPECT_EQ(scan_names({"a/1.ply#mm", "a/2.ply#1#ft"}), Names({"1.ply", "2.ply#1"}));
}

TEST(ScanPath, UnitsAreReadAsMetres) {
  const TempFolder folder;
  const auto path = folder.write("a.xyz", "1000 2000 -3000\n");
  PointBlock block;
  ScanReader reader(with_unit(path, LengthUnit::kMillimetre), ReadAttributes::kNo);
  ASSERT_TRUE(reader.read(block));
  // A rounding each of 0.001 and of the product.
  EXPECT_LT((block.points[0] - Eigen::Vector3d(1, 2, -3)).norm(), 1e-15 * Eigen::Vector3d(1, 2, -3).norm());
  EXPECT_EQ(metres_in(LengthUnit::kUsFoot) * 3937, 1200);
  EXPECT_FALSE(unit_from_name("feet"));
}

TEST(ScanPath, WhatIsNoNumberBelongsToTheName) {
  for (const char* const name : {"hall.e57", "hall#.e57", "hall.e57#", "hall.e57#0", "hall.e57#1a", "hall.e57#-1"}) {
    EXPECT_EQ(parse_scan_path(name).file, name);
    EXPECT_EQ(parse_scan_path(name).number, 0u) << name;
  }
}

TEST(ScanPath, AFileOfTheWholeNameComesFirst) {
  const TempFolder folder;
  const auto path = folder.write("a.xyz#2", kTwoClouds);
  EXPECT_EQ(parse_scan_path(path).file, path);
  EXPECT_EQ(parse_scan_path(path).number, 0u);
}

TEST(ScansIn, AFileOfOneScanIsThatScan) {
  const TempFolder folder;
  const auto path = folder.write("a.pts", "1\n1 2 3\n");
  EXPECT_EQ(scans_in(path), Paths({path}));
}

TEST(ScansIn, AFileOfSeveralBecomesAllOfThem) {
  const TempFolder folder;
  const auto path = folder.write("a.pts", kTwoClouds);
  const Paths scans = scans_in(path);
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].filename(), "a.pts#1");
  EXPECT_EQ(test::read_whole(scans[0]).block.points, Points({{1, 2, 3}}));
  EXPECT_EQ(test::read_whole(scans[1]).block.points, Points({{4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(scans_in(scans[1]), Paths({scans[1]}));
}

TEST(ScansIn, CloudsFarBehindInAFileAreFound) {
  const TempFolder folder;
  std::string text;
  constexpr int kCount = 200'000;  // longer than what is read ahead
  for (int cloud = 1; cloud <= 3; ++cloud) {
    text += std::to_string(kCount) + "\n";
    for (int i = 0; i < kCount; ++i) text += std::to_string(cloud) + " 0.5 " + std::to_string(i) + "\n";
  }
  const auto path = folder.write("a.pts", text + "\n");
  const auto scans = scans_in(path);
  ASSERT_EQ(scans.size(), 3u);
  const Points last = test::read_whole(scans[2]).block.points;
  ASSERT_EQ(last.size(), static_cast<std::size_t>(kCount));
  EXPECT_EQ(last.front(), Eigen::Vector3d(3, 0.5, 0));
  EXPECT_EQ(last.back(), Eigen::Vector3d(3, 0.5, kCount - 1));
  folder.write("a.pts", text + "1 x 3\n");  // one line more, and damaged
  const auto damaged = scans_in(path).at(2);
  EXPECT_NE(test::error_of<InputError>([&] { test::read_whole(damaged); }).find("line 600004"), std::string::npos)
      << "lines are counted from the start of the file";
}

TEST(ScansIn, OneOfSeveralMustBeNamed) {
  const TempFolder folder;
  const auto path = folder.write("a.pts", kTwoClouds);
  const auto message = [](const std::filesystem::path& scan) {
    return test::error_of<InputError>([&] { test::read_whole(scan); });
  };
  EXPECT_NE(message(path).find("line 3: begins a second scan; name one of them, as a.pts#1"), std::string::npos);
  EXPECT_NE(message(path.string() + "#3").find("has no scan 3: it holds 2"), std::string::npos);
}

TEST(ScanNames, AreFileNamesWhereTheyDiffer) {
  EXPECT_EQ(scan_names({"a/one.ply", "b/two.ply", "hall.e57#1", "hall.e57#2"}),
            Names({"one.ply", "two.ply", "hall.e57#1", "hall.e57#2"}));
}

TEST(ScanNames, TakeAsMuchOfThePathAsTellsEqualNamesApart) {
  EXPECT_EQ(scan_names({"/x/Setup1/scan.ply", "/x/Setup2/scan.ply", "/x/other.ply"}),
            Names({"Setup1/scan.ply", "Setup2/scan.ply", "other.ply"}));
  EXPECT_EQ(scan_names({"/x/day1/s/scan.ply", "/x/day2/s/scan.ply", "/x/day2/t/scan.ply"}),
            Names({"day1/s/scan.ply", "day2/s/scan.ply", "day2/t/scan.ply"}));
}

TEST(ScanNames, DoNotSayHowAFileIsRead) {
  EXPECT_EQ(scan_names({"a/000.bin#kitti", "a/001.bin#nuscenes"}), Names({"000.bin", "001.bin"}));
  EXPECT_EQ(scan_names({"a/0.bin#kitti", "b/0.bin#kitti"}), Names({"a/0.bin", "b/0.bin"}));
}

TEST(ScanNames, HaveNoWayUpInThem) {
  const Names names = scan_names({"../scan.ply", "scan.ply", "./sub/../other/scan.ply"});
  for (const auto& name : names) EXPECT_EQ(name.find(".."), std::string::npos) << name;
  EXPECT_NE(names[0], names[1]);
  EXPECT_EQ(names[2], "other/scan.ply");
}

}  // namespace
}  // namespace tcm_icp
