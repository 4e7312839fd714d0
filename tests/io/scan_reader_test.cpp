#include "tcm_icp/io/scan_reader.hpp"

#include <gtest/gtest.h>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using test::error_of;
using test::read_whole;
using test::TempFolder;

TEST(ScanReader, FormatGoesByTheExtensionInAnyCase) {
  const TempFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 "
      "3\n";
  EXPECT_EQ(read_whole(folder.write("a.PLY", ply)).block.points, Points({{1, 2, 3}}));
  for (const char* const name : {"a.xyz", "a.TXT", "a.Asc", "a.pts", "a.csv"}) {
    EXPECT_EQ(read_whole(folder.write(name, "1 2 3\n")).block.points, Points({{1, 2, 3}})) << name;
  }
}

TEST(ScanReader, FilesThatCannotBeOpenedAreErrors) {
  const TempFolder folder;
  const auto message = [&](const std::filesystem::path& path) {
    return error_of<InputError>([&] { const ScanReader reader(path); });
  };
  EXPECT_NE(message(folder.path() / "none.ply").find("none.ply: there is no such file"), std::string::npos);
  EXPECT_NE(message(folder.path()).find("is a folder"), std::string::npos);
  std::filesystem::create_directory(folder.path() / "folder.ply");
  EXPECT_NE(message(folder.path() / "folder.ply").find("is a folder"), std::string::npos);
  EXPECT_NE(message(folder.write("empty.xyz", "")).find("is empty"), std::string::npos);
  EXPECT_NE(message(folder.write("a.laz", "LASF")).find("unknown extension '.laz'"), std::string::npos);
}

TEST(ScanReader, ABlockHoldsAtMostWhatWasAskedForAndNeverNothing) {
  const TempFolder folder;
  ScanReader reader(folder.write("a.xyz", "nan 0 0\n1 0 0\n2 0 0\n0 inf 0\n3 0 0\n0 0 -inf\n"));
  PointBlock block;
  EXPECT_THROW(reader.read(block, 0), InvalidOptions);
  ASSERT_TRUE(reader.read(block, 2));
  EXPECT_EQ(block.points, Points({{1, 0, 0}, {2, 0, 0}}));
  ASSERT_TRUE(reader.read(block, 2));
  EXPECT_EQ(block.points, Points({{3, 0, 0}}));
  EXPECT_FALSE(reader.read(block, 2));
  EXPECT_FALSE(reader.read(block, 2));
  EXPECT_EQ(reader.num_points(), 3u);
  EXPECT_EQ(reader.num_dropped(), 3u);
}

}  // namespace
}  // namespace tcm_icp
