#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "io/ply_text.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes_of() takes this for granted");

using test::attribute_of;
using test::bytes_of;
using test::error_of;
using test::Order;
using test::ply_header;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;
using test::xyz_vertices;

const char* const kEveryType =
    "element vertex 2\nproperty char i8\nproperty uint8 u8\nproperty double z\nproperty short i16\nproperty uint16 "
    "u16\nproperty float x\nproperty int i32\nproperty uint32 u32\nproperty float32 f32\nproperty int y\nproperty "
    "float64 f64\n";

void expect_every_type(const WholeScan& scan) {
  EXPECT_EQ(scan.block.points, Points({{1.5, -7, 0.1}, {-2.5, 70000, 1e300}}));
  ASSERT_EQ(scan.attributes.size(), 8u);
  EXPECT_EQ(scan.attributes[0], (Attribute{"i8", ScalarType::kInt8}));
  EXPECT_EQ(scan.attributes[7], (Attribute{"f64", ScalarType::kFloat64}));
  for (const std::size_t point : {0u, 1u}) {
    EXPECT_EQ(attribute_of<std::int8_t>(scan, point, "i8"), -128);
    EXPECT_EQ(attribute_of<std::uint8_t>(scan, point, "u8"), 200);
    EXPECT_EQ(attribute_of<std::int16_t>(scan, point, "i16"), -300);
    EXPECT_EQ(attribute_of<std::uint16_t>(scan, point, "u16"), 65535);
    EXPECT_EQ(attribute_of<std::int32_t>(scan, point, "i32"), -2147483647);
    EXPECT_EQ(attribute_of<std::uint32_t>(scan, point, "u32"), 4294967295u);
    EXPECT_EQ(attribute_of<float>(scan, point, "f32"), 0.25F);
    EXPECT_EQ(attribute_of<double>(scan, point, "f64"), 1.0 / 3);
  }
}

std::string every_type_record(double x, std::int32_t y, double z, Order order) {
  return bytes_of(std::int8_t{-128}, order) + bytes_of(std::uint8_t{200}, order) + bytes_of(z, order) +
         bytes_of(std::int16_t{-300}, order) + bytes_of(std::uint16_t{65535}, order) +
         bytes_of(static_cast<float>(x), order) + bytes_of(std::int32_t{-2147483647}, order) +
         bytes_of(std::uint32_t{4294967295u}, order) + bytes_of(0.25F, order) + bytes_of(y, order) +
         bytes_of(1.0 / 3, order);
}

TEST(PlyReading, EveryTypeIsReadInEachFormat) {
  const TempFolder folder;
  expect_every_type(read_whole(folder.write(
      "ascii.ply", ply_header("ascii", kEveryType) +
                       "-128 200 0.1 -300 65535 1.5 -2147483647 4294967295 0.25 -7 0.33333333333333331\n"
                       "\n  -128\t200 1e300 -300 65535 -2.5 -2147483647 4294967295 .25 70000 0.33333333333333331")));
  for (const Order order : {Order::kLittle, Order::kBig}) {
    const std::string format = order == Order::kLittle ? "binary_little_endian" : "binary_big_endian";
    expect_every_type(read_whole(folder.write(format + ".ply", ply_header(format, kEveryType) +
                                                                   every_type_record(1.5, -7, 0.1, order) +
                                                                   every_type_record(-2.5, 70000, 1e300, order))));
  }
}

TEST(PlyReading, WithoutAttributesOnlyCoordinatesAreGiven) {
  const TempFolder folder;
  const auto path =
      folder.write("a.ply", ply_header("binary_big_endian", kEveryType) + every_type_record(1.5, -7, 0.1, Order::kBig) +
                                every_type_record(-2.5, 70000, 1e300, Order::kBig));
  const WholeScan scan = read_whole(path, ReadAttributes::kNo);
  EXPECT_EQ(scan.block.points, Points({{1.5, -7, 0.1}, {-2.5, 70000, 1e300}}));
  EXPECT_TRUE(scan.attributes.empty());
  EXPECT_TRUE(scan.block.attributes.empty());
}

TEST(PlyReading, CommentsCarriageReturnsAndForeignElementsAreNoHindrance) {
  const TempFolder folder;
  const std::string header =
      "ply\r\ncomment before the format\r\nformat ascii 1.0\r\nobj_info made by hand\r\nelement camera 2\r\nproperty "
      "float a\r\nproperty list uchar int b\r\nelement vertex 1\r\ncomment amid\r\nproperty float x\r\nproperty float "
      "y\r\nproperty float z\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n";
  const auto path = folder.write("a.ply", header + "0.5 3 1 2 3\r\n0.5 0\r\n1 2 3\r\n3 0 0 0\r\n");
  EXPECT_EQ(read_whole(path).block.points, Points({{1, 2, 3}}));
}

TEST(PlyReading, BinaryElementsBeforeTheVerticesAreSkipped) {
  const TempFolder folder;
  for (const Order order : {Order::kLittle, Order::kBig}) {
    const std::string vertex = bytes_of(1.0F, order) + bytes_of(2.0F, order) + bytes_of(3.0F, order);
    const std::string format = order == Order::kLittle ? "binary_little_endian" : "binary_big_endian";
    const std::string fixed = "element time 3\nproperty double t\nproperty uchar u\n";
    const std::string lists = "element face 2\nproperty short a\nproperty list ushort double b\nproperty uchar c\n";
    const std::string list_data = bytes_of(std::int16_t{7}, order) + bytes_of(std::uint16_t{2}, order) +
                                  std::string(16, 'x') + "u" + bytes_of(std::int16_t{7}, order) +
                                  bytes_of(std::uint16_t{0}, order) + "u";
    const auto path =
        folder.write("a.ply", ply_header(format, fixed + lists + xyz_vertices(1) + "element tail 9\nproperty int i\n") +
                                  std::string(27, 't') + list_data + vertex);
    EXPECT_EQ(read_whole(path).block.points, Points({{1, 2, 3}})) << format;
  }
}

TEST(PlyReading, ListsWithinTheVerticesAreLeftOut) {
  const TempFolder folder;
  const std::string element =
      "element vertex 2\nproperty float x\nproperty list uchar float views\nproperty float y\nproperty float "
      "z\nproperty uchar last\n";
  const auto ascii = read_whole(folder.write("a.ply", ply_header("ascii", element) + "1 2 9 9 2 3 4\n5 0 6 7 8\n"));
  const std::string data = bytes_of(1.0F) + "\x02" + std::string(8, 'v') + bytes_of(2.0F) + bytes_of(3.0F) + "\x04" +
                           bytes_of(5.0F) + std::string(1, '\0') + bytes_of(6.0F) + bytes_of(7.0F) + "\x08";
  const auto binary = read_whole(folder.write("b.ply", ply_header("binary_little_endian", element) + data));
  for (const auto& scan : {ascii, binary}) {
    EXPECT_EQ(scan.block.points, Points({{1, 2, 3}, {5, 6, 7}}));
    ASSERT_EQ(scan.attributes.size(), 1u);
    EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "last"), 4);
    EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "last"), 8);
  }
}

TEST(PlyReading, NoVerticesGiveNoPoints) {
  const TempFolder folder;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    EXPECT_EQ(read_whole(folder.write("a.ply", ply_header(format, xyz_vertices(0)))).block.size(), 0u);
  }
}

TEST(PlyReading, PointsThatAreNotFiniteAreDroppedWithTheirAttributes) {
  const TempFolder folder;
  const std::string lines = xyz_vertices(4) + "property uchar tag\n";
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const auto vertex = [](float x, float y, float z, const char* tag) {
    return bytes_of(x) + bytes_of(y) + bytes_of(z) + tag;
  };
  const auto binary =
      folder.write("a.ply", ply_header("binary_little_endian", lines) + vertex(nan, 1, 2, "\x01") +
                                vertex(1, 2, 3, "\x02") + vertex(0, -inf, 0, "\x03") + vertex(4, 5, 6, "\x04"));
  const auto ascii = folder.write("b.ply", ply_header("ascii", lines) + "nan 1 2 1\n1 2 3 2\n0 -inf 0 3\n4 5 6 4\n");
  for (const auto& path : {binary, ascii}) {
    const WholeScan scan = read_whole(path);
    EXPECT_EQ(scan.block.points, Points({{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(scan.num_dropped, 2u);
    EXPECT_EQ(attribute_of<std::uint8_t>(scan, 0, "tag"), 2);
    EXPECT_EQ(attribute_of<std::uint8_t>(scan, 1, "tag"), 4);
  }
}

TEST(PlyReading, WhatIsWrongIsNamedWithItsPlace) {
  const TempFolder folder;
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"pl", "byte 0: is not a PLY file"},
      {"LISP 1.2", "byte 0: is not a PLY file"},
      {"plywood\n", "header line 1: holds more than 'ply'"},
      {"ply\nformat ascii 1.0\n", "header line 2: is the last line, but the header has no 'end_header'"},
      {"ply\nformat ebcdic 1.0\n", "header line 2: names the unknown format 'ebcdic'"},
      {"ply\nformat ascii 2.0\n", "header line 2: names the unknown version '2.0'"},
      {"ply\nformat ascii\n", "header line 2: is not 'format NAME VERSION'"},
      {"ply\nformat ascii 1.0\nformat ascii 1.0\n", "header line 3: is a second 'format' line"},
      {"ply\nelement vertex 0\n" + xyz + "end_header\n", "header line 6: ends a header without a 'format' line"},
      {"ply\nformat ascii 1.0\nhello\n", "header line 3: begins with 'hello'"},
      {"ply\nformat ascii 1.0\nelement vertex -1\n", "header line 3: '-1' is not a count"},
      {"ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n", "is not a count"},
      {"ply\nformat ascii 1.0\nelement vertex\n", "header line 3: is not 'element NAME COUNT'"},
      {"ply\nformat ascii 1.0\nproperty float x\n", "header line 3: is a property before any element"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", "header line 4: names the unknown type 'quad'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float\n", "header line 4: is not 'property TYPE NAME'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int v\n", "counts a list's entries in 'float'"},
      {"ply\nformat ascii 1.0\nelement face 0\nend_header\n", "without an element 'vertex'"},
      {ply_header("ascii", xyz_vertices(0) + xyz_vertices(0)), "two elements 'vertex'"},
      {ply_header("ascii", "element vertex 0\nproperty float x\nproperty float y\n"), "have no property 'z'"},
      {ply_header("ascii", xyz_vertices(0) + "property float x\n"), "have two properties 'x'"},
      {ply_header("ascii", xyz_vertices(3)) + "1 2 3\n4 5 6\n", "line 9: ends after 2 of 3 'vertex' records"},
      {ply_header("ascii", xyz_vertices(1)) + "1 2\n", "line 8: holds 2 values"},
      {ply_header("ascii", xyz_vertices(1)) + "1 2 3 4\n", "line 8: holds 4 values"},
      {ply_header("ascii", xyz_vertices(1)) + "1 two 3\n", "line 8: 'two' is not a number"},
      {ply_header("ascii", xyz_vertices(1)) + "1 0x2 3\n", "line 8: '0x2' is not a number"},
      {ply_header("ascii", xyz_vertices(1) + "property uchar u\n") + "1 2 3 256\n", "line 9: '256' is not a value"},
      {ply_header("ascii", xyz_vertices(1) + "property int i\n") + "1 2 3 0.5\n", "line 9: '0.5' is not a value"},
      {ply_header("ascii", xyz_vertices(1) + "property list uchar int l\n") + "1 2 3 -1\n", "not the length of a list"},
      {ply_header("ascii", xyz_vertices(1) + "property list uchar int l\n") + "1 2 3 4 0\n", "line 9: holds 5 values"},
      {ply_header("binary_little_endian", xyz_vertices(3)) + std::string(35, '\0'),
       "ends after 2 of 3 'vertex' records"},
      {ply_header("binary_little_endian", xyz_vertices(18446744073709551615u)) + std::string(12, '\0'),
       "ends after 1 of 18446744073709551615 'vertex' records"},
      {ply_header("binary_little_endian", "element big 18446744073709551615\nproperty int i\n" + xyz_vertices(1)),
       "ends after 0 of 18446744073709551615 'big' records"},
      {ply_header("binary_little_endian", "element big 4000000000\nproperty int i\n" + xyz_vertices(1)) + "12345678",
       "ends after 2 of 4000000000 'big' records"},
      {ply_header("binary_little_endian", "element f 1\nproperty list char int i\n" + xyz_vertices(1)) + "\xFF",
       "a list has a negative length"},
      {ply_header("binary_little_endian", "element f 1\nproperty list uint double i\n" + xyz_vertices(1)) +
           "\xFF\xFF\xFF\xFF",
       "ends after 0 of 1 'f' records"},
  };
  for (const auto& [content, expected] : cases) {
    const auto path = folder.write("broken.ply", content);
    const std::string message = error_of<InputError>([&] { read_whole(path); });
    EXPECT_NE(message.find(expected), std::string::npos) << "message: " << message << "\nexpected: " << expected;
    EXPECT_EQ(message.find(path.string()), 0u) << message;
  }
}

TEST(PlyReading, AByteOrderMarkIsPassedOver) {
  const TempFolder folder;
  const std::string ply = ply_header("ascii", xyz_vertices(1)) + "1 2 3\n";
  EXPECT_EQ(read_whole(folder.write("a.ply", "\xEF\xBB\xBF" + ply)).block.points, Points({{1, 2, 3}}));
}

TEST(PlyReading, AHeaderWithoutEndIsNotReadToTheEndOfTheFile) {
  const TempFolder folder;
  std::string content = "ply\nformat ascii 1.0\nelement vertex 1\n";
  while (content.size() < (3u << 20)) content += "property float some_name\n";
  const auto path = folder.write("a.ply", content);
  EXPECT_NE(error_of<InputError>([&] { read_whole(path); }).find("is past 1 MiB"), std::string::npos);
}

}  // namespace
}  // namespace tcm_icp
