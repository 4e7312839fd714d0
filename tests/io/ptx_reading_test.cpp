#include <gtest/gtest.h>

#include <string>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

// 90 degrees about z, then (10, 20, 30); points are rows there.
const std::string kPose = "10 20 30\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
const std::string kCells = "1 2 3 0.25 10 20 30\n0 0 0 0.5 0 0 0\n4 5 6 1 255 0 7\n-1 0 0 0 1 2 3\n";

TEST(PtxReading, CellsWithAReturnArePoints) {
  const TempFolder folder;
  const WholeScan scan = read_whole(folder.write("a.ptx", "2\n2\n" + kPose + kCells));
  EXPECT_EQ(scan.block.points, Points({{1, 2, 3}, {4, 5, 6}, {-1, 0, 0}}));
  EXPECT_EQ(scan.num_dropped, 1u);
  EXPECT_EQ(attribute_of<float>(scan, 1, "intensity"), 1);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "red"), 255);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "blue"), 30);
}

TEST(PtxReading, ThePoseIsToldAndNotApplied) {
  const TempFolder folder;
  ScanReader reader(folder.write("a.ptx", "2\n2\n" + kPose + kCells));
  const auto pose = reader.header_pose();
  ASSERT_TRUE(pose.has_value());
  EXPECT_TRUE((*pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(10, 21, 30), 1e-12));
  EXPECT_TRUE((*pose * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(9, 20, 30), 1e-12));
}

TEST(PtxReading, AScaledPoseIsRefusedWhereItIsAskedFor) {
  const TempFolder folder;
  const std::string scaled = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n";
  ScanReader reader(folder.write("a.ptx", "1\n1\n" + scaled + "1 2 3\n"));
  EXPECT_NE(error_of<InputError>([&] { (void)reader.header_pose(); }).find("not a rigid motion"), std::string::npos);
  PointBlock block;
  EXPECT_TRUE(reader.read(block));
}

TEST(PtxReading, EachCloudIsAScan) {
  const TempFolder folder;
  const auto path = folder.write("a.ptx", "2\n2\n" + kPose + kCells + "1\n1\n" + kPose + "7 8 9 0.5\n");
  const auto scans = scans_in(path);
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(read_whole(scans[0]).block.size(), 3u);
  EXPECT_EQ(read_whole(scans[1]).block.points, Points({{7, 8, 9}}));
  EXPECT_EQ(read_whole(scans[1]).attributes.size(), 1u);
  EXPECT_NE(error_of<InputError>([&] { read_whole(path); }).find("begins a second scan"), std::string::npos);
}

TEST(PtxReading, TheContentTellsUnderTheNamesOfText) {
  const TempFolder folder;
  EXPECT_EQ(read_whole(folder.write("a.pts", "2\n2\n" + kPose + kCells)).block.size(), 3u);
}

TEST(PtxReading, WhatIsWrongIsNamedWithItsPlace) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    const auto path = folder.write("b.ptx", content);
    return error_of<InputError>([&] { read_whole(path); });
  };
  EXPECT_NE(message("1 2 3\n").find("line 1: is not the number of columns"), std::string::npos);
  EXPECT_NE(message("2\n2\n1 2\n").find("line 3: is not the scanner's position"), std::string::npos);
  EXPECT_NE(message("2\n2\n" + kPose + "1 2 3 0.5\n1 2 3\n").find("line 12: has 3 numbers"), std::string::npos);
  EXPECT_NE(message("2\n2\n" + kPose + "1 2 3\n1 2 x\n").find("line 12: 'x' is not a number"), std::string::npos);
  EXPECT_NE(message("2\n2\n" + kPose + "1 2 3\n1 2 3\n").find("after 2 of 4 cells"), std::string::npos);
  EXPECT_NE(message("1\n1\n" + kPose + "1 2 3 0.5 1 2 256\n").find("'256' is not a colour"), std::string::npos);
  EXPECT_NE(message("18446744073709551615\n2\n" + kPose).find("more cells than can be"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
