// Files of other programs' reader tests, where they lie beside the repository (or in $TCM_ICP_SHARED): each is read as
// an independent reader has it, or refused with the right reason.

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
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

struct ReadFile {
  const char* name;  // with #K where a file holds several scans
  std::size_t num_points;
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();
};

// Counts and boxes by readers of a few lines in another language (struct.unpack, numpy), without a library.
const std::vector<ReadFile>& files_that_are_read() {
  static const std::vector<ReadFile> files{
      {"PDAL+PDAL/test__data__e57__A4.e57",
       4,
       {-44.9522018433, -1.34930002689, -0.607699990273},
       {-44.3000984192, -0.885999977589, 0.369399994612}},
      {"PDAL+PDAL/test__data__e57__A4_moved.e57",
       4,
       {-44.1194381714, 0.705303072929, -0.607699990273},
       {-43.4673347473, 1.16860318184, 0.369399994612}},
      {"PDAL+PDAL/test__data__e57__A_B.e57#1",
       2,
       {-42.6422996521, 1.87259995937, 0.510100007057},
       {-42.6394996643, 2.05780005455, 0.666700005531}},
      {"PDAL+PDAL/test__data__e57__A_B.e57#2",
       4,
       {-44.9522018433, -1.34930002689, -0.607699990273},
       {-44.3000984192, -0.885999977589, 0.369399994612}},
      {"PDAL+PDAL/test__data__e57__A_B_different_dims.e57#1",
       1,
       {84.1740264893, 537.270324707, 4.62872600555},
       {84.1740264893, 537.270324707, 4.62872600555}},
      {"PDAL+PDAL/test__data__e57__A_B_different_dims.e57#2",
       1,
       {83.197845459, 538.468444824, 4.59027576447},
       {83.197845459, 538.468444824, 4.59027576447}},
      {"PDAL+PDAL/test__data__e57__A_moved_B.e57#1",
       2,
       {-42.6422996521, 1.87259995937, 0.510100007057},
       {-42.6394996643, 2.05780005455, 0.666700005531}},
      {"PDAL+PDAL/test__data__e57__A_moved_B.e57#2",
       4,
       {-44.1194381714, 0.705302834511, -0.607699990273},
       {-43.4673347473, 1.16860294342, 0.369399994612}},
      {"PDAL+PDAL/test__data__e57__B2.e57",
       2,
       {-42.6422996521, 1.87259995937, 0.510100007057},
       {-42.6394996643, 2.05780005455, 0.666700005531}},
      {"PDAL+PDAL/test__data__las__1.2-with-color.las",
       1065,
       {635619.85, 848899.7, 406.59},
       {638982.55, 853535.43, 586.38}},
      {"PDAL+PDAL/test__data__las__4_6_crop.las", 23875, {1639600, 1454500.02, 7077.92}, {1639799.98, 1454700, 7139.7}},
      {"PDAL+PDAL/test__data__las__bad-geotiff-keys.las",
       10,
       {289814.15, 4320978.61, 170.58},
       {289818.5, 4320980.59, 170.76}},
      {"PDAL+PDAL/test__data__las__bad_vlr_count.las",
       10,
       {289814.15, 4320978.61, 170.58},
       {289818.5, 4320980.59, 170.76}},
      {"PDAL+PDAL/test__data__las__extrabytes.las",
       1065,
       {635619.85, 848899.7, 406.59},
       {638982.55, 853535.43, 586.38}},
      {"PDAL+PDAL/test__data__las__gps-time-nan.las", 1, {0, 0, 0}, {0, 0, 0}},
      {"PDAL+PDAL/test__data__las__interesting.las",
       1065,
       {635619.85, 848899.7, 406.59},
       {638982.55, 853535.43, 586.38}},
      {"PDAL+PDAL/test__data__las__lots_of_vlr.las",
       1,
       {715001.346, 839349.171, 17.275},
       {715001.346, 839349.171, 17.275}},
      {"PDAL+PDAL/test__data__las__no-points.las", 0},
      {"PDAL+PDAL/test__data__las__permutations__1.0_0.las", 1, {470692.44, 4602888.9, 16}, {470692.44, 4602888.9, 16}},
      {"PDAL+PDAL/test__data__las__permutations__1.1_1.las", 1, {470692.44, 4602888.9, 16}, {470692.44, 4602888.9, 16}},
      {"PDAL+PDAL/test__data__las__permutations__1.2_3.las", 1, {470692.44, 4602888.9, 16}, {470692.44, 4602888.9, 16}},
      {"PDAL+PDAL/test__data__las__spurious.las",
       1065,
       {-124.0687348, 44.0500086, 123.93},
       {-123.0625001, 44.0624972, 178.73}},
      {"PDAL+PDAL/test__data__las__synthetic_test.las", 1, {1, 2, 3}, {1, 2, 3}},
      {"PDAL+PDAL/test__data__las__test1_4.las",
       1000,
       {1694038.44564, 1816492.70627, 5592.74991747},
       {1694539.67701, 1816497.97626, 5599.06968675}},
      {"PDAL+PDAL/test__data__las__utm17.las", 10, {289814.15, 4320978.61, 170.58}, {289818.5, 4320980.59, 170.76}},
      {"PDAL+PDAL/test__data__las__wontcompress3.las",
       1000,
       {768321.06, 2028734.533, 104.98},
       {768376.937, 2028768.078, 113.03}},
      {"PDAL+PDAL/test__data__pcd__autzen-utm.pcd",
       1065,
       {493994.87, 4877429.62, 123.93},
       {494993.68, 4878817.02, 178.73}},
      {"PDAL+PDAL/test__data__pcd__utm17_comma.pcd",
       10,
       {289814.15, 4320978.61, 170.58},
       {289818.5, 4320980.59, 170.76}},
      {"PDAL+PDAL/test__data__pcd__utm17_space.pcd",
       10,
       {289814.15, 4320978.61, 170.58},
       {289818.5, 4320980.59, 170.76}},
      {"PDAL+PDAL/test__data__pcd__utm17_tab.pcd", 10, {289814.15, 4320978.61, 170.58}, {289818.5, 4320980.59, 170.76}},
      {"PDAL+PDAL/test__data__ply__issue_2421.ply",
       1,
       {1.23457, 12345.6789, 1234567890.12},
       {1.23457, 12345.6789, 1234567890.12}},
      {"PDAL+PDAL/test__data__ply__mesh.ply", 4, {1, 1, 0}, {2, 2, 2}},
      {"PDAL+PDAL/test__data__ply__simple_binary.ply", 3, {-1, 0, 0}, {1, 1, 0}},
      {"PDAL+PDAL/test__data__ply__simple_text.ply", 3, {-1, 0, 0}, {1, 1, 0}},
      {"PDAL+PDAL/test__data__ply__text_extradim.ply",
       1,
       {-2.64944, -13.0955, 0.00640115},
       {-2.64944, -13.0955, 0.00640115}},
      {"PDAL+PDAL/test__data__pts__autzen.pts",
       10,
       {636102.840012, 848968.800003, 427.919998},
       {636126.400009, 849345.199997, 512.139999}},
      {"PDAL+PDAL/test__data__pts__site_56_8.pts",
       8,
       {6691.250667, 17.347517, -14.709473},
       {6728.512429, 45.710979, 1203.033447}},
      {"PDAL+PDAL/test__data__pts__test.pts",
       19,
       {-25.050461, -24.533554, -2.000961},
       {3.980972, -2.006119, -0.010086}},
      {"PDAL+PDAL/test__data__ptx__1.2-with-color.ptx",
       1065,
       {635619.85, 848899.7, 406.59},
       {638982.55, 853535.43, 586.38}},
      {"PDAL+PDAL/test__data__ptx__complex-transform.ptx",
       4,
       {-0.00563, 0.645218, -0.441879},
       {-0.0056, 0.650467, -0.438828}},
      {"PDAL+PDAL/test__data__ptx__multiple-and-transform.ptx#1",
       4,
       {36699.38, 48991.01, 12.695},
       {37012.24, 49106.66, 23.195}},
      {"PDAL+PDAL/test__data__ptx__multiple-and-transform.ptx#2",
       4,
       {636699.38, 848991.01, 425.39},
       {637012.24, 849106.66, 446.39}},
      {"PDAL+PDAL/test__data__ptx__no-color.ptx", 15, {635795.24, 848991.01, 408.6}, {637012.24, 849390.78, 446.39}},
      {"asmaloney+libE57Format-test-data/3rdParty__las2e57__ColourRepresentation.e57",
       153,
       {-0.5, -0.5, -0.5},
       {0.5, 0.5, 0.5}},
      {"asmaloney+libE57Format-test-data/reference__bunnyDouble.e57",
       30571,
       {-0.094689, 0.040011, -0.061873},
       {0.061009, 0.187321, 0.058799}},
      {"asmaloney+libE57Format-test-data/reference__bunnyInt32.e57",
       30571,
       {-0.094689, 0.040011, -0.061873},
       {0.061009, 0.187321, 0.058799}},
      {"asmaloney+libE57Format-test-data/self__ColouredCubeDouble.e57", 7680, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}},
      {"asmaloney+libE57Format-test-data/self__ColouredCubeFloat.e57", 7680, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}},
      {"asmaloney+libE57Format-test-data/self__ZeroPoints.e57", 0},
      {"asmaloney+libE57Format-test-data/self__ZeroPointsInvalid.e57", 0},
      {"davidcaron+pye57/tests__test_data__pumpAVisualReferenceImage.e57",
       155201,
       {-2.903763, -5.301102, -1.899704},
       {1.721603, -0.792648, 1.843002}},
      {"davidcaron+pye57/tests__test_data__testWithNormals.e57", 2, {1, 0, 0}, {2, 0, 0}},
      {"davidcaron+pye57/tests__test_data__translationWithoutRotation.e57", 4, {0, 0, 0}, {1, 1, 0}},
      {"hobuinc+laz-perf/cpp__test__raw-sets__1815.las",
       1247,
       {2014000.41837, 6493002.07111, 87.9591827959},
       {2014999.69342, 6493999.93022, 124.074132796}},
      {"hobuinc+laz-perf/cpp__test__raw-sets__no-points-1.3.las", 0},
      {"hobuinc+laz-perf/cpp__test__raw-sets__point10-1.0.las", 1, {1, 2, 3}, {1, 2, 3}},
      {"laspy+laspy/tests__data__1_4_w_evlr.las",
       1000,
       {1694038.44564, 1816492.70627, 5592.74991747},
       {1694539.67701, 1816497.97626, 5599.06968675}},
      {"laspy+laspy/tests__data__autzen.las", 106, {635616.31, 848977.79, 407.35}, {638864.6, 853362.37, 536.84}},
      {"laspy+laspy/tests__data__extrabytes.las", 1065, {635619.85, 848899.7, 406.59}, {638982.55, 853535.43, 586.38}},
      {"laspy+laspy/tests__data__simple.las", 1065, {635619.85, 848899.7, 406.59}, {638982.55, 853535.43, 586.38}},
      {"laspy+laspy/tests__data__simple1_1.las", 1065, {635619.85, 848899.7, 406.59}, {638982.55, 853535.43, 586.38}},
      {"laspy+laspy/tests__data__simple1_3.las",
       999,
       {-235434.519, 5800843.145, 265.094},
       {-234935.841, 5800946.249, 273.811}},
      {"laspy+laspy/tests__data__simple1_4.las", 22600, {1, 1, 44}, {226, 100, 254}},
      {"laspy+laspy/tests__data__test1_4.las",
       1000,
       {1694038.44564, 1816492.70627, 5592.74991747},
       {1694539.67701, 1816497.97626, 5599.06968675}},
      {"laspy+laspy/tests__data__unregistered_extra_bytes.las", 4, {1, 1, 1}, {4, 4, 4}},
      {"laspy+laspy/tests__data__vegetation_1_3.las",
       10683,
       {-98451.205, -55975.417, -81460.091},
       {-98447.447, -55969.405, -81455.203}},
  };
  return files;
}

struct RefusedFile {
  std::string name;
  std::string reason;
};

const std::vector<RefusedFile>& files_that_are_refused() {
  static const std::vector<RefusedFile> files{
      {"PDAL+PDAL/test__data__las__garbage_nVariableLength.las", "promises 719 points, but has room for 718"},
      {"PDAL+PDAL/test__data__las__permutations__1.2-no-points.las", "promises 1065 points, but has room for 0"},
      {"PDAL+PDAL/test__data__pcd__missingheader.pcd", "which PCD does not know"},
      {"PDAL+PDAL/test__data__ply__no_vertex.ply", "without an element 'vertex'"},
      {"PDAL+PDAL/test__data__ply__sized_dims.ply", "no property 'z'"},
      {"PDAL+PDAL/test__data__ply__unsized_dims.ply", "no property 'z'"},
      {"PDAL+PDAL/test__data__pts__bunny_8.pts", "one point more"},
      {"asmaloney+libE57Format-test-data/self__InvalidCVHeader.e57", "the section at byte 48 is none of points"},
      {"asmaloney+libE57Format-test-data/self__PinholeImageWithDistortionParameters.e57", "holds no scan"},
      {"asmaloney+libE57Format-test-data/self__bad-crc.e57", "check sum of this page is wrong"},
      {"asmaloney+libE57Format-test-data/self__empty.e57", "holds no scan"},
  };
  return files;
}

class ForeignFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (formats_folder().empty()) GTEST_SKIP() << "there is no ../shared/formats with other programs' files";
  }

  static void expect_refusal(const fs::path& path, const std::string& reason) {
    const std::string message = test::error_of<InputError>([&] {
      for (const auto& scan : scans_in(path)) test::read_whole(scan);
    });
    EXPECT_NE(message.find(reason), std::string::npos) << path << ": " << message;
  }
};

TEST_F(ForeignFiles, AreReadAsAnotherReaderHasThem) {
  for (const ReadFile& expected : files_that_are_read()) {
    SCOPED_TRACE(expected.name);
    const test::WholeScan scan = test::read_whole(formats_folder() / expected.name);
    ASSERT_EQ(scan.block.size(), expected.num_points);
    if (expected.num_points == 0) continue;
    Eigen::AlignedBox3d box;
    for (const auto& point : scan.block.points) box.extend(point);
    EXPECT_LE((box.min() - expected.min).norm(), 1e-9 * (1 + expected.min.norm())) << box.min().transpose();
    EXPECT_LE((box.max() - expected.max).norm(), 1e-9 * (1 + expected.max.norm())) << box.max().transpose();
  }
}

TEST_F(ForeignFiles, AreRefusedForTheRightReason) {
  for (const RefusedFile& expected : files_that_are_refused()) {
    expect_refusal(formats_folder() / expected.name, expected.reason);
  }
}

TEST_F(ForeignFiles, CompressedLasIsRefused) {
  int num_refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(formats_folder())) {
    if (entry.path().extension() != ".laz") continue;
    const bool is_copc = entry.path().filename().string().find(".copc.") != std::string::npos;
    expect_refusal(entry.path(), is_copc ? "is compressed (COPC)" : "is compressed (LAZ)");
    ++num_refused;
  }
  EXPECT_GE(num_refused, 17);
}

// No file is left out: the tables above name each, or it is LAZ.
TEST_F(ForeignFiles, AllAreInOneOfTheTables) {
  std::set<std::string> known;
  for (const auto& f : files_that_are_read())
    known.insert(std::string(f.name).substr(0, std::string(f.name).find('#')));
  for (const auto& f : files_that_are_refused()) known.insert(f.name);
  for (const auto& entry : fs::recursive_directory_iterator(formats_folder())) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || extension == ".laz" || extension == ".md") continue;
    EXPECT_TRUE(known.contains(fs::relative(entry.path(), formats_folder()).generic_string())) << entry.path();
  }
}

TEST_F(ForeignFiles, CoordinateSystemsOfLasAreTold) {
  const fs::path folder = formats_folder() / "PDAL+PDAL";
  EXPECT_EQ(ScanReader(folder / "test__data__las__utm17.las").coordinate_system(), "EPSG:32617");
  EXPECT_EQ(ScanReader(folder / "test__data__las__wontcompress3.las").coordinate_system().substr(0, 29),
            "PROJCS[\"NAD83 / UTM zone 19N\"");
}

TEST_F(ForeignFiles, SeveralScansInAFileAndTheirPosesAreTold) {
  EXPECT_EQ(scans_in(formats_folder() / "PDAL+PDAL/test__data__ptx__multiple-and-transform.ptx").size(), 2u);
  EXPECT_EQ(scans_in(formats_folder() / "PDAL+PDAL/test__data__e57__A_B.e57").size(), 2u);
  const ScanReader moved(formats_folder() / "davidcaron+pye57/tests__test_data__translationWithoutRotation.e57");
  EXPECT_EQ(moved.header_pose().value().translation(), Eigen::Vector3d(4, 5, 6));
}

}  // namespace
}  // namespace tcm_icp
