// What reading costs by file format, for scripts/bench.py: writes seeded points into a folder in every format, and
// reads each file by ScanReader, the coordinates alone and with all attributes.
//   tcm_icp_read_formats FOLDER POINTS
// Text formats have two fifths of the points. Prints a line of JSON a file: what it holds, its bytes and points, and
// the processor time of both, the least of three.

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/scalar.hpp"
#include "tcm_icp/io/registered_cloud_writer.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

constexpr double kSideM = 100;
constexpr int kRounds = 3;

const std::vector<Attribute> kNone;
const std::vector<Attribute> kIntensity{{"intensity", ScalarType::kFloat32}};
const std::vector<Attribute> kColoured{{"intensity", ScalarType::kFloat32},
                                       {"red", ScalarType::kUInt8},
                                       {"green", ScalarType::kUInt8},
                                       {"blue", ScalarType::kUInt8}};
// Of format 7 of LAS 1.4.
const std::vector<Attribute> kAirborne{{"intensity", ScalarType::kUInt16},
                                       {"return_number", ScalarType::kUInt8},
                                       {"number_of_returns", ScalarType::kUInt8},
                                       {"classification", ScalarType::kUInt8},
                                       {"user_data", ScalarType::kUInt8},
                                       {"scan_angle", ScalarType::kFloat32},
                                       {"point_source_id", ScalarType::kUInt16},
                                       {"gps_time", ScalarType::kFloat64},
                                       {"red", ScalarType::kUInt16},
                                       {"green", ScalarType::kUInt16},
                                       {"blue", ScalarType::kUInt16}};

struct Kind {
  const char* name;
  CloudFormat format;
  const std::vector<Attribute>& attributes;
};
const Kind kKinds[]{{"PLY, intensity", CloudFormat::kPly, kIntensity},
                    {"PCD, intensity", CloudFormat::kPcd, kIntensity},
                    {"LAS 1.4", CloudFormat::kLas, kAirborne},
                    {"E57, intensity", CloudFormat::kE57, kIntensity},
                    {"E57, columns of LAS", CloudFormat::kE57, kAirborne},
                    {"PTX, intensity and colour", CloudFormat::kPtx, kColoured},
                    {"text, coordinates", CloudFormat::kText, kNone},
                    {"text, intensity", CloudFormat::kText, kIntensity}};

bool is_text(CloudFormat format) { return format == CloudFormat::kPtx || format == CloudFormat::kText; }

// Coordinates to a tenth of a millimetre, as scanners have them; values that every type holds.
PointBlock made_up(std::size_t count, const std::vector<Attribute>& attributes) {
  std::mt19937_64 random(1);
  PointBlock block;
  block.points.resize(count);
  for (auto& p : block.points) {
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = static_cast<double>(random() % static_cast<std::uint64_t>(kSideM * 1e4)) / 1e4;
    }
  }
  block.attributes.resize(count * attribute_stride(attributes));
  std::byte* at = block.attributes.data();
  for (std::size_t i = 0; i < count; ++i) {
    for (const Attribute& a : attributes) {
      store_scalar(static_cast<double>(1 + random() % 7), a.type, at);
      at += scalar_size(a.type);
    }
  }
  return block;
}

std::filesystem::path write(const Kind& kind, const std::filesystem::path& folder, std::size_t count) {
  const PointBlock block = made_up(count, kind.attributes);
  RegisteredCloudOptions options;
  options.format = kind.format;
  options.one_scan = true;
  for (const auto& p : block.points) options.box.extend(p);
  const std::filesystem::path path = folder / ("cloud" + std::string(extension_of(kind.format)));
  RegisteredCloudWriter writer(path, {kind.attributes}, options);
  writer.write(0, block, kind.attributes, Eigen::Isometry3d::Identity());
  writer.finish();
  return path;
}

double read_s(const std::filesystem::path& path, ReadAttributes attributes, std::size_t count) {
  double least_s = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const std::clock_t begin = std::clock();
    ScanReader reader(path, attributes);
    for (PointBlock block; reader.read(block);) {
    }
    least_s = std::min(least_s, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (reader.num_points() != count) throw std::runtime_error(path.string() + ": points are missing");
  }
  return least_s;
}

void measure(const std::filesystem::path& folder, std::size_t num_points) {
  for (const Kind& kind : kKinds) {
    const std::size_t count = is_text(kind.format) ? num_points * 2 / 5 : num_points;
    const std::filesystem::path path = write(kind, folder, count);
    const nlohmann::json row{{"file", kind.name},
                             {"bytes", std::filesystem::file_size(path)},
                             {"points", count},
                             {"coordinates_s", read_s(path, ReadAttributes::kNo, count)},
                             {"all_s", read_s(path, ReadAttributes::kYes, count)}};
    std::cout << row.dump() << '\n' << std::flush;
    std::filesystem::remove(path);
  }
}

}  // namespace
}  // namespace tcm_icp

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "Usage: tcm_icp_read_formats FOLDER POINTS\n";
    return 1;
  }
  try {
    tcm_icp::measure(argv[1], std::stoul(argv[2]));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}
