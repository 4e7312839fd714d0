#include "pipeline/registered_clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "io/binary_text.hpp"
#include "io/las_file.hpp"
#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;
using test::attribute_of;
using test::read_whole;
using test::TempFolder;
using test::WholeScan;

/// Two scans of 3,000 points in UTM coordinates, the first with a time and the second without; a third that is
/// unregistered.
struct Scene {
  explicit Scene(const TempFolder& folder) {
    Rng rng = make_stream(5, "clouds");
    std::string a = "# x y z time\n", b;
    for (int i = 0; i < 3000; ++i) {
      char line[160];
      const auto at = [&](double from) { return from + 10 * uniform01(rng); };
      std::snprintf(line, sizeof line, "%.4f %.4f %.4f %d.25\n", at(5e5), at(5e6), at(100), i);
      a += line;
      std::snprintf(line, sizeof line, "%.4f %.4f %.4f\n", at(5e5), at(5e6), at(100));
      b += line;
    }
    paths = {folder.write("a.xyz", a), folder.write("b.xyz", b), folder.write("c.xyz", b)};
    result.scans.resize(3);
    result.poses.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
      result.scans[i].file = result.poses[i].file = paths[i].filename().string();
      result.scans[i].num_points = 3000;
    }
    result.poses[0].status = ScanStatus::kReference;
    result.poses[1].status = ScanStatus::kRegistered;
    result.poses[1].T_reference_scan.translation() << 0.5, 0.25, 0;
  }

  std::vector<fs::path> paths;
  PipelineResult result;
};

WholeScan merged(const TempFolder& folder, const Scene& scene, const OutputOptions& options,
                 std::uint64_t most_voxels = kMostVoxels) {
  write_registered_clouds(folder.path(), scene.paths, scene.result, options, {}, most_voxels);
  return read_whole(folder.path() / ("registered" + std::string(extension_of(options.format))));
}

std::vector<std::array<double, 3>> sorted_points(const WholeScan& scan) {
  std::vector<std::array<double, 3>> points;
  for (const auto& p : scan.block.points) points.push_back({p.x(), p.y(), p.z()});
  std::sort(points.begin(), points.end());
  return points;
}

TEST(RegisteredClouds, VoxelsInSeveralPartsKeepTheSamePoints) {
  const TempFolder folder;
  const Scene scene(folder);
  OutputOptions options;
  options.voxel_m = 0.8;
  const auto whole = sorted_points(merged(folder, scene, options));
  const auto parts = sorted_points(merged(folder, scene, options, 300));
  EXPECT_EQ(parts, whole);
  EXPECT_LT(whole.size(), 3000U);
  EXPECT_GT(whole.size(), 1000U);
}

TEST(RegisteredClouds, LasHasProjectedCoordinatesToAFractionOfAMicrometre) {
  const TempFolder folder;
  const Scene scene(folder);
  OutputOptions options;
  const WholeScan ply = merged(folder, scene, options);
  options.format = CloudFormat::kLas;
  options.each = true;
  const WholeScan las = merged(folder, scene, options);
  ASSERT_EQ(las.block.size(), 6000U);
  for (std::size_t i = 0; i < las.block.size(); ++i) {
    ASSERT_LT((las.block.points[i] - ply.block.points[i]).norm(), 2e-8) << i;
    ASSERT_EQ(attribute_of<double>(las, i, "time"), i < 3000 ? static_cast<double>(i) + 0.25 : 0.0);
    ASSERT_EQ(attribute_of<std::uint16_t>(las, i, "point_source_id"), i < 3000 ? 1 : 2);
  }
  const WholeScan a = read_whole(folder.path() / "scans/a.xyz.las"), b = read_whole(folder.path() / "scans/b.xyz.las");
  EXPECT_EQ(attribute_of<double>(a, 17, "time"), 17.25);
  EXPECT_EQ(attribute_of<std::uint16_t>(b, 0, "point_source_id"), 2);
  const auto& names = b.attributes;
  EXPECT_TRUE(std::none_of(names.begin(), names.end(), [](const Attribute& x) { return x.name == "time"; }));
  EXPECT_FALSE(fs::exists(folder.path() / "scans/c.xyz.las"));
}

TEST(RegisteredClouds, E57HasEachScanRawWithItsPose) {
  const TempFolder folder;
  const Scene scene(folder);
  OutputOptions options;
  const WholeScan ply = merged(folder, scene, options);
  options.format = CloudFormat::kE57;
  options.each = true;
  write_registered_clouds(folder.path(), scene.paths, scene.result, options, {});
  const auto scans = scans_in(folder.path() / "registered.e57");
  ASSERT_EQ(scans.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const WholeScan raw = read_whole(scene.paths[i]), written = read_whole(scans[i]);
    const fs::path own = folder.path() / ("scans/" + scene.paths[i].filename().string() + ".e57");
    EXPECT_EQ(written.block.points, raw.block.points);
    EXPECT_EQ(written.attributes, raw.attributes);
    EXPECT_EQ(written.block.attributes, raw.block.attributes);
    EXPECT_EQ(read_whole(own).block.points, raw.block.points);
    const auto pose = ScanReader(scans[i]).header_pose();
    ASSERT_TRUE(pose.has_value());
    EXPECT_EQ(pose->matrix(), ScanReader(own).header_pose()->matrix());
    for (std::size_t k = 0; k < 3000; ++k) {
      ASSERT_LT((*pose * written.block.points[k] - ply.block.points[3000 * i + k]).norm(), 1e-8) << k;
    }
  }
  EXPECT_EQ(ScanReader(scans[0]).coordinate_system(), "");
}

TEST(RegisteredClouds, E57InPartsHasTheSamePoints) {
  const TempFolder folder;
  const Scene scene(folder);
  OutputOptions options;
  options.voxel_m = 0.8;
  options.format = CloudFormat::kE57;
  const auto points = [&](std::uint64_t most_voxels) {
    write_registered_clouds(folder.path(), scene.paths, scene.result, options, {}, most_voxels);
    std::vector<std::array<double, 3>> all;
    for (const auto& scan : scans_in(folder.path() / "registered.e57")) {
      for (const auto& p : sorted_points(read_whole(scan))) all.push_back(p);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto whole = points(kMostVoxels);
  EXPECT_EQ(points(300), whole);
  EXPECT_GT(whole.size(), 1000U);
}

TEST(RegisteredClouds, E57NamesTheReferencesCoordinateSystemWhereItHolds) {
  const TempFolder folder;
  Scene scene(folder);
  const auto system_in_result = [&](const std::string& system) {
    test::LasParts parts;
    parts.records = test::las_record("LASF_Projection", 2112, system + '\0');
    parts.num_records = 1;
    parts.num_points = 20;
    for (int i = 0; i < 20; ++i) parts.points += test::padded(test::las_xyz(i, 2 * i, -i), 20);
    scene.paths[0] = folder.write("a.las", test::las_file(parts));
    OutputOptions options;
    options.format = CloudFormat::kE57;
    write_registered_clouds(folder.path(), scene.paths, scene.result, options, {});
    return ScanReader(folder.path() / "registered.e57#1").coordinate_system();
  };
  const std::string system = "PROJCS[\"somewhere\"]";
  EXPECT_EQ(system_in_result(system), system);
  EXPECT_EQ(system_in_result("EPSG:25832"), "") << "no well-known text";
  scene.result.scans[0].unit = "ft";
  EXPECT_EQ(system_in_result(system), "") << "the coordinates were converted";
  scene.result.scans[0].unit = "m";
  scene.result.poses[0].T_reference_scan.translation() << 1, 0, 0;
  EXPECT_EQ(system_in_result(system), "") << "and moved";
}

TEST(RegisteredClouds, WithoutRegisteredScansTheCloudIsEmpty) {
  const TempFolder folder;
  Scene scene(folder);
  for (auto& pose : scene.result.poses) pose.status = ScanStatus::kUnregistered;
  OutputOptions options;
  options.each = true;
  options.voxel_m = 1;
  for (const auto format : {CloudFormat::kPly, CloudFormat::kLas, CloudFormat::kPcd}) {
    options.format = format;
    EXPECT_EQ(merged(folder, scene, options).block.size(), 0U);
  }
  EXPECT_FALSE(fs::exists(folder.path() / "scans"));
}

TEST(RegisteredClouds, PcdFarAwayIsWarnedOf) {
  const TempFolder folder;
  const Scene scene(folder);
  OutputOptions options;
  options.format = CloudFormat::kPcd;
  RunContext context;
  std::string warnings;
  context.log = [&](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) warnings += text;
  };
  write_registered_clouds(folder.path(), scene.paths, scene.result, options, context);
  EXPECT_NE(warnings.find("registered.pcd has its coordinates as doubles"), std::string::npos) << warnings;
}

TEST(RegisteredClouds, PtxHasEachScanRawWithItsPoseAndSaysWhatItLeavesOut) {
  const TempFolder folder;
  const Scene scene(folder);
  OutputOptions options;
  options.format = CloudFormat::kPtx;
  options.each = true;
  RunContext context;
  std::string warnings;
  context.log = [&](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) warnings += text;
  };
  write_registered_clouds(folder.path(), scene.paths, scene.result, options, context);
  EXPECT_NE(warnings.find("registered.ptx is without time: PTX has"), std::string::npos) << warnings;
  const auto scans = scans_in(folder.path() / "registered.ptx");
  ASSERT_EQ(scans.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const fs::path own = folder.path() / ("scans/" + scene.paths[i].filename().string() + ".ptx");
    EXPECT_EQ(read_whole(scans[i]).block.points, read_whole(scene.paths[i]).block.points);
    EXPECT_EQ(read_whole(own).block.points, read_whole(scene.paths[i]).block.points);
    for (const fs::path& path : {scans[i], own}) {
      const auto pose = ScanReader(path).header_pose();
      ASSERT_TRUE(pose.has_value());
      EXPECT_TRUE(pose->isApprox(scene.result.poses[i].T_reference_scan, 1e-14));
    }
  }
}

TEST(RegisteredClouds, ScansWhoseFilesWouldHaveOneNameDoNotOverwriteEachOther) {
  const TempFolder folder;
  Scene scene(folder);
  scene.result.poses[0].file = "a";
  scene.result.poses[1].file = "a.ply";
  OutputOptions options;
  options.each = true;
  merged(folder, scene, options);
  EXPECT_EQ(ScanReader(folder.path() / "scans/a.ply").attributes().size(), 1U);
  EXPECT_EQ(ScanReader(folder.path() / "scans/a.ply.ply").attributes().size(), 0U);
}

TEST(OutputOptions, RefusesAVoxelThatIsNoLength) {
  OutputOptions options;
  EXPECT_NO_THROW(options.validate());
  options.voxel_m = -1;
  EXPECT_THROW(options.validate(), InvalidOptions);
  options.voxel_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(options.validate(), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp
