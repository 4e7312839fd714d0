// make_fuzz_seeds FOLDER: small good files, a folder of them for each fuzz target.

#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/e57_file.hpp"
#include "io/las_file.hpp"
#include "io/ply_text.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tcm_icp;
using test::joined;

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What the program's own writers make of a scan with attributes.
void write_own(const fs::path& folder) {
  const std::vector<Attribute> attributes = {{"intensity", ScalarType::kUInt16}, {"red", ScalarType::kUInt8},
                                             {"green", ScalarType::kUInt8},      {"blue", ScalarType::kUInt8},
                                             {"time", ScalarType::kFloat64},     {"label", ScalarType::kInt8}};
  PointBlock block;
  std::string bytes;
  for (int i = 0; i < 12; ++i) {
    block.points.emplace_back(i, 0.5 * i, -i);
    bytes += joined(static_cast<std::uint16_t>(i), std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}, 0.25 * i,
                    static_cast<std::int8_t>(-i));
  }
  block.attributes.resize(bytes.size());
  std::memcpy(block.attributes.data(), bytes.data(), bytes.size());
  for (const auto format : {CloudFormat::kPly, CloudFormat::kLas, CloudFormat::kPcd, CloudFormat::kText,
                            CloudFormat::kE57, CloudFormat::kPtx}) {
    RegisteredCloudOptions options;
    options.format = format;
    options.reference = "a";
    options.box.extend(Eigen::Vector3d(0, 0, -12));
    options.box.extend(Eigen::Vector3d(12, 6, 0));
    const std::string name(extension_of(format).substr(1));
    fs::create_directories(folder / name);
    RegisteredCloudWriter writer(folder / name / "own", {attributes}, options);
    writer.write(0, block, attributes, Eigen::Isometry3d::Identity());
    writer.finish();
  }
}

void write_ply(const fs::path& folder) {
  for (const auto order : {test::Order::kLittle, test::Order::kBig}) {
    const bool little = order == test::Order::kLittle;
    std::string file = test::ply_header(little ? "binary_little_endian" : "binary_big_endian",
                                        "comment a scan\nelement face 2\nproperty list uchar int vertex_indices\n" +
                                            test::xyz_vertices(3) + "property list char short l\n");
    for (int i = 0; i < 2; ++i) file.append("\x03").append(12, '\1');
    for (int i = 0; i < 3; ++i) {
      for (const float value : {1.F, 2.F, static_cast<float>(i)}) file += test::bytes_of(value, order);
      file.append("\x02long");
    }
    write(folder / (little ? "little" : "big"), file);
  }
  write(folder / "ascii", test::ply_header("ascii", test::xyz_vertices(2) + "property list uchar int l\n") +
                              "1 2 3 2 5 6\n-1e3 .5 nan 0\n");
}

void write_las(const fs::path& folder) {
  for (const int format : {1, 7}) {
    test::LasParts parts;
    parts.minor = 4;
    parts.format = format;
    const std::size_t size = format == 1 ? 28 : 36;
    parts.record_size = static_cast<std::uint16_t>(size + 4);
    parts.records = test::las_record("LASF_Spec", 4, test::las_extra("e", 9, 8, 0.5)) +
                    test::las_record("LASF_Projection", 2112, "PROJCS[\"a\"]");
    parts.num_records = 2;
    parts.num_points = 4;
    for (int i = 0; i < 4; ++i) parts.points += test::padded(test::las_xyz(i, 2 * i, -i), size) + joined(1.5F);
    std::string file = test::las_file(parts);
    test::put(file, 235, std::uint64_t{file.size()});
    test::put(file, 243, std::uint32_t{1});
    file += joined(std::uint16_t{0}) + test::padded("LASF_Projection", 16) +
            joined(std::uint16_t{2112}, std::uint64_t{11}) + test::padded("", 32) + "PROJCS[\"b\"]";
    write(folder / std::to_string(format), file);
  }
}

void write_pcd(const fs::path& folder) {
  const std::string head =
      "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 20\nHEIGHT 1\nPOINTS 20\nDATA ";
  std::string text = head + "ascii\n", bytes;
  for (int i = 0; i < 20; ++i) {
    text += std::to_string(i) + " 0.5 -3 70000\n";
    bytes += joined(static_cast<float>(i), 0.5F, 0.F, 70000U);
  }
  write(folder / "ascii", text);
  write(folder / "binary", head + "binary\n" + bytes);
  std::string packed;  // half as it is, half as copies of what stood 160 bytes before
  for (std::size_t at = 0; at < 160; at += 32) packed.append("\x1F").append(bytes, at, 32);
  packed += std::string("\xE0\x97\x9F", 3);
  write(folder / "compressed",
        head + "binary_compressed\n" + joined(static_cast<std::uint32_t>(packed.size()), 320U) + packed);
}

void write_e57(const fs::path& folder) {
  test::E57Parts scan;
  scan.num_points = 3;
  scan.num_packets = 2;
  scan.pose =
      "<pose type=\"Structure\"><rotation type=\"Structure\"><w type=\"Float\">1</w></rotation>"
      "<translation type=\"Structure\"><x type=\"Float\">10</x></translation></pose>";
  scan.columns = {
      {"sphericalRange", "type=\"Float\"", joined(2.0, 2.0, 2.0)},
      {"sphericalAzimuth", "type=\"Float\" precision=\"single\"", joined(0.F, 1.F, 0.3F)},
      {"sphericalElevation", "type=\"ScaledInteger\" minimum=\"0\" maximum=\"1000\" scale=\"0.001\"",
       test::packed_bits({1, 999, 500}, 10)},
      {"sphericalInvalidState", "type=\"Integer\" minimum=\"0\" maximum=\"2\"", test::packed_bits({0, 1, 0}, 2)},
      {"colorRed", "type=\"Integer\" minimum=\"0\" maximum=\"255\"", test::packed_bits({1, 2, 3}, 8)},
      {"note", "type=\"String\"", "ab"}};
  write(folder / "two", test::e57_file({scan, scan}));
}

void write_text(const fs::path& folder) {
  std::string ptx;
  for (int cloud = 0; cloud < 2; ++cloud) {
    ptx += "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n5 6 7 1\n";
    for (int i = 0; i < 4; ++i) ptx += std::to_string(i) + " 0 0 0.5 10 20 30\n";
  }
  write(folder / "ptx/two", ptx);
  write(folder / "pts/two", "2\n1 2 3 -5 1 2 3\n4 5 6 7 255 0 0\n1\n1 2 3 -5 1 2 3\n");
  write(folder / "xyz/plain", "# x y z intensity\n1.25 3 nan 7\r\n+1e3 1.#QNAN -.5 1\n");
  write(folder / "xyz/commas", "1,25 3,5 -2\n1,5 2,5 3,5\n");
  write(folder / "csv/header", "\"Easting [m]\";North;Height;R;G;B\n1,5;2,5;3,5;1;2;3\n");
  write(folder / "csv/comma", "x,y,z,t\n1,1.5,-2.5,3\n");
  write(folder / "kitti/a", joined(1.F, 2.F, 3.F, 0.5F, 4.F, 5.F, 6.F, 0.F));
  write(folder / "nuscenes/a", joined(1.F, 2.F, 3.F, 0.5F, 7.F));
}

void write_gzip(const fs::path& folder) {
  int number = 0;
  for (const char* const from : {"xyz/plain", "ptx/two", "las/1", "pcd/binary", "ply/ascii", "e57/two"}) {
    write(folder / "gzip" / std::to_string(number), static_cast<char>(2 * number) + read(folder / from));
    ++number;
  }
  const std::string text = read(folder / "xyz/plain");
  const fs::path packed = folder / "packed.gz";
  gzFile file = gzopen(packed.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  write(folder / "gzip/raw", '\1' + read(packed).substr(2));
  fs::remove(packed);
}

void write_json(const fs::path& folder) {
  PoseFile poses{"a.ply", {}};
  poses.scans.push_back(
      {"a.ply", ScanStatus::kReference, Eigen::Isometry3d::Identity(), {}, 0, Verdict::kAccepted, "start"});
  poses.scans.push_back({"b.ply", ScanStatus::kUnregistered, Eigen::Isometry3d::Identity(),
                         Eigen::Isometry3d::Identity(), 1, Verdict::kRejected, "no overlap"});
  fs::create_directories(folder / "poses");
  write_pose_file(folder / "poses/own", poses);
  const std::string one = "\"pose\": [[1,0,0,0.5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}";
  const std::string truth = "{\"scans\": [{\"file\": \"a.ply\", " + one + ", {\"file\": \"b.ply\", \"group\": 1, " +
                            one +
                            "], \"tolerance\": {\"rotation_deg\": 1, \"rmse_m\": 0.1}, \"overlap\": [[1,0.5],[0.4,1]]}";
  write(folder / "truth/a", truth);
  write(folder / "poses/init", truth);
  write(folder / "priors/a",
        "{\"scans\": [{\"file\": \"b.ply\", \"sigma_position_m\": 0.02, \"sigma_rotation_deg\": 0.1, " + one + "]}");
  write(folder / "config/a",
        "seed = 7\nsolver = glpk\nlevel = true\nvoxel = 0.05\n# text\nsampling.working-points = 20000\n");
}

void write_survey(const fs::path& folder) {
  write(folder / "control/measured",
        "name,scan,x,y,z,X,Y,Z,sigma,sigma_scan,use\nT1,a.ply,4.1,-2.5,1,512345.678,5412301.112,287.513,0.001,0.003,"
        "control\n"
        "T1,hall.ptx#2,-9.4,0.7,1.1,512345.678,5412301.112,287.513,0.001,,check\n");
  write(folder / "control/excel",
        "\xEF\xBB\xBF# targets\r\nname;scan;x;y;z;Easting;Northing;Height;sigma_E;sigma_N;sigma_H\r\n"
        "\"T \"\"1\"\"\";*;1;2;3;4;5;6;.01;.01;.02\r\n");
  write(folder / "positions/origins", "scan,X,Y,Z,sigma\na.ply,1,2,3,0.5\nhall.ptx#1,4,5,6,0.5\n");
  write(folder / "positions/lever", "scan;E;N;H;sigma_E;sigma_N;sigma_H;x;y;z\na.ply;1e3;2;+3;.5;.5;1;0;0;-.1\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const fs::path folder = argv[1];
  write_own(folder);
  write_ply(folder / "ply");
  write_las(folder / "las");
  write_pcd(folder / "pcd");
  write_e57(folder / "e57");
  write_text(folder);
  write_gzip(folder);
  write_json(folder);
  write_survey(folder);
  return 0;
}
