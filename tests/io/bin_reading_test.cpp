#include <gtest/gtest.h>

#include <string>

#include "io/binary_text.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_inputs.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::joined;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

TEST(BinReading, IsWhatItIsSaidToBe) {
  const TempFolder folder;
  const std::string bytes = joined(1.F, 2.F, 3.F, 0.5F, 4.F, 5.F, 6.F, 0.25F, 7.F, 8.F, 9.F, 1.F, 1.F, 1.F, 1.F, 1.F,
                                   2.F, 2.F, 2.F, 2.F);  // five points of four numbers, or four of five
  const auto path = folder.write("a.bin", bytes);
  const WholeScan kitti = read_whole(with_layout(path, BinLayout::kKitti));
  ASSERT_EQ(kitti.block.size(), 5u);
  EXPECT_EQ(kitti.block.points[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(attribute_of<float>(kitti, 1, "intensity"), 0.25F);
  const WholeScan nuscenes = read_whole(with_layout(path, BinLayout::kNuScenes));
  ASSERT_EQ(nuscenes.block.size(), 4u);
  EXPECT_EQ(nuscenes.block.points[1], Eigen::Vector3d(5, 6, 0.25));
  EXPECT_EQ(attribute_of<float>(nuscenes, 0, "ring"), 4);
}

TEST(BinReading, IsRefusedWhereNothingIsSaid) {
  const TempFolder folder;
  const auto path = folder.write("a.bin", joined(1.F, 2.F, 3.F, 0.5F));
  EXPECT_NE(error_of<InputError>([&] { read_whole(path); }).find("--bin kitti or --bin nuscenes"), std::string::npos);
  EXPECT_NE(error_of<InputError>([&] { find_scans({path}); }).find("--bin kitti"), std::string::npos);
  EXPECT_EQ(find_scans({path}, BinLayout::kKitti).scans.at(0).filename(), "a.bin#kitti");
  EXPECT_EQ(find_scans({folder.path()}, BinLayout::kKitti).scans.at(0).filename(), "a.bin#kitti");
}

TEST(BinReading, APartOfAPointIsRefused) {
  const TempFolder folder;
  const auto path = folder.write("a.bin", joined(1.F, 2.F, 3.F, 0.5F, 1.F));
  EXPECT_NE(
      error_of<InputError>([&] { read_whole(with_layout(path, BinLayout::kKitti)); }).find("whole number of points"),
      std::string::npos);
}

TEST(BinReading, OtherFilesStayWhatTheyAre) {
  const TempFolder folder;
  const auto path = folder.write("a.xyz", "1 2 3\n");
  EXPECT_EQ(with_layout(path, BinLayout::kKitti), path);
}

}  // namespace
}  // namespace tcm_icp
