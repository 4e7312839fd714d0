// Damaged files: each must be read, or refused with an error of ours, and no NaN may come out.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/las_file.hpp"
#include "io/ply_text.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

using test::bytes_of;
using test::Order;
using test::ply_header;
using test::TempFolder;

/// Flips, inserts, removes or repeats a few bytes, or cuts the end off.
std::string damaged(std::string content, Rng& rng) {
  const auto position = [&] { return static_cast<std::size_t>(uniform_index(rng, content.size())); };
  const auto any_byte = [&] { return static_cast<char>(uniform_index(rng, 256)); };
  const std::uint64_t num_changes = 1 + uniform_index(rng, 4);
  for (std::uint64_t change = 0; change < num_changes && !content.empty(); ++change) {
    switch (uniform_index(rng, 6)) {
      case 0:
        content[position()] = any_byte();
        break;
      case 1:
        content[position()] = static_cast<char>('0' + uniform_index(rng, 10));
        break;
      case 2:
        content.insert(position(), 1, any_byte());
        break;
      case 3:
        content.erase(position(), 1 + uniform_index(rng, 8));
        break;
      case 4:
        content.insert(position(), content.substr(position(), 1 + uniform_index(rng, 40)));
        break;
      default:
        content.resize(position());
        break;
    }
  }
  return content;
}

struct Outcome {
  int num_read = 0, num_refused = 0;
};

/// Any exception but ours ends the test.
void read_damaged_scan(const std::filesystem::path& path, Outcome& outcome) {
  try {
    for (const auto& scan : scans_in(path)) {
      ScanReader reader(scan);
      PointBlock block;
      while (reader.read(block, 7)) {
        ASSERT_LE(block.size(), 7u);
        ASSERT_EQ(block.attributes.size(), block.size() * reader.attribute_stride());
        for (const auto& point : block.points) ASSERT_TRUE(point.allFinite());
      }
      const auto pose = reader.header_pose();
      ASSERT_TRUE(!pose || pose->matrix().allFinite());
    }
    ++outcome.num_read;
  } catch (const InputError&) {
    ++outcome.num_refused;
  }
}

std::string binary_ply(Order order) {
  const std::string lines =
      "comment a scan\nelement face 3\nproperty list uchar int vertex_indices\nelement vertex 20\nproperty float "
      "x\nproperty float y\nproperty float z\nproperty ushort i\nproperty list char short l\n";
  std::string content = ply_header(order == Order::kLittle ? "binary_little_endian" : "binary_big_endian", lines);
  for (int i = 0; i < 3; ++i) content.append("\x03").append(12, '\1');
  for (int i = 0; i < 20; ++i) {
    content += bytes_of(static_cast<float>(i), order) + bytes_of(0.5F, order) + bytes_of(-2.0F, order) + "ab\x02long";
  }
  return content;
}

std::string las() {
  test::LasParts parts;
  parts.format = 3;
  parts.record_size = 34 + 4;
  parts.records = test::las_record("LASF_Spec", 4, test::las_extra("e", 9, 0));
  parts.num_records = 1;
  parts.num_points = 20;
  for (int i = 0; i < 20; ++i) parts.points += test::padded(test::las_xyz(i, 2 * i, -i), 34) + bytes_of(1.5F);
  return test::las_file(parts);
}

std::string ptx() {
  std::string text;
  for (int cloud = 0; cloud < 2; ++cloud) {
    text += "4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n5 6 7 1\n";
    for (int i = 0; i < 20; ++i) text += std::to_string(i % 7) + " 0 0 0.5 10 20 30\n";
  }
  return text;
}

std::string pcd(const std::string& data) {
  std::string text =
      "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 20\nHEIGHT 1\nPOINTS 20\nDATA ";
  text.append(data).append("\n");
  std::string bytes;
  for (int i = 0; i < 20; ++i) {
    if (data == "ascii") text.append(std::to_string(i)).append(" 0.5 -3 70000\n");
    bytes += test::joined(static_cast<float>(i), 0.5F, 0.F, 70000U);
  }
  if (data == "ascii") return text;
  if (data == "binary") return text + bytes;
  // Packed: half as it is, half as copies of what stood 160 bytes before.
  std::string packed;
  for (std::size_t at = 0; at < 160; at += 32) packed.append("\x1F").append(bytes, at, 32);
  packed += std::string("\xE0\x97\x9F", 3);
  text += bytes_of(static_cast<std::uint32_t>(packed.size()));
  text += bytes_of(320U);
  return text + packed;
}

TEST(ReaderFuzz, DamagedScansAreReadOrRefused) {
  const TempFolder folder;
  std::string ascii = ply_header("ascii", test::xyz_vertices(20) + "property uchar r\nproperty list uchar int l\n");
  std::string text = "# x y z intensity\n20\n", csv = "x,y,z,t\n";
  for (int i = 0; i < 20; ++i) {
    const std::string number = std::to_string(i);
    ascii += number + " 0.5 -2e1 17 2 5 6\n";
    text += number + ".25 3 nan 7\r\n";
    csv += number + ",1.5,-2.5,3\n";
  }
  const std::vector<std::pair<std::string, std::string>> good = {{"little.ply", binary_ply(Order::kLittle)},
                                                                 {"big.ply", binary_ply(Order::kBig)},
                                                                 {"ascii.ply", ascii},
                                                                 {"a.pts", text},
                                                                 {"a.csv", csv},
                                                                 {"a.las", las()},
                                                                 {"a.ptx", ptx()},
                                                                 {"ascii.pcd", pcd("ascii")},
                                                                 {"binary.pcd", pcd("binary")},
                                                                 {"packed.pcd", pcd("binary_compressed")}};
  for (const auto& [name, content] : good) {
    Rng rng = make_stream(1, "reader_fuzz", name);
    Outcome whole, outcome;
    read_damaged_scan(folder.write(name, content), whole);
    ASSERT_EQ(whole.num_read, 1) << name << " is good before it is damaged";
    for (int i = 0; i < 1000; ++i) {
      ASSERT_NO_FATAL_FAILURE(read_damaged_scan(folder.write(name, damaged(content, rng)), outcome))
          << name << " " << i;
    }
    EXPECT_GT(outcome.num_read, 0) << name;  // else the damage is too crude to reach the reading of data
    EXPECT_GT(outcome.num_refused, 0) << name;
  }
}

TEST(ReaderFuzz, EveryTruncationOfABinaryPlyIsRefused) {
  const TempFolder folder;
  const std::string content = binary_ply(Order::kLittle);
  for (std::size_t length = 0; length < content.size(); ++length) {
    Outcome outcome;
    read_damaged_scan(folder.write("a.ply", content.substr(0, length)), outcome);
    ASSERT_EQ(outcome.num_refused, 1) << length;
  }
}

TEST(ReaderFuzz, DamagedPoseFilesAreReadOrRefused) {
  const TempFolder folder;
  PoseFile poses{"a.ply", {}};
  poses.scans.push_back(
      {"a.ply", ScanStatus::kReference, Eigen::Isometry3d::Identity(), {}, 0, Verdict::kAccepted, "start"});
  poses.scans.push_back({"b.ply", ScanStatus::kUnregistered, Eigen::Isometry3d::Identity(),
                         Eigen::Isometry3d::Identity(), 1, Verdict::kRejected, "no overlap"});
  const auto path = folder.path() / "poses.json";
  write_pose_file(path, poses);
  const std::string content = test::read_text(path);
  Rng rng = make_stream(1, "pose_fuzz");
  Outcome outcome;
  for (int i = 0; i < 1000; ++i) {
    folder.write("poses.json", damaged(content, rng));
    try {
      for (const auto& scan : read_pose_file(path).scans) ASSERT_TRUE(scan.T_reference_scan.matrix().allFinite());
      ++outcome.num_read;
    } catch (const InputError&) {
      ++outcome.num_refused;
    }
  }
  EXPECT_GT(outcome.num_read, 0);
  EXPECT_GT(outcome.num_refused, 0);
}

}  // namespace
}  // namespace tcm_icp
