#include "tcm_icp/survey/control_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {
namespace {

class ControlFile : public ::testing::Test {
 protected:
  std::vector<ControlPoint> read(const std::string& text) const {
    return read_control_file(folder_.write("control.csv", text), scans_);
  }
  void expect_refusal(const std::string& text, const std::vector<std::string>& parts) const {
    try {
      read(text);
      FAIL() << text;
    } catch (const InputError& e) {
      for (const auto& part : parts) EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }
  test::TempFolder folder_;
  std::vector<std::filesystem::path> scans_{"town/a.ply", "town/b.ply"};
};

TEST_F(ControlFile, KeepsEveryDigitOfProjectedCoordinates) {
  const auto points = read(
      "# targets of May\n"
      "name,scan,x,y,z,X,Y,Z,sigma,sigma_scan,use\n"
      "T1,a.ply,1.25,-2,3e1,500000.123456789,5400000.987654321,312.5,0.003,0.002,control\n"
      "\n"
      "\"T,2\",*,0,0,0,500010,5400010,300,0.005,,check\r\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].name, "T1");
  EXPECT_EQ(points[0].scan, "a.ply");
  EXPECT_EQ(points[0].measured, Eigen::Vector3d(1.25, -2, 30));
  EXPECT_EQ(points[0].given, Eigen::Vector3d(500000.123456789, 5400000.987654321, 312.5));
  EXPECT_EQ(points[0].sigma_given_m, Eigen::Vector3d::Constant(0.003));
  EXPECT_EQ(points[0].sigma_measured_m, Eigen::Vector3d::Constant(0.002));
  EXPECT_EQ(points[0].use, PointUse::kControl);
  EXPECT_EQ(points[1].name, "T,2");
  EXPECT_EQ(points[1].scan, "");
  EXPECT_EQ(points[1].use, PointUse::kCheck);
  // One standard deviation for both: half of its variance each.
  EXPECT_NEAR(points[1].sigma_given_m.x(), 0.005 / std::sqrt(2), 1e-15);
  EXPECT_NEAR(points[1].sigma_measured_m.z(), 0.005 / std::sqrt(2), 1e-15);
}

TEST_F(ControlFile, ColumnsMayStandInAnyOrderAndHaveSurveyorsNames) {
  const auto points =
      read("E;N;H;sigma_E;sigma_N;sigma_H;sigma_scan;scan;name;x;y;z\n1;2;3;.01;.02;.03;0;b.ply;P;4;5;6\n");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].given, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(points[0].measured, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(points[0].sigma_given_m, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(points[0].scan, "b.ply");
}

TEST_F(ControlFile, MeasuredCoordinatesAreInTheUnitOfTheirScan) {
  scans_[1] = with_unit(scans_[1], LengthUnit::kFoot);
  const auto points = read("name,scan,x,y,z,X,Y,Z,sigma\nP,b.ply,10,0,0,10,0,0,.01\n");
  EXPECT_NEAR(points[0].measured.x(), 3.048, 1e-12);
  EXPECT_EQ(points[0].given.x(), 10);
}

TEST_F(ControlFile, RefusesWithLineAndRemedy) {
  const std::string names = "name,scan,x,y,z,X,Y,Z,sigma\n";
  expect_refusal("", {"control.csv", "no line of names"});
  expect_refusal(names, {"holds no point"});
  expect_refusal("name,scan,x,y,z,X,Y,Z\nP,a.ply,1,2,3,4,5,6\n", {"no column 'sigma'", "docs/formats.md"});
  expect_refusal("name,scan,x,y,z,X,Y,sigma\n", {"no column 'Z'"});
  expect_refusal("name,name,scan,x,y,z,X,Y,Z,sigma\n", {"line 1", "'name' twice"});
  expect_refusal(names + "P,a.ply,1,2,3,4,5,6\n", {"line 2", "8 values, not the 9", "','"});
  expect_refusal(names + "P,a.ply,1,2,3 m,4,5,6,.01\n", {"line 2", "'3 m'", "column z", "without a unit"});
  expect_refusal(names + "P,a.ply,1,2,nan,4,5,6,.01\n", {"line 2", "no number"});
  expect_refusal(names + "P,c.ply,1,2,3,4,5,6,.01\n", {"line 2", "'c.ply'", "a.ply", "*"});
  expect_refusal(names + "P,a.ply,1,2,3,4,5,6,0\n", {"line 2", "standard deviation", "0.003"});
  expect_refusal(names + "P,a.ply,1,2,3,4,5,6,.01\nP,a.ply,1,2,3,4,5,6,.01\n", {"line 3", "second time"});
  expect_refusal(names + "P,a.ply,1,2,3,4,5,6,.01\nP,b.ply,1,2,3,4,5,7,.01\n", {"line 3", "another place"});
  expect_refusal("name,scan,x,y,z,X,Y,Z,sigma,use\nP,a.ply,1,2,3,4,5,6,.01,maybe\n", {"'maybe'", "control or check"});
  expect_refusal(names + "\"P,a.ply,1,2,3,4,5,6,.01\n", {"line 2", "quote"});
}

TEST_F(ControlFile, PositionsOfScannersAreOriginsUnlessTold) {
  const auto positions = [&](const std::string& text) {
    return read_scanner_positions(folder_.write("gnss.csv", text), scans_);
  };
  const auto plain = positions("scan,X,Y,Z,sigma\nb.ply,500000,5400000,300,0.5\n");
  ASSERT_EQ(plain.size(), 1U);
  EXPECT_EQ(plain[0].scan, "b.ply");
  EXPECT_EQ(plain[0].measured, Eigen::Vector3d::Zero());
  EXPECT_EQ(plain[0].sigma_given_m, Eigen::Vector3d::Constant(0.5));
  EXPECT_TRUE(plain[0].is_scanner);
  const auto told = positions("scan,X,Y,Z,sigma,x,y,z\nb.ply,500000,5400000,300,0.5,0,0,1.8\n");
  EXPECT_EQ(told[0].measured, Eigen::Vector3d(0, 0, 1.8));
  EXPECT_THROW(positions("scan,X,Y,Z,sigma\nb.ply,1,2,3,.5\nb.ply,1,2,3,.5\n"), InputError);
  EXPECT_THROW(positions("scan,X,Y,Z,sigma\n*,1,2,3,.5\n"), InputError);
}

}  // namespace
}  // namespace tcm_icp
