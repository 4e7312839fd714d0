// PTX files as they are written: line by line as the format has them, and read back by our reader.

#include <gtest/gtest.h>

#include <cstring>

#include "io/binary_text.hpp"
#include "io/cloud_blocks.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_colour.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::joined;
using test::packed;
using test::read_text;
using test::read_whole;
using test::TempFolder;
using test::to_utm;
using test::WholeScan;
using enum ScalarType;

RegisteredCloudOptions ptx_options() {
  RegisteredCloudOptions options;
  options.format = CloudFormat::kPtx;
  options.reference = "a.ply";
  return options;
}

const std::vector<Attribute> kColoured = {
    {"red", kUInt8}, {"green", kUInt8}, {"blue", kUInt8}, {"intensity", kFloat32}, {"time", kFloat64}};

std::string attributes_of(int red, float intensity) {
  return joined(static_cast<std::uint8_t>(red), std::uint8_t{20}, std::uint8_t{255}, intensity, 1e9);
}

TEST(PtxWriting, HasACloudForEachScanWithItsPoseForPointsAsRows) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();  // 90 degrees about z, then (10, 20, 30)
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T.translation() << 10, 20, 30.5;
  RegisteredCloudWriter writer(path, {kColoured, {}}, ptx_options());
  writer.write(0, {{{1, -2.5, 1e-3}}, packed(attributes_of(7, 0.1F))}, kColoured, Eigen::Isometry3d::Identity());
  writer.write(0, {{{4, 5, 6}}, packed(attributes_of(8, 1))}, kColoured, Eigen::Isometry3d::Identity());
  writer.write(1, {{{0.1, 0, 3}}, {}}, {}, T);
  writer.finish();
  EXPECT_EQ(writer.num_points(), 3u);
  const std::string blanks(19, ' ');
  EXPECT_EQ(read_text(path), "2" + blanks +
                                 "\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                 "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
                                 "1 -2.5 0.001 0.1 7 20 255\n4 5 6 1 8 20 255\n"
                                 "1" +
                                 blanks +
                                 "\n1\n10 20 30.5\n0 1 0\n-1 0 0\n0 0 1\n"
                                 "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30.5 1\n"
                                 "0.1 0 3 0.5\n");
}

TEST(PtxWriting, IsReadBackToTheBit) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  Rng rng = make_stream(5, "ptx_writing");
  PointBlock block;
  std::string bytes;
  for (int i = 0; i < 1000; ++i) {
    block.points.emplace_back(2e3 * uniform01(rng) - 1e3, 5e6 + uniform01(rng), 1e-12 * uniform01(rng));
    bytes += attributes_of(i % 256, static_cast<float>(uniform01(rng)));
  }
  block.attributes = packed(bytes);
  RegisteredCloudWriter writer(path, {{}, kColoured}, ptx_options());
  writer.write(1, block, kColoured, to_utm());
  writer.write(0, {{{1, 2, 3}}, {}}, {}, Eigen::Isometry3d::Identity());
  writer.finish();
  const auto scans = scans_in(path);
  ASSERT_EQ(scans.size(), 2u);
  const WholeScan read = read_whole(scans[0]);
  ASSERT_EQ(read.block.points, block.points);
  for (const std::size_t i : {0U, 255U, 999U}) {
    float intensity = 0;
    std::memcpy(&intensity, bytes.data() + i * 15 + 3, sizeof intensity);
    EXPECT_EQ(attribute_of<float>(read, i, "intensity"), intensity);
    EXPECT_EQ(attribute_of<std::uint8_t>(read, i, "red"), i % 256);
    EXPECT_EQ(attribute_of<std::uint8_t>(read, i, "blue"), 255);
  }
  const auto pose = ScanReader(scans[0]).header_pose();
  ASSERT_TRUE(pose.has_value());
  EXPECT_TRUE(pose->isApprox(to_utm(), 1e-15));
}

TEST(PtxWriting, APointAtTheOriginIsNoEmptyCell) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  RegisteredCloudWriter writer(path, {{}}, ptx_options());
  writer.write(0, {{{0, 0, 0}, {-0.0, 0, 0}, {0, 0, 1}}, {}}, {}, Eigen::Isometry3d::Identity());
  writer.finish();
  const WholeScan scan = read_whole(path);
  EXPECT_EQ(scan.num_dropped, 0u);
  const Points expected{{1e-9, 0, 0}, {1e-9, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(scan.block.points, expected);
}

TEST(PtxWriting, WholeNumbersBecomeTheRangesOfTheFormat) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  const std::vector<Attribute> shorts = {
      {"intensity", kUInt16}, {"red", kUInt16}, {"green", kUInt16}, {"blue", kUInt16}};
  const std::vector<Attribute> byte = {{"intensity", kUInt8}}, wide = {{"intensity", kFloat64}};
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  RegisteredCloudWriter writer(path, {shorts, byte, wide}, ptx_options());
  writer.write(
      0,
      {{{1, 0, 0}},
       packed(joined(std::uint16_t{65535}, std::uint16_t{65535}, std::uint16_t{257 * 9 + 100}, std::uint16_t{0}))},
      shorts, identity);
  writer.write(1, {{{1, 0, 0}}, packed(joined(std::uint8_t{51}))}, byte, identity);
  writer.write(2, {{{1, 0, 0}}, packed(joined(-1234.5))}, wide, identity);
  writer.finish();
  const std::string text = read_text(path);
  EXPECT_NE(text.find("\n1 0 0 1 255 9 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n1 0 0 0.2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n1 0 0 -1234.5\n"), std::string::npos) << text;
}

TEST(PtxWriting, ColourByScanIsThatOfTheScan) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  RegisteredCloudOptions options = ptx_options();
  options.colour = CloudColour::kScan;
  RegisteredCloudWriter writer(path, {{}, kColoured}, options);
  writer.write(1, {{{1, 0, 0}}, packed(attributes_of(7, 0.25F))}, kColoured, Eigen::Isometry3d::Identity());
  writer.finish();
  const WholeScan scan = read_whole(path);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "red"), scan_colour(1)[0]);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "green"), scan_colour(1)[1]);
  EXPECT_EQ(attribute_of<float>(scan, 0, "intensity"), 0.25F);
}

TEST(PtxWriting, AScanThatComesAgainIsOneMoreCloud) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  RegisteredCloudWriter writer(path, {{}, {}}, ptx_options());
  for (const std::size_t scan : {0U, 1U, 0U}) {
    writer.write(scan, {{{1.0 + static_cast<double>(scan), 0, 0}}, {}}, {}, to_utm());
  }
  writer.finish();
  EXPECT_EQ(scans_in(path).size(), 3u);
}

TEST(PtxWriting, WithoutPointsThereIsOneEmptyCloud) {
  const TempFolder folder;
  const auto path = folder.path() / "out.ptx";
  RegisteredCloudWriter writer(path, {kColoured}, ptx_options());
  writer.finish();
  ASSERT_EQ(scans_in(path).size(), 1u);
  EXPECT_EQ(read_whole(path).block.size(), 0u);
}

TEST(PtxWriting, AFileThatCannotBeWrittenIsAnError) {
  const TempFolder folder;
  EXPECT_NE(error_of<OutputError>([&] {
              RegisteredCloudWriter(folder.path() / "none" / "out.ptx", {{}}, ptx_options());
            }).find("out.ptx"),
            std::string::npos);
  if (!std::filesystem::exists("/dev/full")) return;
  EXPECT_THROW(
      {
        RegisteredCloudWriter writer("/dev/full", {{}}, ptx_options());
        writer.write(0, {{{1, 0, 0}}, {}}, {}, Eigen::Isometry3d::Identity());
        writer.finish();
      },
      OutputError);
}

}  // namespace
}  // namespace tcm_icp
