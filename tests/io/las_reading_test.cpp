#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>

#include "io/las_file.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::joined;
using test::las_extra;
using test::las_file;
using test::las_record;
using test::las_xyz;
using test::LasParts;
using test::padded;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

using U8 = std::uint8_t;
using U16 = std::uint16_t;

/// Two points of format 0, each behind the other.
LasParts plain() {
  LasParts parts;
  parts.num_points = 2;
  parts.points = padded(las_xyz(1, 2, 3), 20) + padded(las_xyz(-100, 1000, 7), 20);
  return parts;
}

const Points kPlain{{1000.01, -1999.998, 1.5}, {999, -1999, 3.5}};

void expect_plain(const WholeScan& scan) {
  ASSERT_EQ(scan.block.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(scan.block.points[i].isApprox(kPlain[i], 1e-15)) << i;
}

TEST(LasReading, CoordinatesAreScaledAndShiftedInEveryVersion) {
  const TempFolder folder;
  for (int minor = 0; minor <= 4; ++minor) {
    LasParts parts = plain();
    parts.minor = minor;
    expect_plain(read_whole(folder.write("a.las", las_file(parts))));
  }
}

TEST(LasReading, EveryPointFormatHasItsColumns) {
  const TempFolder folder;
  // [bytes] of a point, where its time stands, its colour, its infrared; 0 for none
  const std::array<std::array<std::size_t, 4>, 11> formats{{{20, 0, 0, 0},
                                                            {28, 20, 0, 0},
                                                            {26, 0, 20, 0},
                                                            {34, 20, 28, 0},
                                                            {57, 20, 0, 0},
                                                            {63, 20, 28, 0},
                                                            {30, 22, 0, 0},
                                                            {36, 22, 30, 0},
                                                            {38, 22, 30, 36},
                                                            {59, 22, 0, 0},
                                                            {67, 22, 30, 36}}};
  for (int format = 0; format <= 10; ++format) {
    const auto [size, time, colour, nir] = formats[static_cast<std::size_t>(format)];
    std::string point = padded(las_xyz(1, 2, 3) + joined(U16{777}), size);
    if (time != 0) test::put(point, time, 12.5);
    if (colour != 0) test::put(point, colour + 2, U16{65535});
    if (nir != 0) test::put(point, nir, U16{99});
    LasParts parts;
    parts.minor = 4;
    parts.format = format;
    parts.record_size = static_cast<U16>(size);
    parts.num_points = 1;
    parts.points = point;
    const WholeScan scan = read_whole(folder.write("a.las", las_file(parts)));
    EXPECT_TRUE(scan.block.points.at(0).isApprox(kPlain[0], 1e-15)) << format;
    EXPECT_EQ(attribute_of<U16>(scan, 0, "intensity"), 777) << format;
    std::set<std::string> names;
    for (const auto& attribute : scan.attributes) names.insert(attribute.name);
    EXPECT_EQ(names.count("gps_time"), time != 0) << format;
    EXPECT_EQ(names.count("green"), colour != 0) << format;
    EXPECT_EQ(names.count("nir"), nir != 0) << format;
    if (time != 0) {
      EXPECT_EQ(attribute_of<double>(scan, 0, "gps_time"), 12.5) << format;
    }
    if (colour != 0) {
      EXPECT_EQ(attribute_of<U16>(scan, 0, "green"), 65535) << format;
    }
    if (nir != 0) {
      EXPECT_EQ(attribute_of<U16>(scan, 0, "nir"), 99) << format;
    }
  }
}

TEST(LasReading, BitsAndAnglesAreTakenApart) {
  const TempFolder folder;
  LasParts parts;
  parts.num_points = 1;
  // return 3 of 5, direction 1, edge 0; class 6, withheld; -15 degrees, user 9, source 4711
  parts.points = las_xyz(0, 0, 0) +
                 joined(U16{1}, U8{0b01101011}, U8{0b10000110}, static_cast<std::int8_t>(-15), U8{9}, U16{4711});
  const WholeScan scan = read_whole(folder.write("a.las", las_file(parts)));
  EXPECT_EQ(attribute_of<U8>(scan, 0, "return_number"), 3);
  EXPECT_EQ(attribute_of<U8>(scan, 0, "number_of_returns"), 5);
  EXPECT_EQ(attribute_of<U8>(scan, 0, "scan_direction_flag"), 1);
  EXPECT_EQ(attribute_of<U8>(scan, 0, "edge_of_flight_line"), 0);
  EXPECT_EQ(attribute_of<U8>(scan, 0, "classification"), 6);
  EXPECT_EQ(attribute_of<U8>(scan, 0, "classification_flags"), 4);
  EXPECT_EQ(attribute_of<float>(scan, 0, "scan_angle"), -15);
  EXPECT_EQ(attribute_of<U8>(scan, 0, "user_data"), 9);
  EXPECT_EQ(attribute_of<U16>(scan, 0, "point_source_id"), 4711);

  parts.minor = 4;
  parts.format = 6;
  parts.record_size = 30;
  // return 12 of 13; channel 2, direction 0, edge 1, overlap; class 64, user 9, -30000 steps, source 4711, time
  parts.points = las_xyz(0, 0, 0) + joined(U16{1}, U8{0b11011100}, U8{0b10101000}, U8{64}, U8{9},
                                           static_cast<std::int16_t>(-30000), U16{4711}, 5.0);
  const WholeScan modern = read_whole(folder.write("b.las", las_file(parts)));
  EXPECT_EQ(attribute_of<U8>(modern, 0, "return_number"), 12);
  EXPECT_EQ(attribute_of<U8>(modern, 0, "number_of_returns"), 13);
  EXPECT_EQ(attribute_of<U8>(modern, 0, "scanner_channel"), 2);
  EXPECT_EQ(attribute_of<U8>(modern, 0, "scan_direction_flag"), 0);
  EXPECT_EQ(attribute_of<U8>(modern, 0, "edge_of_flight_line"), 1);
  EXPECT_EQ(attribute_of<U8>(modern, 0, "classification"), 64);
  EXPECT_EQ(attribute_of<U8>(modern, 0, "classification_flags"), 8);
  EXPECT_EQ(attribute_of<float>(modern, 0, "scan_angle"), -180);
  EXPECT_EQ(attribute_of<U16>(modern, 0, "point_source_id"), 4711);
}

TEST(LasReading, ExtraBytesAreColumnsWhereTheyAreDescribed) {
  const TempFolder folder;
  LasParts parts;
  parts.num_points = 1;
  parts.record_size = 20 + 2 + 3 + 8 + 4 + 1;
  parts.records = las_record("LASF_Projection", 34735, "keys") +
                  las_record("LASF_Spec", 4,
                             las_extra("pulse width", 3, 8 | 16, 0.5, 100) + las_extra("", 0, 3) +
                                 las_extra("stamp", 7, 0) + las_extra("intensity", 9, 0));
  parts.num_records = 2;
  parts.points = padded(las_xyz(0, 0, 0), 20) + joined(U16{7}) + "abc" + joined(std::uint64_t{1} << 40U, 2.5F) + "x";
  const WholeScan scan = read_whole(folder.write("a.las", las_file(parts)));
  ASSERT_EQ(scan.block.size(), 1u);
  EXPECT_EQ(attribute_of<double>(scan, 0, "pulse_width"), 103.5);
  EXPECT_EQ(attribute_of<double>(scan, 0, "stamp"), static_cast<double>(std::uint64_t{1} << 40U));
  EXPECT_EQ(attribute_of<float>(scan, 0, "extra_3"), 2.5F) << "its own name is that of another column";
}

TEST(LasReading, TheCoordinateSystemIsTold) {
  const TempFolder folder;
  const auto system = [&](const std::vector<std::string>& records) {
    LasParts parts = plain();
    for (const auto& record : records) parts.records += record;
    parts.num_records = static_cast<std::uint32_t>(records.size());
    return ScanReader(folder.write("a.las", las_file(parts))).coordinate_system();
  };
  const auto keys = [](U16 key, U16 place, U16 value) {
    return las_record(
        "LASF_Projection", 34735,
        joined(U16{1}, U16{1}, U16{0}, U16{2}, U16{1024}, U16{0}, U16{1}, U16{1}, key, place, U16{1}, value));
  };
  EXPECT_EQ(system({}), "");
  EXPECT_EQ(system({keys(3072, 0, 26917)}), "EPSG:26917");
  EXPECT_EQ(system({keys(2048, 0, 4326)}), "EPSG:4326");
  EXPECT_EQ(system({keys(3072, 0, 32767)}), "") << "a system of its own";
  EXPECT_EQ(system({keys(3072, 34736, 7)}), "") << "a place elsewhere";
  EXPECT_EQ(system({keys(3072, 0, 26917), las_record("LASF_Projection", 2112, std::string("PROJCS[\"a\"]\0", 13))}),
            "PROJCS[\"a\"]");
}

TEST(LasReading, WhatStandsBehindThePointsIsNotLookedAt) {
  const TempFolder folder;
  LasParts parts = plain();
  parts.behind = "anything";
  expect_plain(read_whole(folder.write("a.las", las_file(parts))));
}

/// A record as LAS 1.4 has them behind the points.
std::string record_behind(const std::string& user, std::uint16_t id, const std::string& content) {
  return joined(U16{0}) + padded(user, 16) + joined(id, std::uint64_t{content.size()}) + padded("described", 32) +
         content;
}

/// One point of LAS 1.4, with four bytes more than its format has.
std::string las_with_behind(const std::string& records, std::uint32_t count, const std::string& before = "") {
  LasParts parts;
  parts.minor = 4;
  parts.num_points = 1;
  parts.record_size = 24;
  parts.records = before;
  parts.num_records = before.empty() ? 0 : 1;
  parts.points = padded(las_xyz(0, 0, 0), 20) + joined(2.5F);
  std::string file = las_file(parts);
  test::put(file, 235, std::uint64_t{file.size()});
  test::put(file, 243, count);
  return file + records;
}

TEST(LasReading, RecordsBehindThePointsTellWhatNoneBeforeThemDoes) {
  const TempFolder folder;
  const std::string other = record_behind("someone", 2112, "PROJCS[\"wrong\"]");
  const std::string system = record_behind("LASF_Projection", 2112, "PROJCS[\"behind\"]");
  const std::string extra = record_behind("LASF_Spec", 4, las_extra("echo", 9, 0));
  const auto path = folder.write("a.las", las_with_behind(other + system + extra, 3));
  EXPECT_EQ(ScanReader(path).coordinate_system(), "PROJCS[\"behind\"]");
  EXPECT_EQ(attribute_of<float>(read_whole(path), 0, "echo"), 2.5F);
  folder.write("a.las", las_with_behind(system, 1, las_record("LASF_Projection", 2112, "PROJCS[\"before\"]")));
  EXPECT_EQ(ScanReader(path).coordinate_system(), "PROJCS[\"before\"]");
  folder.write("a.las", las_with_behind(extra, 1, las_record("LASF_Spec", 4, las_extra("first", 9, 0))));
  EXPECT_EQ(ScanReader(path).attributes().back().name, "first");
}

TEST(LasReading, RecordsBehindThePointsThatCannotBeAreLeftAlone) {
  const TempFolder folder;
  std::string longer = record_behind("LASF_Projection", 2112, "PROJCS[\"a\"]");
  test::put(longer, 20, std::uint64_t{1} << 60U);
  for (const auto& [records, count] : std::vector<std::pair<std::string, std::uint32_t>>{
           {longer, 1}, {"short", 4'000'000'000U}, {"", 1}, {record_behind("a", 1, ""), 4'000'000'000U}}) {
    std::string file = las_with_behind(records, count);
    const auto path = folder.write("a.las", file);
    EXPECT_EQ(ScanReader(path).coordinate_system(), "");
    EXPECT_EQ(read_whole(path).block.size(), 1U);
    test::put(file, 235, ~std::uint64_t{0});
    folder.write("a.las", file);
    EXPECT_EQ(read_whole(path).block.size(), 1U);
  }
}

TEST(LasReading, ACountOfRecordsThatCannotBeCostsNothing) {
  const TempFolder folder;
  LasParts parts = plain();
  parts.records = las_record("someone", 1, "else");
  parts.num_records = 4'000'000'000U;
  expect_plain(read_whole(folder.write("a.las", las_file(parts))));
}

TEST(LasReading, TheContentTellsUnderAnyName) {
  const TempFolder folder;
  expect_plain(read_whole(folder.write("a.ply", las_file(plain()))));
  expect_plain(read_whole(folder.write("scan", las_file(plain()))));
}

TEST(LasReading, CompressedFilesAreRefusedWithTheCommandsThatConvertThem) {
  const TempFolder folder;
  LasParts parts = plain();
  parts.format = 0x80;
  const auto path = folder.write("a.laz", las_file(parts));
  const std::string message = error_of<InputError>([&] { read_whole(path); });
  EXPECT_NE(message.find("is compressed (LAZ)"), std::string::npos);
  EXPECT_NE(message.find("pdal translate a.laz a.las"), std::string::npos);
  EXPECT_NE(message.find("laszip -i a.laz -o a.las"), std::string::npos);
  parts.minor = 4;
  parts.records = las_record("copc", 1, std::string(160, '\0'));
  parts.num_records = 1;
  const auto copc = folder.write("b.laz", las_file(parts));
  EXPECT_NE(error_of<InputError>([&] { read_whole(copc); }).find("is compressed (COPC)"), std::string::npos);
}

TEST(LasReading, WhatIsWrongIsTold) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    const auto path = folder.write("b.las", content);
    return error_of<InputError>([&] { read_whole(path); });
  };
  const auto changed = [](std::size_t at, auto value) {
    std::string file = las_file(plain());
    test::put(file, at, value);
    return file;
  };
  EXPECT_NE(message("LASX").find("does not begin with 'LASF'"), std::string::npos);
  EXPECT_NE(message("LASF").find("ends within its header"), std::string::npos);
  EXPECT_NE(message(changed(25, U8{5})).find("version 1.5"), std::string::npos);
  EXPECT_NE(message(changed(94, U16{100})).find("header of 100 bytes"), std::string::npos);
  EXPECT_NE(message(changed(96, std::uint32_t{10})).find("points within its header"), std::string::npos);
  EXPECT_NE(message(changed(104, U8{11})).find("point format 11"), std::string::npos);
  EXPECT_NE(message(changed(105, U16{19})).find("points of 19 bytes"), std::string::npos);
  EXPECT_NE(message(changed(107, std::uint32_t{3})).find("promises 3 points, but has room for 2"), std::string::npos);
  EXPECT_NE(message(changed(131, 0.0)).find("scale"), std::string::npos);
  EXPECT_NE(message(changed(96, std::uint32_t{1} << 31U)).find("has room for 0"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
