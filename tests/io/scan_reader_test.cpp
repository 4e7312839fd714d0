#include "tcm_icp/io/scan_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "io/ply_text.hpp"
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
  EXPECT_NE(message(folder.write("a.foo", "LAS")).find("extension '.foo'"), std::string::npos);
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

TEST(ScanReader, SmallBlocksGiveTheSameAsOneBlock) {
  const TempFolder folder;
  constexpr std::size_t kCount = 200'000;  // several buffers long in every format
  std::string ascii = test::ply_header("ascii", test::xyz_vertices(kCount) + "property uint i\n");
  std::string binary =
      test::ply_header("binary_big_endian", test::xyz_vertices(kCount, "double") + "property uint i\n");
  std::string text;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double x = 0.125 * i, y = -0.5 * (i % 1000), z = i % 17 == 0 ? std::nan("") : 3;
    const std::string line =
        std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " " + std::to_string(i) + "\n";
    ascii += line;
    text += line;
    for (const double value : {x, y, z}) binary += test::bytes_of(value, test::Order::kBig);
    binary += test::bytes_of(i, test::Order::kBig);
  }
  for (const auto& path : {folder.write("a.ply", ascii), folder.write("b.ply", binary), folder.write("c.xyz", text)}) {
    const auto whole = read_whole(path);
    ASSERT_EQ(whole.block.size() + whole.num_dropped, kCount);
    EXPECT_EQ(whole.num_dropped, (kCount + 16) / 17);
    ScanReader reader(path);
    PointBlock block, joined;
    while (reader.read(block, 777)) {
      joined.points.insert(joined.points.end(), block.points.begin(), block.points.end());
      joined.attributes.insert(joined.attributes.end(), block.attributes.begin(), block.attributes.end());
    }
    EXPECT_EQ(joined.points, whole.block.points) << path;
    EXPECT_EQ(joined.attributes, whole.block.attributes) << path;
    EXPECT_EQ(joined.points[1000], Eigen::Vector3d(0.125 * 1063, -0.5 * 63, 3)) << path;  // 63 of 1063 were dropped
  }
}

}  // namespace
}  // namespace tcm_icp
