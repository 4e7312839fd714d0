// E57 files as they are written: byte by byte as ASTM E2807-11 has them, and read back by our reader.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <pugixml.hpp>

#include "io/binary_text.hpp"
#include "io/cloud_blocks.hpp"
#include "io/e57_file.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_colour.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

using test::attribute_of;
using test::error_of;
using test::joined;
using test::read_text;
using test::read_whole;
using test::TempFolder;
using test::to_utm;
using test::WholeScan;
using enum ScalarType;

const std::vector<Attribute> kAll = {{"intensity", kUInt16},     {"red", kUInt8},    {"green", kUInt8},
                                     {"blue", kUInt8},           {"time", kFloat64}, {"nx", kFloat32},
                                     {"ny", kFloat32},           {"nz", kFloat32},   {"rowIndex", kInt32},
                                     {"isColorInvalid", kUInt8}, {"label", kInt8},   {"a:b", kInt16},
                                     {"reflectance", kFloat32},  {"count", kUInt32}};

PointBlock points_with_all(std::size_t count) {
  PointBlock block;
  Rng rng = make_stream(3, "e57_writing");
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    block.points.push_back({2e3 * uniform01(rng) - 1e3, 1.0 / 3, static_cast<double>(i)});
    bytes += joined(static_cast<std::uint16_t>(i + 7), static_cast<std::uint8_t>(i), std::uint8_t{255}, std::uint8_t{0},
                    1e9 + 0.001 * static_cast<double>(i), 0.6F, 0.8F, 0.F, static_cast<std::int32_t>(i) - 5,
                    static_cast<std::uint8_t>(i % 3 == 0), static_cast<std::int8_t>(-128 + static_cast<int>(i % 256)),
                    std::int16_t{-32768}, 0.1F, std::uint32_t{4294967295U});
  }
  block.attributes = test::packed(bytes);
  return block;
}

RegisteredCloudOptions e57_options() {
  RegisteredCloudOptions options;
  options.format = CloudFormat::kE57;
  options.reference = "a.las";
  options.scan_names = {"a.las", "h\xC3\xA4ll<&>\xFF.e57#2"};
  return options;
}

/// A scan with attributes in blocks, then one without.
std::filesystem::path write_two(const TempFolder& folder, std::size_t count, const RegisteredCloudOptions& options) {
  const auto path = folder.path() / "out.e57";
  RegisteredCloudWriter writer(path, {kAll, {}}, options);
  const PointBlock all = points_with_all(count);
  const std::size_t stride = attribute_stride(kAll), half = count / 3;
  const auto part = [&](std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
    return PointBlock{{all.points.begin() + at(begin), all.points.begin() + at(end)},
                      {all.attributes.begin() + at(begin * stride), all.attributes.begin() + at(end * stride)}};
  };
  writer.write(0, part(0, half), kAll, Eigen::Isometry3d::Identity());
  writer.write(0, part(half, count), kAll, Eigen::Isometry3d::Identity());
  writer.write(1, {{{1, 2, 3}, {-4, 5, 6.5}}, {}}, {}, to_utm());
  writer.finish();
  EXPECT_EQ(writer.num_points(), count + 2);
  return path;
}

template <typename T>
T at(const std::string& bytes, std::uint64_t offset) {
  T value{};
  EXPECT_LE(offset + sizeof(T), bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// The bytes of the pages without their check sums, each of which must be right.
std::string payload_of(const std::string& file) {
  std::string out;
  for (std::size_t page = 0; page < file.size(); page += 1024) {
    const std::string payload = file.substr(page, 1020);
    EXPECT_EQ(file.substr(page + 1020, 4), test::bytes_of(test::slow_crc32c(payload), test::Order::kBig)) << page;
    out += payload;
  }
  return out;
}

std::uint64_t logical(std::uint64_t physical) {
  EXPECT_LT(physical % 1024, 1020U);
  return physical / 1024 * 1020 + physical % 1024;
}

/// What the standard asks of a section of points; the number of points its packets hold.
std::uint64_t check_section(const std::string& bytes, std::uint64_t begin, const std::vector<unsigned>& bits) {
  EXPECT_EQ(begin % 4, 0U);
  EXPECT_EQ(bytes.substr(begin, 8), std::string("\1\0\0\0\0\0\0\0", 8));
  const auto length = at<std::uint64_t>(bytes, begin + 8), end = begin + length;
  EXPECT_EQ(length % 4, 0U);
  std::uint64_t packet = logical(at<std::uint64_t>(bytes, begin + 16));
  const std::uint64_t index = logical(at<std::uint64_t>(bytes, begin + 24));
  EXPECT_EQ(packet, begin + 32);
  std::map<std::uint64_t, std::uint64_t> first_point_at;
  std::uint64_t num_points = 0;
  bool seen_index = false;
  while (packet < end) {
    const auto type = at<std::uint8_t>(bytes, packet);
    const std::uint64_t size = std::uint64_t{at<std::uint16_t>(bytes, packet + 2)} + 1;
    EXPECT_EQ(size % 4, 0U);
    EXPECT_EQ(at<std::uint8_t>(bytes, packet + 1), 0);
    if (type == 0) {
      seen_index = true;
      EXPECT_EQ(packet, index);
      const auto count = at<std::uint16_t>(bytes, packet + 4);
      EXPECT_EQ(size, 16U + 16U * count);
      EXPECT_EQ(bytes.substr(packet + 6, 10), std::string(10, '\0')) << "level 0, reserved bytes";
      for (std::uint64_t i = 0; i < count; ++i) {
        const auto point = at<std::uint64_t>(bytes, packet + 16 + 16 * i);
        const std::uint64_t where = logical(at<std::uint64_t>(bytes, packet + 24 + 16 * i));
        EXPECT_EQ(first_point_at.at(where), point);
      }
    } else {
      EXPECT_EQ(type, 1);
      EXPECT_EQ(at<std::uint16_t>(bytes, packet + 4), bits.size());
      first_point_at[packet] = num_points;
      const std::uint64_t count = at<std::uint16_t>(bytes, packet + 6) * 8U / bits[0];
      std::uint64_t sum = 6 + 2 * bits.size();
      for (std::size_t i = 0; i < bits.size(); ++i) {
        const auto stream = at<std::uint16_t>(bytes, packet + 6 + 2 * i);
        EXPECT_EQ(stream, (count * bits[i] + 7) / 8);
        sum += stream;
      }
      EXPECT_EQ(size, (sum + 3) / 4 * 4);
      num_points += count;
    }
    packet += size;
  }
  EXPECT_EQ(packet, end);
  EXPECT_TRUE(seen_index);
  return num_points;
}

TEST(E57Writing, HeaderPagesSectionsAndPacketsAreAsTheStandardHasThem) {
  const TempFolder folder;
  for (const std::size_t count : {3U, 5000U}) {  // one packet, and several
    const std::string file = read_text(write_two(folder, count, e57_options()));
    ASSERT_EQ(file.size() % 1024, 0U);
    const std::string bytes = payload_of(file);
    EXPECT_EQ(bytes.substr(0, 8), "ASTM-E57");
    EXPECT_EQ(at<std::uint32_t>(bytes, 8), 1U);
    EXPECT_EQ(at<std::uint32_t>(bytes, 12), 0U);
    EXPECT_EQ(at<std::uint64_t>(bytes, 16), file.size());
    EXPECT_EQ(at<std::uint64_t>(bytes, 40), 1024U);
    const std::uint64_t xml_at = logical(at<std::uint64_t>(bytes, 24)), length = at<std::uint64_t>(bytes, 32);
    const std::string xml = bytes.substr(xml_at, length);
    EXPECT_EQ(bytes.find_first_not_of('\0', xml_at + length), std::string::npos) << "the last page is filled with 0";
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(xml.c_str()));
    const pugi::xml_node root = document.child("e57Root");
    EXPECT_STREQ(root.attribute("xmlns").value(), "http://www.astm.org/COMMIT/E57/2010-e57-v1.0");
    EXPECT_STREQ(root.child_value("formatName"), "ASTM E57 3D Imaging Data File");
    EXPECT_STREQ(root.child_value("versionMajor"), "1");
    EXPECT_STREQ(root.child_value("versionMinor"), "0");
    EXPECT_EQ(std::string(root.child_value("guid")).size(), 38U);
    std::vector<pugi::xml_node> scans;
    for (const auto& scan : root.child("data3D").children("vectorChild")) scans.push_back(scan);
    ASSERT_EQ(scans.size(), 2U);
    EXPECT_STRNE(scans[0].child_value("guid"), scans[1].child_value("guid"));
    EXPECT_STREQ(scans[0].child_value("name"), "a.las");
    EXPECT_STREQ(scans[1].child_value("name"), "h\xC3\xA4ll<&>\xEF\xBF\xBD.e57#2");
    const auto offset = [](const pugi::xml_node& scan) {
      return logical(scan.child("points").attribute("fileOffset").as_ullong());
    };
    EXPECT_EQ(offset(scans[0]), 48U);
    EXPECT_EQ(check_section(bytes, offset(scans[0]), {64, 64, 64, 8, 8, 8, 16, 64, 32, 32, 32, 32, 1, 8, 16, 32, 32}),
              count);
    EXPECT_EQ(check_section(bytes, offset(scans[1]), {64, 64, 64}), 2U);
    EXPECT_EQ(scans[0].child("points").attribute("recordCount").as_ullong(), count);
  }
}

TEST(E57Writing, PrototypeAndLimitsSayWhatTheNumbersAre) {
  const TempFolder folder;
  RegisteredCloudOptions options = e57_options();
  options.crs = "PROJCS[\"a & b\",\n  UNIT[\"metre\",1]]";
  const std::string bytes = payload_of(read_text(write_two(folder, 300, options)));
  pugi::xml_document document;
  ASSERT_TRUE(
      document.load_string(bytes.substr(logical(at<std::uint64_t>(bytes, 24)), at<std::uint64_t>(bytes, 32)).c_str()));
  const pugi::xml_node root = document.child("e57Root"), scan = root.child("data3D").first_child();
  EXPECT_STREQ(root.child_value("coordinateMetadata"), "PROJCS[\"a & b\",   UNIT[\"metre\",1]]");
  const std::vector<std::array<std::string, 4>> expected = {{"cartesianX", "Float", "", ""},
                                                            {"cartesianY", "Float", "", ""},
                                                            {"cartesianZ", "Float", "", ""},
                                                            {"colorRed", "Integer", "0", "255"},
                                                            {"colorGreen", "Integer", "0", "255"},
                                                            {"colorBlue", "Integer", "0", "255"},
                                                            {"intensity", "Integer", "0", "65535"},
                                                            {"timeStamp", "Float", "", ""},
                                                            {"nor:normalX", "Float", "", ""},
                                                            {"nor:normalY", "Float", "", ""},
                                                            {"nor:normalZ", "Float", "", ""},
                                                            {"rowIndex", "Integer", "-2147483648", "2147483647"},
                                                            {"isColorInvalid", "Integer", "0", "1"},
                                                            {"tcm:label", "Integer", "-128", "127"},
                                                            {"tcm:a_b", "Integer", "-32768", "32767"},
                                                            {"tcm:reflectance", "Float", "", ""},
                                                            {"tcm:count", "Integer", "0", "4294967295"}};
  std::size_t i = 0;
  for (const auto& field : scan.child("points").child("prototype").children()) {
    ASSERT_LT(i, expected.size());
    EXPECT_EQ(field.name(), expected[i][0]);
    EXPECT_EQ(field.attribute("type").value(), expected[i][1]);
    EXPECT_EQ(field.attribute("minimum").value(), expected[i][2]);
    EXPECT_EQ(field.attribute("maximum").value(), expected[i][3]);
    const bool is_single = expected[i][0].starts_with("nor:") || expected[i][0] == "tcm:reflectance";
    EXPECT_EQ(std::string(field.attribute("precision").value()), is_single ? "single" : "") << field.name();
    ++i;
  }
  EXPECT_EQ(i, expected.size());
  EXPECT_STREQ(root.attribute("xmlns:nor").value(), "http://www.libe57.org/E57_NOR_surface_normals.txt");
  EXPECT_STRNE(root.attribute("xmlns:tcm").value(), "");
  EXPECT_STREQ(scan.child("intensityLimits").child_value("intensityMinimum"), "7");
  EXPECT_STREQ(scan.child("intensityLimits").child_value("intensityMaximum"), "306");
  EXPECT_STREQ(scan.child("colorLimits").child_value("colorBlueMaximum"), "255");
  EXPECT_STREQ(scan.child("cartesianBounds").child_value("zMinimum"), "0");
  EXPECT_STREQ(scan.child("cartesianBounds").child_value("zMaximum"), "299");
}

TEST(E57Writing, NothingIsLostOnTheWayBack) {
  const TempFolder folder;
  constexpr std::size_t kCount = 5003;
  const auto scans = scans_in(write_two(folder, kCount, e57_options()));
  ASSERT_EQ(scans.size(), 2U);
  const WholeScan all = read_whole(scans[0]);
  const PointBlock expected = points_with_all(kCount);
  EXPECT_EQ(all.block.points, expected.points);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{1666}, kCount - 1}) {
    EXPECT_EQ(attribute_of<std::uint16_t>(all, i, "intensity"), static_cast<std::uint16_t>(i + 7));
    EXPECT_EQ(attribute_of<std::uint8_t>(all, i, "red"), static_cast<std::uint8_t>(i));
    EXPECT_EQ(attribute_of<double>(all, i, "time"), 1e9 + 0.001 * static_cast<double>(i));
    EXPECT_EQ(attribute_of<float>(all, i, "ny"), 0.8F) << "not turned: that is in the pose";
    EXPECT_EQ(attribute_of<std::int32_t>(all, i, "rowIndex"), static_cast<std::int32_t>(i) - 5);
    EXPECT_EQ(attribute_of<std::uint8_t>(all, i, "isColorInvalid"), i % 3 == 0 ? 1 : 0);
    EXPECT_EQ(attribute_of<std::int8_t>(all, i, "label"), static_cast<std::int8_t>(-128 + static_cast<int>(i % 256)));
    EXPECT_EQ(attribute_of<std::int16_t>(all, i, "a_b"), -32768);
    EXPECT_EQ(attribute_of<float>(all, i, "reflectance"), 0.1F);
    EXPECT_EQ(attribute_of<std::uint32_t>(all, i, "count"), 4294967295U);
  }
  const WholeScan bare = read_whole(scans[1]);
  EXPECT_EQ(bare.block.points, Points({{1, 2, 3}, {-4, 5, 6.5}}));
  EXPECT_TRUE(bare.attributes.empty());
  const auto pose = ScanReader(scans[1]).header_pose();
  ASSERT_TRUE(pose.has_value());
  EXPECT_TRUE(pose->isApprox(to_utm(), 1e-15));
  EXPECT_EQ(ScanReader(scans[0]).header_pose()->matrix(), Eigen::Matrix4d::Identity());
}

TEST(E57Writing, SameContentSameBytesOtherContentOtherGuid) {
  const TempFolder folder;
  const std::string first = read_text(write_two(folder, 100, e57_options()));
  EXPECT_EQ(read_text(write_two(folder, 100, e57_options())), first);
  const auto guid = [](const std::string& file) { return file.substr(file.find(">{") + 1, 38); };
  EXPECT_NE(guid(read_text(write_two(folder, 101, e57_options()))), guid(first));
}

TEST(E57Writing, AScanThatComesAgainIsOneMore) {
  const TempFolder folder;
  const auto path = folder.path() / "out.e57";
  RegisteredCloudWriter writer(path, {{}, {}}, e57_options());
  for (const std::size_t scan : {0U, 1U, 0U}) {
    writer.write(scan, {{{static_cast<double>(scan), 0, 0}}, {}}, {}, Eigen::Isometry3d::Identity());
  }
  writer.finish();
  EXPECT_EQ(scans_in(path).size(), 3U);
  EXPECT_NE(read_text(path).find(">a.las (2)<"), std::string::npos);
}

TEST(E57Writing, MoreColumnsThanAPacketHoldsAreRefused) {
  const TempFolder folder;
  std::vector<Attribute> many;
  for (int i = 0; i < 1200; ++i) many.push_back({std::string("c").append(std::to_string(i)), kFloat64});
  RegisteredCloudWriter writer(folder.path() / "out.e57", {many}, e57_options());
  const PointBlock one{{{0, 0, 0}}, std::vector<std::byte>(attribute_stride(many))};
  const std::string text = error_of<OutputError>([&] { writer.write(0, one, many, Eigen::Isometry3d::Identity()); });
  EXPECT_NE(text.find("use --format ply"), std::string::npos) << text;
}

}  // namespace
}  // namespace tcm_icp
