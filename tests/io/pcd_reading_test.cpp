#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "io/binary_text.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::joined;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

std::string header(const std::string& fields, const std::string& sizes, const std::string& types,
                   const std::string& counts, std::size_t num_points, const std::string& data) {
  const std::string count = std::to_string(num_points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " +
         types + "\nCOUNT " + counts + "\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count +
         "\nDATA " + data + "\n";
}

/// As LZF packs what never repeats: pieces of up to 32 bytes as they are.
std::string packed(const std::string& content) {
  std::string out;
  for (std::size_t at = 0; at < content.size(); at += 32) {
    const std::string piece = content.substr(at, 32);
    out += static_cast<char>(piece.size() - 1);
    out += piece;
  }
  return out;
}

std::string with_sizes(const std::string& packed_bytes, std::size_t unpacked) {
  return joined(static_cast<std::uint32_t>(packed_bytes.size()), static_cast<std::uint32_t>(unpacked)) + packed_bytes;
}

const Points kTwoPoints{{1, 2, 3}, {-4.5, 5, 6}};

void expect_all(const WholeScan& scan) {
  EXPECT_EQ(scan.block.points, kTwoPoints);
  EXPECT_EQ(attribute_of<std::uint16_t>(scan, 1, "ring"), 7);
  EXPECT_EQ(attribute_of<float>(scan, 0, "normal_0"), 0.5F);
  EXPECT_EQ(attribute_of<float>(scan, 1, "normal_1"), -1);
  EXPECT_EQ(scan.attributes.size(), 3u) << "padding is none";
}

TEST(PcdReading, EveryKindOfDataGivesTheSame) {
  const TempFolder folder;
  const std::string fields = "x y _ z ring normal", sizes = "4 4 1 8 2 4", types = "F F U F U F",
                    counts = "1 1 4 1 1 2";
  expect_all(read_whole(folder.write("ascii.pcd", header(fields, sizes, types, counts, 2, "ascii") +
                                                      "1 2 0 0 0 0 3 1 0.5 0\n\n-4.5 5 9 9 9 9 6 7 0 -1\n")));
  const std::string one = joined(1.F, 2.F) + "....", two = joined(-4.5F, 5.F) + "....";
  expect_all(read_whole(folder.write("binary.pcd", header(fields, sizes, types, counts, 2, "binary") + one +
                                                       joined(3.0, std::uint16_t{1}, 0.5F, 0.F) + two +
                                                       joined(6.0, std::uint16_t{7}, 0.F, -1.F))));
  const std::string columns = joined(1.F, -4.5F, 2.F, 5.F) + "........" +
                              joined(3.0, 6.0, std::uint16_t{1}, std::uint16_t{7}, 0.5F, 0.F, 0.F, -1.F);
  const auto compressed = folder.write("packed.pcd", header(fields, sizes, types, counts, 2, "binary_compressed") +
                                                         with_sizes(packed(columns), columns.size()));
  expect_all(read_whole(compressed));
  EXPECT_EQ(read_whole(compressed, ReadAttributes::kNo).block.points, kTwoPoints);
}

TEST(PcdReading, PackedDataRepeatWhatStoodBefore) {
  const TempFolder folder;
  // 1000 points (0, 0, 0): four zeros, then copies of them, 264 and 3 bytes at a time.
  std::string bytes("\x03\0\0\0\0", 5);
  std::size_t done = 4;
  for (; done + 264 <= 12000; done += 264) bytes += std::string("\xE0\xFF\x03", 3);
  for (; done < 12000; done += 4) bytes += std::string("\x40\x03", 2);
  const auto path = folder.write(
      "a.pcd", header("x y z", "4 4 4", "F F F", "1 1 1", 1000, "binary_compressed") + with_sizes(bytes, 12000));
  EXPECT_EQ(read_whole(path).block.points, Points(1000, Eigen::Vector3d::Zero()));
}

TEST(PcdReading, APackedColourComesApart) {
  const TempFolder folder;
  const std::uint32_t colour = 0x80'0A'14'1EU;
  const WholeScan binary = read_whole(folder.write(
      "a.pcd", header("x y z rgba", "4 4 4 4", "F F F U", "1 1 1 1", 1, "binary") + joined(1.F, 2.F, 3.F, colour)));
  const WholeScan ascii = read_whole(
      folder.write("b.pcd", header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, "ascii") + "1 2 3 9.25537e-40\n"));
  EXPECT_EQ(attribute_of<std::uint8_t>(binary, 0, "red"), 0x0A);
  EXPECT_EQ(attribute_of<std::uint8_t>(binary, 0, "green"), 0x14);
  EXPECT_EQ(attribute_of<std::uint8_t>(binary, 0, "blue"), 0x1E);
  EXPECT_EQ(attribute_of<std::uint8_t>(binary, 0, "alpha"), 0x80);
  EXPECT_EQ(attribute_of<std::uint8_t>(ascii, 0, "red"), 0x0A) << "a float of these bits";
  EXPECT_EQ(attribute_of<std::uint8_t>(ascii, 0, "green"), 0x14);
}

TEST(PcdReading, NormalsHaveTheirUsualNames) {
  const TempFolder folder;
  const WholeScan scan = read_whole(folder.write(
      "a.pcd", header("x y z normal_x normal_y normal_z", "4 4 4 4 4 4", "F F F F F F", "1 1 1 1 1 1", 1, "ascii") +
                   "1 2 3 0 0 1\n"));
  EXPECT_EQ(attribute_of<float>(scan, 0, "nz"), 1);
}

TEST(PcdReading, NaNPointsAreDropped) {
  const TempFolder folder;
  const WholeScan scan = read_whole(
      folder.write("a.pcd", header("x y z", "4 4 4", "F F F", "1 1 1", 2, "ascii") + "nan nan nan\n1 2 3\n"));
  EXPECT_EQ(scan.block.points, Points({{1, 2, 3}}));
  EXPECT_EQ(scan.num_dropped, 1u);
}

TEST(PcdReading, WhatIsWrongIsNamedWithItsPlace) {
  const TempFolder folder;
  const auto message = [&](const std::string& content) {
    const auto path = folder.write("b.pcd", content);
    return error_of<InputError>([&] { read_whole(path); });
  };
  const std::string good = header("x y z", "4 4 4", "F F F", "1 1 1", 2, "binary");
  EXPECT_NE(message("1 2 3\n").find("header line 1: begins with '1'"), std::string::npos);
  EXPECT_NE(message("FIELDS x y z\n").find("has no 'DATA'"), std::string::npos);
  EXPECT_NE(message("FIELDS x y z\nSIZE 4 4\n").find("2 values for 3 fields"), std::string::npos);
  EXPECT_NE(message("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nDATA ascii\n").find("number of points"), std::string::npos);
  EXPECT_NE(message(header("x y q", "4 4 4", "F F F", "1 1 1", 1, "ascii") + "1 2 3\n").find("no fields x, y and z"),
            std::string::npos);
  EXPECT_NE(message(header("x y z", "4 4 3", "F F F", "1 1 1", 1, "binary")).find("field 'z'"), std::string::npos);
  EXPECT_NE(message(good + "12345678").find("promises 2 points, but the file has room for 0"), std::string::npos);
  EXPECT_NE(message(header("x y z", "4 4 4", "F F F", "1 1 1", 2, "ascii") + "1 2 3\n").find("ends after 1 of 2"),
            std::string::npos);
  EXPECT_NE(message(header("x y z", "4 4 4", "F F F", "1 1 1", 1, "ascii") + "1 2\n").find("has 2 numbers"),
            std::string::npos);
  const std::string compressed = header("x y z", "4 4 4", "F F F", "1 1 1", 2, "binary_compressed");
  EXPECT_NE(message(compressed + with_sizes("", 12)).find("unpacks to 12 bytes"), std::string::npos);
  EXPECT_NE(message(compressed + with_sizes("\x20\x05", 24)).find("before their start"), std::string::npos);
  EXPECT_NE(message(compressed + with_sizes(packed("1234"), 24)).find("ends after 0 of 2"), std::string::npos);
  EXPECT_NE(message(compressed + joined(std::uint32_t{100}, std::uint32_t{24}) + "\x1f").find("within its packed data"),
            std::string::npos);
  // A count that would need more memory than there is
  EXPECT_NE(message(header("x y z", "4 4 4", "F F F", "1 1 1", 1'000'000'000'000, "binary")).find("has room for 0"),
            std::string::npos);
  EXPECT_NE(message(header("x y z d", "4 4 4 4", "F F F F", "1 1 1 5000", 1, "binary")).find("more than 4096 numbers"),
            std::string::npos);
  EXPECT_NE(message(header("x y z", "4 4 4", "F F F", "1 1 99999999", 1, "binary")).find("more than 1 MiB"),
            std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
