#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "io/e57_file.hpp"
#include "io/e57_pages.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::e57_file;
using test::E57Column;
using test::E57Parts;
using test::error_of;
using test::joined;
using test::packed_bits;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

constexpr const char* kDouble = "type=\"Float\"";
constexpr const char* kSingle = "type=\"Float\" precision=\"single\"";

std::string integers(const std::string& low, const std::string& high) {
  return "type=\"Integer\" minimum=\"" + low + "\" maximum=\"" + high + "\"";
}

/// Two points (1, 2, 3) and (-4, 5, 6.5).
E57Parts two_points() {
  E57Parts scan;
  scan.num_points = 2;
  scan.columns = {{"cartesianX", kDouble, joined(1.0, -4.0)},
                  {"cartesianY", kSingle, joined(2.F, 5.F)},
                  {"cartesianZ", kDouble, joined(3.0, 6.5)}};
  return scan;
}

const Points kTwoPoints{{1, 2, 3}, {-4, 5, 6.5}};

TEST(E57Reading, FloatsOfBothSizesAreCoordinates) {
  const TempFolder folder;
  EXPECT_EQ(read_whole(folder.write("a.e57", e57_file({two_points()}))).block.points, kTwoPoints);
}

TEST(E57Reading, IntegersOfAnySizeComeOutOfTheirBits) {
  const TempFolder folder;
  for (unsigned bits = 1; bits <= 53; ++bits) {  // more a double does not hold
    constexpr std::size_t kCount = 3000;         // several batches
    const std::uint64_t range = (std::uint64_t{1} << bits) - 1;
    std::vector<std::uint64_t> values;
    for (std::size_t i = 0; i < kCount; ++i) values.push_back((i * 0x9E3779B97F4A7C15U >> 7U) & range);
    const std::string high = std::to_string(static_cast<std::int64_t>(range) - 5);
    E57Parts scan;
    scan.num_points = kCount;
    scan.num_packets = 7;
    scan.columns = {
        {"cartesianX", integers("-5", high), packed_bits(values, bits)},
        {"cartesianY", "type=\"ScaledInteger\" minimum=\"-5\" maximum=\"" + high + "\" scale=\"0.5\" offset=\"10\"",
         packed_bits(values, bits)},
        {"cartesianZ", integers("7", "7"), ""}};
    const WholeScan read = read_whole(folder.write("a.e57", e57_file({scan})));
    ASSERT_EQ(read.block.size(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double value = static_cast<double>(values[i]) - 5;
      ASSERT_EQ(read.block.points[i], Eigen::Vector3d(value, 0.5 * value + 10, 7)) << bits << ' ' << i;
    }
  }
}

TEST(E57Reading, SphericalCoordinatesBecomeCartesian) {
  const TempFolder folder;
  E57Parts scan;
  scan.num_points = 3;
  const double half_pi = std::numbers::pi / 2;
  scan.columns = {{"sphericalRange", kDouble, joined(2.0, 2.0, 2.0)},
                  {"sphericalAzimuth", kDouble, joined(0.0, half_pi, 0.3)},
                  {"sphericalElevation", kDouble, joined(0.0, 0.0, half_pi)}};
  const Points points = read_whole(folder.write("a.e57", e57_file({scan}))).block.points;
  ASSERT_EQ(points.size(), 3u);
  EXPECT_TRUE(points[0].isApprox(Eigen::Vector3d(2, 0, 0), 1e-15));
  EXPECT_TRUE(points[1].isApprox(Eigen::Vector3d(0, 2, 0), 1e-15));
  EXPECT_TRUE(points[2].isApprox(Eigen::Vector3d(0, 0, 2), 1e-15));
}

TEST(E57Reading, PointsMarkedAsInvalidAreDropped) {
  const TempFolder folder;
  E57Parts scan = two_points();
  scan.columns.push_back({"cartesianInvalidState", integers("0", "2"), packed_bits({2, 0}, 2)});
  const WholeScan read = read_whole(folder.write("a.e57", e57_file({scan})));
  EXPECT_EQ(read.block.points, Points({kTwoPoints[1]}));
  EXPECT_EQ(read.num_dropped, 1u);
}

TEST(E57Reading, OtherColumnsAreAttributes) {
  const TempFolder folder;
  E57Parts scan = two_points();
  scan.columns.push_back({"note", "type=\"String\"", "ab"});
  scan.columns.push_back({"intensity", kSingle, joined(0.25F, 0.5F)});
  scan.columns.push_back({"colorRed", integers("0", "255"), packed_bits({200, 255}, 8)});
  scan.columns.push_back({"rowIndex", integers("0", "1000"), packed_bits({999, 3}, 10)});
  scan.columns.push_back({"nor:normalX", kSingle, joined(1.F, 0.F)});
  const WholeScan read = read_whole(folder.write("a.e57", e57_file({scan})));
  EXPECT_EQ(read.block.points, kTwoPoints);
  EXPECT_EQ(read.attributes.size(), 4u) << "text is none";
  EXPECT_EQ(attribute_of<float>(read, 1, "intensity"), 0.5F);
  EXPECT_EQ(attribute_of<std::uint8_t>(read, 0, "red"), 200);
  EXPECT_EQ(attribute_of<std::uint16_t>(read, 0, "rowIndex"), 999);
  EXPECT_EQ(attribute_of<float>(read, 0, "nx"), 1);
}

TEST(E57Reading, EachScanOfAFileIsOne) {
  const TempFolder folder;
  E57Parts second = two_points();
  second.columns[0].bytes = joined(7.0, 8.0);
  second.pose =
      "<pose type=\"Structure\"><rotation type=\"Structure\"><w type=\"Float\">0.70710678118654757</w><x "
      "type=\"Float\"/>"
      "<y type=\"Float\"/><z type=\"Float\"> 7.0710678118654757e-1 </z></rotation><translation type=\"Structure\">"
      "<x type=\"Float\">10</x><y type=\"Float\">20</y><z type=\"Float\">30</z></translation></pose>";
  const auto scans = scans_in(folder.write("a.e57", e57_file({two_points(), second})));
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[1].filename(), "a.e57#2");
  EXPECT_EQ(read_whole(scans[0]).block.points, kTwoPoints);
  EXPECT_EQ(read_whole(scans[1]).block.points, Points({{7, 2, 3}, {8, 5, 6.5}})) << "the pose is not applied";
  EXPECT_FALSE(ScanReader(scans[0]).header_pose().has_value());
  const auto pose = ScanReader(scans[1]).header_pose();
  ASSERT_TRUE(pose.has_value());
  EXPECT_TRUE((*pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(10, 21, 30), 1e-12));
  const auto whole = folder.path() / "a.e57";
  EXPECT_NE(error_of<InputError>([&] { read_whole(whole); }).find("holds 2 scans; name one of them, as a.e57#1"),
            std::string::npos);
}

TEST(E57Reading, CheckSumsAreTheSameBitByBitByTableAndByInstruction) {
  std::string bytes;
  for (int i = 0; i < 100; ++i) {
    const auto* const from = reinterpret_cast<const std::byte*>(bytes.data());
    EXPECT_EQ(crc32c(from, bytes.size()), test::slow_crc32c(bytes)) << i;
    EXPECT_EQ(crc32c_by_table(from, bytes.size()), test::slow_crc32c(bytes)) << i;
    bytes += static_cast<char>(37 * i);
  }
}

TEST(E57Reading, DamageIsFoundByTheCheckSumOfItsPage) {
  const TempFolder folder;
  const std::string good = e57_file({two_points()});
  for (std::size_t at = 0; at < good.size(); at += 13) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    const auto path = folder.write("b.e57", bad);
    EXPECT_THROW(read_whole(path), InputError) << at;
  }
}

TEST(E57Reading, WhatIsWrongIsTold) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    const auto path = folder.write("b.e57", content);
    return error_of<InputError>([&] { read_whole(path); });
  };
  const std::string good = e57_file({two_points()});
  EXPECT_NE(message("ASTM").find("not an E57 file"), std::string::npos);
  EXPECT_NE(message(good.substr(0, 512)).find("is cut off: it has 512 of " + std::to_string(good.size())),
            std::string::npos);
  EXPECT_NE(message(e57_file({})).find("holds no scan"), std::string::npos);
  E57Parts scan = two_points();
  scan.num_points = 3;
  EXPECT_NE(message(e57_file({scan})).find("end after about 0 of 3"), std::string::npos);
  scan.section_id = 2;
  for (const std::uint64_t num_points : {0, 2}) {
    scan.num_points = num_points;
    EXPECT_NE(message(e57_file({scan})).find("is none of points"), std::string::npos) << num_points;
  }
  scan.section_id = 1;
  scan.num_points = 1'000'000'000'000;
  EXPECT_NE(message(e57_file({scan})).find("has room for"), std::string::npos);
  scan = two_points();
  scan.columns[1].name = "elsewhere";
  EXPECT_NE(message(e57_file({scan})).find("neither Cartesian nor spherical"), std::string::npos);
  scan = two_points();
  scan.columns[0].type = integers("5", "4");
  EXPECT_NE(message(e57_file({scan})).find("maximum is below its minimum"), std::string::npos);
  scan.columns[0].type = integers("five", "6");
  EXPECT_NE(message(e57_file({scan})).find("'five' in place of a whole number"), std::string::npos);
  scan = two_points();
  std::string nested;
  for (int i = 0; i < 100'000; ++i) nested += "<a type=\"Structure\">";  // each level of which takes stack
  for (int i = 0; i < 100'000; ++i) nested += "</a>";
  scan.columns.push_back({"a", "type=\"Structure\">" + nested + "</a><a type=\"String\"", ""});
  EXPECT_NE(message(e57_file({scan})).find("too deep"), std::string::npos);
  scan = two_points();
  scan.columns.resize(5000, {"a", kSingle, ""});
  EXPECT_NE(message(e57_file({scan})).find("more columns of points than"), std::string::npos);
  scan = two_points();
  scan.pose = "<pose><translation><x>1</x><y>up</y></translation></pose>";
  EXPECT_NE(message(e57_file({scan})).find("'up' in place of a number"), std::string::npos);
  scan.pose = "<pose><rotation><w>2</w></rotation></pose>";
  const ScanReader reader(folder.write("c.e57", e57_file({scan})));
  EXPECT_NE(error_of<InputError>([&] { (void)reader.header_pose(); }).find("not a rigid motion"), std::string::npos);
}

/// With right check sums, so that what is behind them is reached.
std::string with_check_sums(std::string file) {
  for (std::size_t page = 0; page + 1024 <= file.size(); page += 1024) {
    file.replace(page + 1020, 4, test::bytes_of(test::slow_crc32c(file.substr(page, 1020)), test::Order::kBig));
  }
  return file;
}

TEST(E57Reading, DamageWithRightCheckSumsIsReadOrRefused) {
  const TempFolder folder;
  E57Parts scan = two_points();
  scan.columns.push_back({"colorRed", integers("0", "255"), packed_bits({200, 255}, 8)});
  const std::string good = e57_file({scan, two_points()});
  int num_read = 0, num_refused = 0;
  for (std::size_t at = 8; at < good.size(); ++at) {
    if (at % 1024 >= 1020) continue;
    for (const int change : {1, 8, 64, 255}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ change);
      const auto path = folder.write("b.e57", with_check_sums(std::move(bad)));
      try {
        for (const auto& each : scans_in(path)) {
          const WholeScan read = read_whole(each);
          for (const auto& point : read.block.points) ASSERT_TRUE(point.allFinite());
        }
        ++num_read;
      } catch (const InputError&) {
        ++num_refused;
      }
    }
  }
  EXPECT_GT(num_read, 100);
  EXPECT_GT(num_refused, 100);
}

}  // namespace
}  // namespace tcm_icp
