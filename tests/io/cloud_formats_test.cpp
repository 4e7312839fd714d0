// Registered clouds in each format, read back: by our readers, and LAS headers byte by byte as the standard has them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "io/binary_text.hpp"
#include "io/cloud_blocks.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_colour.hpp"

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

const std::vector<Attribute> kRich = {{"intensity", kUInt16}, {"red", kUInt8},        {"green", kUInt8},
                                      {"blue", kUInt8},       {"gps_time", kFloat64}, {"reflectance", kFloat32},
                                      {"label", kInt32},      {"scan", kUInt8}};

PointBlock rich_block() {
  const std::string a = joined(std::uint16_t{65535}, std::uint8_t{255}, std::uint8_t{128}, std::uint8_t{0}, 1.0 / 3,
                               0.1F, std::int32_t{-70000}, std::uint8_t{9});
  const std::string b = joined(std::uint16_t{1}, std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}, -1e300, -1e-30F,
                               std::int32_t{2147483647}, std::uint8_t{8});
  return {{{1, 2, 3}, {-40, 55.5, 0.125}}, packed(a + b)};
}

Eigen::AlignedBox3d box_of(const Points& points, const Eigen::Isometry3d& T) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(Eigen::Vector3d(T * p));
  return box;
}

RegisteredCloudOptions in_format(CloudFormat format) {
  RegisteredCloudOptions options;
  options.format = format;
  options.reference = "a.ply";
  return options;
}

/// A scan with attributes, then one without, of one point.
WholeScan written_and_read(const TempFolder& folder, RegisteredCloudOptions options,
                           const Eigen::Isometry3d& T = to_utm()) {
  const PointBlock rich = rich_block(), bare{{{10, 10, 10}}, {}};
  options.box = box_of(rich.points, T);
  options.box.extend(box_of(bare.points, T));
  options.largest_step = 1e-4;
  const auto path = folder.path() / ("out" + std::string(extension_of(options.format)));
  RegisteredCloudWriter writer(path, {kRich, {}}, options);
  writer.write(0, rich, kRich, T);
  writer.write(1, bare, {}, T);
  writer.finish();
  EXPECT_EQ(writer.num_points(), 3U);
  return read_whole(path);
}

double worst_distance(const WholeScan& scan, const Eigen::Isometry3d& T) {
  const Points raw{{1, 2, 3}, {-40, 55.5, 0.125}, {10, 10, 10}};
  EXPECT_EQ(scan.block.size(), raw.size());
  double worst = 0;
  for (std::size_t i = 0; i < raw.size(); ++i) worst = std::max(worst, (scan.block.points[i] - T * raw[i]).norm());
  return worst;
}

TEST(CloudFormats, PlyKeepsAllBitForBit) {
  const TempFolder folder;
  const WholeScan scan = written_and_read(folder, in_format(CloudFormat::kPly));
  EXPECT_EQ(worst_distance(scan, to_utm()), 0);
  const std::vector<Attribute> expected = {{"scan", kUInt16},         {"red", kUInt8},        {"green", kUInt8},
                                           {"blue", kUInt8},          {"intensity", kUInt16}, {"gps_time", kFloat64},
                                           {"reflectance", kFloat32}, {"label", kInt32},      {"input_scan", kUInt8}};
  EXPECT_EQ(scan.attributes, expected);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "red"), 255);  // the scan's own
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "blue"), 3);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 2, "red"), 0);  // a scan without
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 2, "scan"), 1);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "input_scan"), 9);
}

TEST(CloudFormats, TextReadsBackToTheLastBit) {
  const TempFolder folder;
  const WholeScan scan = written_and_read(folder, in_format(CloudFormat::kText));
  EXPECT_EQ(worst_distance(scan, to_utm()), 0);
  EXPECT_TRUE(read_text(folder.path() / "out.xyz")
                  .starts_with("# x y z scan red green blue intensity gps_time reflectance label input_scan\n"));
  EXPECT_EQ(attribute_of<double>(scan, 0, "gps_time"), 1.0 / 3);
  EXPECT_EQ(attribute_of<double>(scan, 1, "gps_time"), -1e300);
  EXPECT_EQ(static_cast<float>(attribute_of<double>(scan, 0, "reflectance")), 0.1F);
  EXPECT_EQ(static_cast<float>(attribute_of<double>(scan, 1, "reflectance")), -1e-30F);
  EXPECT_EQ(attribute_of<double>(scan, 0, "label"), -70000);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "green"), 128);
}

TEST(CloudFormats, PcdHasDoublesOnlyWhereFloatsAreTooCoarse) {
  const TempFolder folder;
  const WholeScan far_away = written_and_read(folder, in_format(CloudFormat::kPcd));
  EXPECT_EQ(worst_distance(far_away, to_utm()), 0);
  EXPECT_NE(read_text(folder.path() / "out.pcd")
                .find("FIELDS x y z scan rgb intensity gps_time reflectance label input_scan\n"
                      "SIZE 8 8 8 2 4 2 8 4 4 1\nTYPE F F F U F U F F I U\n"),
            std::string::npos);
  Eigen::Isometry3d near_by = to_utm();
  near_by.translation() << 1, 2, 3;
  const WholeScan scan = written_and_read(folder, in_format(CloudFormat::kPcd), near_by);
  const double distance = worst_distance(scan, near_by);
  EXPECT_LT(distance, 1e-5);  // floats, up to 70 m
  EXPECT_GT(distance, 0);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "red"), 255);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "green"), 128);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "blue"), 3);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "intensity"), 65535);
  EXPECT_EQ(attribute_of<double>(scan, 0, "gps_time"), 1.0 / 3);
  EXPECT_EQ(attribute_of<float>(scan, 1, "reflectance"), -1e-30F);
  EXPECT_EQ(attribute_of<std::int32_t>(scan, 0, "label"), -70000);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 2, "scan"), 1);
}

TEST(CloudFormats, LasKeepsAttributesAndRoundsCoordinatesToItsScale) {
  const TempFolder folder;
  const WholeScan scan = written_and_read(folder, in_format(CloudFormat::kLas));
  constexpr double kScale = 5e-8;   // about 100 m in 32 bits
  constexpr double kDouble = 2e-9;  // at 5,000 km
  EXPECT_LT(worst_distance(scan, to_utm()), std::sqrt(3.0) * (kScale / 2 + kDouble));
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "intensity"), 65535);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "red"), 65535);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "green"), 128 * 257);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 1, "blue"), 3 * 257);
  EXPECT_EQ(attribute_of<double>(scan, 0, "gps_time"), 1.0 / 3);
  EXPECT_EQ(attribute_of<double>(scan, 1, "gps_time"), -1e300);
  EXPECT_EQ(attribute_of<float>(scan, 0, "reflectance"), 0.1F);
  EXPECT_EQ(attribute_of<float>(scan, 1, "reflectance"), -1e-30F);
  EXPECT_EQ(attribute_of<std::int32_t>(scan, 0, "label"), -70000);
  EXPECT_EQ(attribute_of<std::int32_t>(scan, 1, "label"), 2147483647);
  EXPECT_EQ(attribute_of<std::int32_t>(scan, 2, "label"), 0);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "input_scan"), 8);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "point_source_id"), 1);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 2, "point_source_id"), 2);
}

// The public header block of LAS 1.4, as table 3 of the standard has it.
#pragma pack(push, 1)
struct LasHeader14 {
  char signature[4];
  std::uint16_t source_id, global_encoding;
  std::uint32_t guid1;
  std::uint16_t guid2, guid3;
  std::uint8_t guid4[8], major, minor;
  char system[32], software[32];
  std::uint16_t day, year, header_size;
  std::uint32_t first_point, num_records;
  std::uint8_t point_format;
  std::uint16_t point_size;
  std::uint32_t legacy_points, legacy_by_return[5];
  double scale[3], offset[3], max_x, min_x, max_y, min_y, max_z, min_z;
  std::uint64_t waveforms, first_long_record;
  std::uint32_t num_long_records;
  std::uint64_t num_points, by_return[15];
};
struct LasPoint7 {
  std::int32_t x, y, z;
  std::uint16_t intensity;
  std::uint8_t returns, flags, classification, user_data;
  std::int16_t angle;
  std::uint16_t source_id;
  double time;
  std::uint16_t red, green, blue;
};
struct LasRecordHeader {
  std::uint16_t reserved;
  char user[16];
  std::uint16_t id, length;
  char description[32];
};
struct LasExtraEntry {
  std::uint16_t reserved;
  std::uint8_t type, options;
  char name[32];
  std::uint8_t rest[156];
};
#pragma pack(pop)
static_assert(sizeof(LasHeader14) == 375 && sizeof(LasPoint7) == 36 && sizeof(LasRecordHeader) == 54 &&
              sizeof(LasExtraEntry) == 192);

// Fields lie anywhere: a plus before them makes a copy, where an expectation would take a reference.
template <typename T>
T struct_at(const std::string& bytes, std::size_t at) {
  T value{};
  EXPECT_LE(at + sizeof value, bytes.size());
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(CloudFormats, TheLasFileIsAsTheStandardHasIt) {
  const TempFolder folder;
  written_and_read(folder, in_format(CloudFormat::kLas));
  const std::string file = read_text(folder.path() / "out.las");
  const auto header = struct_at<LasHeader14>(file, 0);
  EXPECT_EQ(std::string(header.signature, 4), "LASF");
  EXPECT_EQ(+header.major, 1);
  EXPECT_EQ(+header.minor, 4);
  EXPECT_EQ(+header.global_encoding, 16);
  EXPECT_STREQ(header.software, "tcm-icp");
  EXPECT_EQ(+header.header_size, 375);
  EXPECT_EQ(+header.num_records, 1U);
  EXPECT_EQ(+header.first_point, 375U + 54 + 3 * 192);
  EXPECT_EQ(+header.point_format, 7);
  EXPECT_EQ(+header.point_size, 36 + 4 + 4 + 1);
  EXPECT_EQ(+header.legacy_points, 0U);
  EXPECT_EQ(+header.num_points, 3U);
  EXPECT_EQ(+header.by_return[0], 3U);
  EXPECT_EQ(header.waveforms + header.first_long_record + header.num_long_records, 0U);
  ASSERT_EQ(file.size(), header.first_point + 3U * header.point_size);
  const auto record = struct_at<LasRecordHeader>(file, 375);
  EXPECT_STREQ(record.user, "LASF_Spec");
  EXPECT_EQ(+record.id, 4);
  EXPECT_EQ(+record.length, 3 * 192);
  const std::array<std::pair<const char*, int>, 3> extras{{{"reflectance", 9}, {"label", 6}, {"input_scan", 1}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto entry = struct_at<LasExtraEntry>(file, 375 + 54 + 192 * i);
    EXPECT_STREQ(entry.name, extras[i].first);
    EXPECT_EQ(+entry.type, extras[i].second);
    EXPECT_EQ(+entry.options, 0);
  }
  Eigen::AlignedBox3d box;
  const Points raw{{1, 2, 3}, {-40, 55.5, 0.125}, {10, 10, 10}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto point = struct_at<LasPoint7>(file, header.first_point + i * header.point_size);
    const Eigen::Vector3d p(point.x * header.scale[0] + header.offset[0], point.y * header.scale[1] + header.offset[1],
                            point.z * header.scale[2] + header.offset[2]);
    EXPECT_LT((p - to_utm() * raw[i]).norm(), 1e-7) << i;
    box.extend(p);
    EXPECT_EQ(+point.returns, 0x11);
    EXPECT_EQ(+point.source_id, i < 2 ? 1 : 2);
  }
  EXPECT_EQ(box.min(), Eigen::Vector3d(+header.min_x, +header.min_y, +header.min_z));
  EXPECT_EQ(box.max(), Eigen::Vector3d(+header.max_x, +header.max_y, +header.max_z));
}

TEST(CloudFormats, WhatALasFileHasComesBackAsItWas) {
  const TempFolder folder;
  const std::vector<Attribute> las = {{"intensity", kUInt16},
                                      {"return_number", kUInt8},
                                      {"number_of_returns", kUInt8},
                                      {"scanner_channel", kUInt8},
                                      {"scan_direction_flag", kUInt8},
                                      {"edge_of_flight_line", kUInt8},
                                      {"classification", kUInt8},
                                      {"classification_flags", kUInt8},
                                      {"user_data", kUInt8},
                                      {"scan_angle", kFloat32},
                                      {"point_source_id", kUInt16},
                                      {"gps_time", kFloat64},
                                      {"red", kUInt16},
                                      {"green", kUInt16},
                                      {"blue", kUInt16},
                                      {"nir", kUInt16}};
  const auto angle = static_cast<float>(0.006 * -2117);
  const auto u8 = [](int value) { return static_cast<std::uint8_t>(value); };
  const std::string values =
      joined(std::uint16_t{77}, u8(3), u8(15), u8(2), u8(1), u8(1), u8(201), u8(13), u8(44), angle, std::uint16_t{4321},
             123456.789, std::uint16_t{1}, std::uint16_t{40000}, std::uint16_t{65535}, std::uint16_t{12345});
  RegisteredCloudOptions options = in_format(CloudFormat::kLas);
  options.one_scan = true;
  options.box.extend(Eigen::Vector3d(1, 2, 3));
  const auto path = folder.path() / "out.las";
  RegisteredCloudWriter writer(path, {las}, options);
  writer.write(0, {{{1, 2, 3}}, packed(values)}, las, Eigen::Isometry3d::Identity());
  writer.finish();
  const WholeScan scan = read_whole(path);
  ASSERT_EQ(scan.attributes.size(), las.size());
  for (const auto& attribute : las) {
    EXPECT_NE(std::find(scan.attributes.begin(), scan.attributes.end(), attribute), scan.attributes.end())
        << attribute.name;
  }
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "return_number"), 3);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "number_of_returns"), 15);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "scanner_channel"), 2);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "scan_direction_flag"), 1);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "edge_of_flight_line"), 1);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "classification"), 201);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "classification_flags"), 13);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "user_data"), 44);
  EXPECT_EQ(attribute_of<float>(scan, 0, "scan_angle"), angle);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "point_source_id"), 4321);
  EXPECT_EQ(attribute_of<double>(scan, 0, "gps_time"), 123456.789);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "green"), 40000);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "nir"), 12345);
}

TEST(CloudFormats, LasAndPlyNameTheCoordinateSystem) {
  const TempFolder folder;
  RegisteredCloudOptions options = in_format(CloudFormat::kLas);
  options.crs = "EPSG:32733";
  options.frame = "control points";
  const WholeScan scan = written_and_read(folder, options);
  EXPECT_LT(worst_distance(scan, to_utm()), 1e-6);  // points are where the header says, behind both records
  const std::string text = ScanReader(folder.path() / "out.las").coordinate_system();
  EXPECT_TRUE(text.starts_with("PROJCS[\"WGS 84 / UTM zone 33S\",GEOGCS[\"WGS 84\"")) << text;
  EXPECT_NE(text.find("PARAMETER[\"central_meridian\",15]"), std::string::npos) << text;
  EXPECT_NE(text.find("PARAMETER[\"false_northing\",10000000]"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '['), std::count(text.begin(), text.end(), ']'));
  EXPECT_FALSE(las_names_crs("EPSG:31467"));
  EXPECT_FALSE(las_names_crs("EPSG:25899"));
  EXPECT_FALSE(las_names_crs(""));
  options.crs = "LOCAL_CS[\"site\"]";
  written_and_read(folder, options);
  EXPECT_EQ(ScanReader(folder.path() / "out.las").coordinate_system(), options.crs);
  options.format = CloudFormat::kPly;
  written_and_read(folder, options);
  const std::string ply = read_text(folder.path() / "out.ply");
  EXPECT_NE(ply.find("comment frame: survey frame by control points\ncomment coordinate system: LOCAL_CS"),
            std::string::npos);
}

TEST(CloudFormats, LasRefusesWhatItHasNoRoomFor) {
  const TempFolder folder;
  const auto path = folder.path() / "out.las";
  RegisteredCloudOptions options = in_format(CloudFormat::kLas);
  const std::vector<Attribute> attributes = {{"return_number", kUInt8}};
  RegisteredCloudWriter writer(path, {attributes}, options);
  const std::string text = error_of<OutputError>([&] {
    writer.write(0, {{{0, 0, 0}}, packed(joined(std::uint8_t{16}))}, attributes, Eigen::Isometry3d::Identity());
  });
  EXPECT_NE(text.find("no room for the return_number 16 of a point; use --format ply"), std::string::npos) << text;
  options.box.extend(Eigen::Vector3d(0, 0, 0));
  options.box.extend(Eigen::Vector3d(5e6, 0, 0));
  options.largest_step = 1e-4;
  const std::string far = error_of<OutputError>([&] { RegisteredCloudWriter(path, {{}}, options); });
  EXPECT_NE(far.find("round them to 0.002"), std::string::npos) << far;
}

TEST(CloudFormats, LasShowsIntensitiesOfOtherTypesScaledAndKeepsThemBeside) {
  const TempFolder folder;
  const std::vector<Attribute> attributes = {{"intensity", kFloat32}};
  RegisteredCloudOptions options = in_format(CloudFormat::kLas);
  options.most_intensity = 1;
  const auto path = folder.path() / "out.las";
  RegisteredCloudWriter writer(path, {attributes}, options);
  writer.write(0, {Points(3, Eigen::Vector3d::Zero()), packed(joined(0.25F, 1.0F, 7.5F))}, attributes,
               Eigen::Isometry3d::Identity());
  writer.finish();
  const WholeScan scan = read_whole(path);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "intensity"), 16384);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 1, "intensity"), 65535);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 2, "intensity"), 65535);
  EXPECT_EQ(attribute_of<float>(scan, 0, "input_intensity"), 0.25F);
  EXPECT_EQ(attribute_of<float>(scan, 2, "input_intensity"), 7.5F);
}

TEST(CloudFormats, LasNamesThatAreTooLongOrTakenAreMadeUnique) {
  const TempFolder folder;
  const std::string base(32, 'n');
  const std::vector<Attribute> attributes = {{base + "1", kUInt8}, {base + "2", kUInt8}, {"intensity", kFloat32}};
  const auto path = folder.path() / "out.las";
  RegisteredCloudWriter(path, {attributes}, in_format(CloudFormat::kLas)).finish();
  const auto read = ScanReader(path).attributes();
  ASSERT_GE(read.size(), 3U);
  EXPECT_EQ(read[read.size() - 3], (Attribute{base, kUInt8}));
  EXPECT_EQ(read[read.size() - 2], (Attribute{std::string(30, 'n') + "_2", kUInt8}));
  EXPECT_EQ(read[read.size() - 1], (Attribute{"input_intensity", kFloat32}));
}

TEST(CloudFormats, AFileWithoutPointsCanBeRead) {
  const TempFolder folder;
  for (const auto format : {CloudFormat::kPly, CloudFormat::kLas, CloudFormat::kPcd}) {
    const auto path = folder.path() / ("none" + std::string(extension_of(format)));
    RegisteredCloudWriter(path, {kRich}, in_format(format)).finish();
    EXPECT_EQ(read_whole(path).block.size(), 0U) << path;
  }
}

TEST(CloudFormats, ColourByScanPutsTheScansOwnAside) {
  const TempFolder folder;
  RegisteredCloudOptions options = in_format(CloudFormat::kPly);
  options.colour = CloudColour::kScan;
  const WholeScan scan = written_and_read(folder, options);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "red"), scan_colour(0)[0]);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 2, "red"), scan_colour(1)[0]);
  EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "input_green"), 128);
}

TEST(CloudFormats, ColoursOfEightAndSixteenBitsMeetAtSixteen) {
  const TempFolder folder;
  const std::vector<Attribute> bytes = {{"red", kUInt8}, {"green", kUInt8}, {"blue", kUInt8}};
  const std::vector<Attribute> shorts = {{"red", kUInt16}, {"green", kUInt16}, {"blue", kUInt16}};
  const std::vector<Attribute> other = {{"red", kFloat32}};  // no colour as files have it
  const auto path = folder.path() / "out.ply";
  RegisteredCloudWriter writer(path, {bytes, shorts, other}, in_format(CloudFormat::kPly));
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  writer.write(0, {{{0, 0, 0}}, packed(joined(std::uint8_t{255}, std::uint8_t{1}, std::uint8_t{0}))}, bytes, identity);
  writer.write(1, {{{0, 0, 0}}, packed(joined(std::uint16_t{65535}, std::uint16_t{2}, std::uint16_t{0}))}, shorts,
               identity);
  writer.write(2, {{{0, 0, 0}}, packed(joined(0.5F))}, other, identity);
  writer.finish();
  const WholeScan scan = read_whole(path);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "red"), 65535);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 0, "green"), 257);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 1, "red"), 65535);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 1, "green"), 2);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 2, "red"), 0);
  EXPECT_EQ(attribute_of<float>(scan, 2, "input_red"), 0.5F);
}

TEST(CloudFormats, AFileForOneScanAddsNothingToItsAttributes) {
  const TempFolder folder;
  for (const auto& attributes : {kRich, std::vector<Attribute>{{"alpha", kUInt8}, {"red", kFloat32}}}) {
    RegisteredCloudOptions options = in_format(CloudFormat::kPly);
    options.one_scan = true;
    const auto path = folder.path() / "one.ply";
    RegisteredCloudWriter(path, {{}, attributes}, options).finish();
    auto sorted = [](std::vector<Attribute> list) {
      std::sort(list.begin(), list.end(), [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
      return list;
    };
    EXPECT_EQ(sorted(ScanReader(path).attributes()), sorted(attributes));
  }
}

}  // namespace
}  // namespace tcm_icp
