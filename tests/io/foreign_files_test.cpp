// Files of other programs' reader tests, where they lie beside the repository (or in $TCM_ICP_SHARED): each is read as
// an independent reader has it, or refused with the right reason.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

fs::path formats_folder() {
  std::vector<fs::path> places{fs::path(TCM_ICP_TEST_DATA) / "../../../shared",
                               fs::path(TCM_ICP_TEST_DATA) / "../../../../shared"};
  if (const char* const place = std::getenv("TCM_ICP_SHARED")) places.insert(places.begin(), place);
  for (const auto& place : places) {
    if (fs::is_directory(place / "formats")) return place / "formats";
  }
  return {};
}

class ForeignFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (formats_folder().empty()) GTEST_SKIP() << "there is no ../shared/formats with other programs' files";
  }

  static fs::path file(const std::string& project, const std::string& name) {
    return formats_folder() / project / name;
  }

  /// Points and box of a scan, to the digits of the file.
  static void expect_scan(const fs::path& path, std::size_t num_points, const Eigen::Vector3d& min,
                          const Eigen::Vector3d& max) {
    SCOPED_TRACE(path.filename());
    const test::WholeScan scan = test::read_whole(path);
    ASSERT_EQ(scan.block.size(), num_points);
    Eigen::AlignedBox3d box;
    for (const auto& point : scan.block.points) box.extend(point);
    EXPECT_TRUE(box.min().isApprox(min, 1e-9)) << box.min().transpose();
    EXPECT_TRUE(box.max().isApprox(max, 1e-9)) << box.max().transpose();
  }

  static void expect_refusal(const fs::path& path, const std::string& reason) {
    const std::string message = test::error_of<InputError>([&] {
      for (const auto& scan : scans_in(path)) test::read_whole(scan);
    });
    EXPECT_NE(message.find(reason), std::string::npos) << message;
  }
};

// Counts and boxes by a reader of a few lines in another language (struct.unpack), or by the header's own box.
TEST_F(ForeignFiles, LasIsRead) {
  const Eigen::Vector3d min(635619.85, 848899.70, 406.59), max(638982.55, 853535.43, 586.38);
  expect_scan(file("PDAL+PDAL", "test__data__las__1.2-with-color.las"), 1065, min, max);
  expect_scan(file("PDAL+PDAL", "test__data__las__extrabytes.las"), 1065, min, max);
  expect_scan(file("PDAL+PDAL", "test__data__las__interesting.las"), 1065, min, max);
  expect_scan(file("PDAL+PDAL", "test__data__las__bad_vlr_count.las"), 10, {289814.15, 4320978.61, 170.58},
              {289818.50, 4320980.59, 170.76});
  expect_scan(file("PDAL+PDAL", "test__data__las__4_6_crop.las"), 23875, {1639600, 1454500.02, 7077.92},
              {1639799.98, 1454700, 7139.7});
  expect_scan(file("laspy+laspy", "tests__data__1_4_w_evlr.las"), 1000, {1694038.446, 1816492.706, 5592.749917},
              {1694539.677, 1816497.976, 5599.069687});
  expect_scan(file("laspy+laspy", "tests__data__vegetation_1_3.las"), 10683, {-98451.205, -55975.417, -81460.091},
              {-98447.447, -55969.405, -81455.203});
  expect_scan(file("hobuinc+laz-perf", "cpp__test__raw-sets__1815.las"), 1247, {2014000.418, 6493002.071, 87.9591828},
              {2014999.693, 6493999.930, 124.0741328});
}

TEST_F(ForeignFiles, CoordinateSystemsOfLasAreTold) {
  EXPECT_EQ(ScanReader(file("PDAL+PDAL", "test__data__las__utm17.las")).coordinate_system(), "EPSG:32617");
  EXPECT_EQ(ScanReader(file("PDAL+PDAL", "test__data__las__wontcompress3.las")).coordinate_system().substr(0, 29),
            "PROJCS[\"NAD83 / UTM zone 19N\"");
}

TEST_F(ForeignFiles, EveryLasThatIsWholeIsRead) {
  int num_read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(formats_folder())) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".las") continue;
    if (name.find("garbage_nVariableLength") != std::string::npos) {
      expect_refusal(entry.path(), "promises 719 points, but has room for 718");
    } else if (name.find("1.2-no-points") != std::string::npos) {
      expect_refusal(entry.path(), "promises 1065 points, but has room for 0");
    } else {
      EXPECT_NO_THROW(test::read_whole(entry.path())) << name;
      ++num_read;
    }
  }
  EXPECT_GE(num_read, 25);
}

TEST_F(ForeignFiles, CompressedLasIsRefused) {
  expect_refusal(file("PDAL+PDAL", "test__data__laz__simple.laz"), "is compressed (LAZ)");
  expect_refusal(file("PDAL+PDAL", "test__data__copc__1.2-with-color.copc.laz"), "is compressed (COPC)");
}

TEST_F(ForeignFiles, PcdIsRead) {
  expect_scan(file("PDAL+PDAL", "test__data__pcd__autzen-utm.pcd"), 1065, {493994.87, 4877429.62, 123.93},
              {494993.68, 4878817.02, 178.73});
  for (const char* const kind : {"comma", "space", "tab"}) {
    expect_scan(file("PDAL+PDAL", std::string("test__data__pcd__utm17_") + kind + ".pcd"), 10,
                {289814.15, 4320978.61, 170.58}, {289818.50, 4320980.59, 170.76});
  }
  expect_refusal(file("PDAL+PDAL", "test__data__pcd__missingheader.pcd"), "which PCD does not know");
}

TEST_F(ForeignFiles, PtxAndPtsAreRead) {
  expect_scan(file("PDAL+PDAL", "test__data__ptx__1.2-with-color.ptx"), 1065, {635619.85, 848899.70, 406.59},
              {638982.55, 853535.43, 586.38});
  expect_scan(file("PDAL+PDAL", "test__data__ptx__complex-transform.ptx"), 4, {-0.00563, 0.645218, -0.441879},
              {-0.0056, 0.650467, -0.438828});
  EXPECT_EQ(scans_in(file("PDAL+PDAL", "test__data__ptx__multiple-and-transform.ptx")).size(), 2u);
  expect_scan(file("PDAL+PDAL", "test__data__pts__test.pts"), 19, {-25.050461, -24.533554, -2.000961},
              {3.980972, -2.006119, -0.010086});
  expect_refusal(file("PDAL+PDAL", "test__data__pts__bunny_8.pts"), "one point more");
}

// Boxes by a reader of its own in another language, points one by one.
TEST_F(ForeignFiles, E57IsRead) {
  const std::string names = "asmaloney+libE57Format-test-data";
  const Eigen::Vector3d min(-0.094689, 0.040011, -0.061873), max(0.061009, 0.187321, 0.058799);
  expect_scan(file(names, "reference__bunnyDouble.e57"), 30571, min, max);
  expect_scan(file(names, "reference__bunnyInt32.e57"), 30571, min, max);
  for (const char* const kind : {"ColouredCubeDouble", "ColouredCubeFloat"}) {
    expect_scan(file(names, std::string("self__") + kind + ".e57"), 7680, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  }
  expect_scan(file("davidcaron+pye57", "tests__test_data__pumpAVisualReferenceImage.e57"), 155201,
              {-2.903763, -5.301102, -1.899704}, {1.721603, -0.792648, 1.843002});
  const auto moved = file("davidcaron+pye57", "tests__test_data__translationWithoutRotation.e57");
  EXPECT_EQ(ScanReader(moved).header_pose().value().translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(scans_in(file("PDAL+PDAL", "test__data__e57__A_B.e57")).size(), 2u);
  expect_refusal(file(names, "self__bad-crc.e57"), "check sum of this page is wrong");
  expect_refusal(file(names, "self__empty.e57"), "holds no scan");
  EXPECT_TRUE(test::read_whole(file(names, "self__ZeroPoints.e57")).block.points.empty());
}

}  // namespace
}  // namespace tcm_icp
