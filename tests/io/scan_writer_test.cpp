#include "tcm_icp/io/scan_writer.hpp"

#include "tcm_icp/core/error.hpp"
#include "temp_files.hpp"

namespace tcm_icp::test {
namespace {

/// Coordinates with more digits than a float has, and attributes of two types.
WholeScan some_scan() {
  WholeScan scan;
  scan.attributes = {{"intensity", ScalarType::kFloat32}, {"class", ScalarType::kUInt8}};
  scan.block.points = {{5123456.123456789, -0.1, 1e-9}, {1.0 / 3, 2, 3}};
  scan.block.attributes.resize(10);
  const float intensities[] = {0.25F, 0.1F};
  for (std::size_t i = 0; i < 2; ++i) {
    std::memcpy(scan.block.attributes.data() + 5 * i, &intensities[i], 4);
    scan.block.attributes[5 * i + 4] = std::byte{static_cast<unsigned char>(200 + i)};
  }
  return scan;
}

TEST(ScanWriter, WhatItWritesIsReadBackToTheLastBit) {
  const TempFolder folder;
  const WholeScan scan = some_scan();
  write_scan(folder.path() / "a.PLY", scan.block, scan.attributes);
  const WholeScan back = read_whole(folder.path() / "a.PLY");
  EXPECT_EQ(back.block.points, scan.block.points);
  EXPECT_EQ(back.attributes, scan.attributes);
  EXPECT_EQ(back.block.attributes, scan.block.attributes);
}

TEST(ScanWriter, TextKeepsNumbersAndNames) {
  const TempFolder folder;
  const WholeScan scan = some_scan();
  for (const char* name : {"a.xyz", "a.csv", "a.pts"}) {
    write_scan(folder.path() / name, scan.block, scan.attributes);
    const WholeScan back = read_whole(folder.path() / name);
    EXPECT_EQ(back.block.points, scan.block.points) << name;
    EXPECT_EQ(attribute_of<double>(back, 1, "class"), 201) << name;
    EXPECT_EQ(attribute_of<double>(back, 1, "intensity"), static_cast<double>(0.1F)) << name;
  }
}

TEST(ScanWriter, RefusesOtherExtensionsAndAttributesThatDoNotFit) {
  const TempFolder folder;
  const WholeScan scan = some_scan();
  EXPECT_THROW(write_scan(folder.path() / "a.las", scan.block, scan.attributes), InvalidInput);
  EXPECT_THROW(write_scan(folder.path() / "a.ply", scan.block, {}), InvalidInput);
  EXPECT_THROW(write_scan(folder.path() / "none" / "a.ply", scan.block, scan.attributes), OutputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace tcm_icp::test
