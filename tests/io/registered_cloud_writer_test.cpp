#include "tcm_icp/io/registered_cloud_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/cloud_blocks.hpp"
#include "io/ply_text.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::bytes_of;
using test::error_of;
using test::packed;
using test::read_text;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

const double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Isometry3d large_motion() {
  Twist twist;
  twist << 0.7, -1.1, 2.0, 10, -20, 30;
  return isometry_from_twist(twist);
}

TEST(RegisteredCloudWriter, PointsAreMovedAndCarryScanAndColour) {
  const TempFolder folder;
  const auto path = folder.path() / "registered.ply";
  RegisteredCloudWriter writer(path, {{}, {}}, {.reference = "b.ply"});
  const Eigen::Isometry3d T = large_motion();
  writer.write(1, {{{1, 2, 3}, {4, 5, 6}}, {}}, {}, T);
  writer.write(0, {{{7, 8, 9}}, {}}, {}, Eigen::Isometry3d::Identity());
  writer.finish();
  EXPECT_EQ(writer.num_points(), 3u);
  const WholeScan scan = read_whole(path);
  ASSERT_EQ(scan.block.size(), 3u);
  EXPECT_LT((scan.block.points[0] - T * Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((scan.block.points[1] - T * Eigen::Vector3d(4, 5, 6)).norm(), 1e-12);
  EXPECT_EQ(scan.block.points[2], Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "scan"), 1);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 2, "scan"), 0);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "red"), scan_colour(1)[0]);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 2, "green"), scan_colour(0)[1]);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 2, "blue"), scan_colour(0)[2]);
  EXPECT_NE(read_text(path).find("comment frame: that of the scan b.ply\n"), std::string::npos);
  EXPECT_NE(read_text(path).find("\nelement vertex 3\n"), std::string::npos);
}

TEST(RegisteredCloudWriter, WithoutFinishTheFileHoldsNoPoints) {
  const TempFolder folder;
  const auto path = folder.path() / "registered.ply";
  {
    RegisteredCloudWriter writer(path, {{}}, {.reference = "a.ply"});
    writer.write(0, {{{1, 2, 3}}, {}}, {}, Eigen::Isometry3d::Identity());
  }
  EXPECT_EQ(read_whole(path).block.size(), 0u);
}

TEST(RegisteredCloudWriter, AttributesAreUnitedWidenedAndRenamed) {
  const TempFolder folder;
  const auto path = folder.path() / "registered.ply";
  const std::vector<Attribute> a = {{"intensity", ScalarType::kUInt8}, {"red", ScalarType::kUInt8}};
  const std::vector<Attribute> b = {{"time", ScalarType::kFloat64},
                                    {"intensity", ScalarType::kInt16},
                                    {"scan", ScalarType::kInt32},
                                    {"input_red", ScalarType::kUInt8}};
  RegisteredCloudWriter writer(path, {a, b}, {.reference = "a.ply"});
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  writer.write(0, {{{0, 0, 0}}, packed("\xC8\x07")}, a, identity);
  writer.write(1,
               {{{1, 1, 1}}, packed(bytes_of(0.1) + bytes_of(std::int16_t{-5}) + bytes_of(std::int32_t{99}) + "\x03")},
               b, identity);
  writer.finish();
  const WholeScan scan = read_whole(path);
  const std::vector<Attribute> expected = {
      {"scan", ScalarType::kUInt16},  {"red", ScalarType::kUInt8},        {"green", ScalarType::kUInt8},
      {"blue", ScalarType::kUInt8},   {"intensity", ScalarType::kInt16},  {"input_input_red", ScalarType::kUInt8},
      {"time", ScalarType::kFloat64}, {"input_scan", ScalarType::kInt32}, {"input_red", ScalarType::kUInt8},
  };
  ASSERT_EQ(scan.attributes, expected);
  EXPECT_EQ(attribute_of<std::int16_t>(scan, 0, "intensity"), 200);
  EXPECT_EQ(attribute_of<std::int16_t>(scan, 1, "intensity"), -5);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "input_input_red"), 7);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "input_red"), 3);
  EXPECT_EQ(attribute_of<double>(scan, 0, "time"), 0);
  EXPECT_EQ(attribute_of<double>(scan, 1, "time"), 0.1);
  EXPECT_EQ(attribute_of<std::int32_t>(scan, 1, "input_scan"), 99);
}

TEST(RegisteredCloudWriter, TypesThatDifferAreWidenedToOneThatHoldsBoth) {
  using enum ScalarType;
  const TempFolder folder;
  const std::vector<std::array<ScalarType, 3>> cases = {
      {kInt8, kUInt8, kInt16},       {kUInt16, kInt16, kInt32},    {kUInt32, kInt8, kFloat64},
      {kUInt16, kFloat32, kFloat32}, {kInt32, kFloat32, kFloat64}, {kFloat32, kFloat64, kFloat64},
      {kUInt8, kUInt32, kUInt32},    {kInt32, kInt32, kInt32},
  };
  for (const auto& [first, second, expected] : cases) {
    for (const auto& pair : {std::array{first, second}, std::array{second, first}}) {
      const auto path = folder.path() / "a.ply";
      RegisteredCloudWriter(path, {{{"v", pair[0]}}, {{"v", pair[1]}}}, {.reference = "a.ply"}).finish();
      EXPECT_EQ(ScanReader(path).attributes().back(), (Attribute{"v", expected}));
    }
  }
}

TEST(RegisteredCloudWriter, MoreScansThanAShortCanCountGetAWiderIndex) {
  const TempFolder folder;
  const auto type_of = [&](std::size_t num_scans) {
    const auto path = folder.path() / "a.ply";
    RegisteredCloudWriter(path, std::vector<std::vector<Attribute>>(num_scans), {.reference = "a.ply"}).finish();
    return ScanReader(path).attributes().at(0);
  };
  EXPECT_EQ(type_of(65536), (Attribute{"scan", ScalarType::kUInt16}));
  EXPECT_EQ(type_of(65537), (Attribute{"scan", ScalarType::kUInt32}));
}

TEST(RegisteredCloudWriter, NormalsTurnWithTheirScan) {
  const TempFolder folder;
  const auto path = folder.path() / "registered.ply";
  const std::vector<Attribute> attributes = {
      {"nz", ScalarType::kFloat32}, {"nx", ScalarType::kFloat32}, {"ny", ScalarType::kFloat32}};
  RegisteredCloudWriter writer(path, {attributes}, {.reference = "a.ply"});
  const Eigen::Isometry3d T = large_motion();
  const std::string normal = bytes_of(0.8F) + bytes_of(0.6F) + bytes_of(0.0F);
  writer.write(0, {{{1, 2, 3}}, packed(normal)}, attributes, T);
  writer.finish();
  const WholeScan scan = read_whole(path);
  const Eigen::Vector3d turned(attribute_of<float>(scan, 0, "nx"), attribute_of<float>(scan, 0, "ny"),
                               attribute_of<float>(scan, 0, "nz"));
  const Eigen::Vector3d raw(0.6, 0, 0.8);
  constexpr double kFloatRounding = 1e-6;
  ASSERT_GT((raw - T.linear() * raw).norm(), 0.1);
  EXPECT_LT((turned - T.linear() * raw).norm(), kFloatRounding);
}

TEST(RegisteredCloudWriter, NoNanIsWritten) {
  const TempFolder folder;
  const auto path = folder.path() / "registered.ply";
  const std::vector<Attribute> attributes = {{"a", ScalarType::kFloat32},
                                             {"b", ScalarType::kFloat64},
                                             {"nx", ScalarType::kFloat64},
                                             {"ny", ScalarType::kFloat64},
                                             {"nz", ScalarType::kFloat64}};
  RegisteredCloudWriter writer(path, {attributes}, {.reference = "a.ply"});
  const std::string values = bytes_of(std::numeric_limits<float>::infinity()) + bytes_of(kNan) + bytes_of(kNan) +
                             bytes_of(0.0) + bytes_of(1.0);
  writer.write(0, {{{1, 2, 3}}, packed(values)}, attributes, Eigen::Isometry3d::Identity());
  writer.finish();
  EXPECT_EQ(writer.num_replaced(), 3u);
  const WholeScan scan = read_whole(path);
  EXPECT_EQ(attribute_of<float>(scan, 0, "a"), 0);
  EXPECT_EQ(attribute_of<double>(scan, 0, "b"), 0);
  EXPECT_EQ(attribute_of<double>(scan, 0, "nx"), 0);
  EXPECT_EQ(attribute_of<double>(scan, 0, "nz"), 1);
}

TEST(RegisteredCloudWriter, FarFromTheOriginATenthOfAMillimetreSurvives) {
  const TempFolder folder;
  std::string text;
  Rng rng = make_stream(1, "large_coordinates");
  Points points;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p(500000 + 100 * uniform01(rng), 5000000 + 100 * uniform01(rng), 100 * uniform01(rng));
    points.push_back(p);
    char line[128];
    std::snprintf(line, sizeof(line), "%.4f %.4f %.4f\n", p.x(), p.y(), p.z());
    text += line;
  }
  const auto in = folder.write("in.xyz", text), out = folder.path() / "out.ply";
  // To the neighbour's frame, equally far away: a turn about a point of the scan.
  Twist twist;
  twist << 0.3, -0.2, 2.5, 12, -30, 4;
  const Eigen::Isometry3d T = isometry_about({500050, 5000050, 50}, twist);
  ScanReader reader(in);
  RegisteredCloudWriter writer(out, {reader.attributes()}, {.reference = "in.xyz"});
  PointBlock block;
  while (reader.read(block, 300)) writer.write(0, block, reader.attributes(), T);
  writer.finish();
  const Points moved = read_whole(out).block.points;
  ASSERT_EQ(moved.size(), points.size());
  const Eigen::Matrix<long double, 3, 3> R = T.linear().cast<long double>();
  const Eigen::Matrix<long double, 3, 1> t = T.translation().cast<long double>();
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Matrix<long double, 3, 1> exact = R * points[i].cast<long double>() + t;
    worst = std::max(worst, static_cast<double>((moved[i].cast<long double>() - exact).norm()));
  }
  constexpr double kTextRounding = 0.9e-4;  // half a tenth of a millimetre on each of three axes
  EXPECT_LT(worst, kTextRounding);
  EXPECT_GT(worst, 1e-6);  // the rounding of the text: were it 0, nothing had been compared
}

TEST(RegisteredCloudWriter, MisuseIsRefused) {
  const TempFolder folder;
  const std::vector<Attribute> attributes = {{"i", ScalarType::kUInt8}};
  RegisteredCloudWriter writer(folder.path() / "a.ply", {attributes}, {.reference = "a.ply"});
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  EXPECT_THROW(writer.write(1, {{{1, 2, 3}}, packed("i")}, attributes, identity), InvalidInput);
  EXPECT_THROW(writer.write(0, {{{1, 2, 3}}, {}}, attributes, identity), InvalidInput);
  EXPECT_THROW(writer.write(0, {{{1, 2, 3}}, {}}, {}, identity), InvalidInput);
  EXPECT_THROW(writer.write(0, {{{1, kNan, 3}}, packed("i")}, attributes, identity), InvalidInput);
  EXPECT_EQ(writer.num_points(), 0u);
}

TEST(RegisteredCloudWriter, AFileThatCannotBeWrittenIsAnError) {
  const TempFolder folder;
  EXPECT_THROW(RegisteredCloudWriter(folder.path() / "none" / "a.ply", {{}}, {.reference = "a.ply"}), OutputError);
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const auto fill = [] {
    RegisteredCloudWriter writer("/dev/full", {{}}, {.reference = "a.ply"});
    writer.write(0, {Points(10, Eigen::Vector3d(1, 2, 3)), {}}, {}, Eigen::Isometry3d::Identity());
    writer.finish();
  };
  EXPECT_NE(error_of<OutputError>(fill).find("/dev/full: cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
