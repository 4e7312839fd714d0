#include "tcm_icp/io/pose_export.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using test::read_text;
using test::TempFolder;

ScanPose pose_of(const std::string& file, ScanStatus status, const Twist& twist = Twist::Zero()) {
  ScanPose pose;
  pose.file = file;
  pose.status = status;
  pose.T_reference_scan = isometry_from_twist(twist);
  return pose;
}

/// The second is unregistered, the third far away and turned by more than half a turn.
std::vector<ScanPose> three_poses() {
  Twist near_by, far_away;
  near_by << 0.3, -1.1, 2.0, 1, -2, 3;
  far_away << -2.5, 1.9, 0.4, 5e5, 5e6, 100.125;
  return {pose_of("a.ply", ScanStatus::kRegistered, near_by), pose_of("b, \"c\".ply", ScanStatus::kUnregistered),
          pose_of("d.ply", ScanStatus::kReference, far_away)};
}

std::vector<double> numbers_of(const std::string& line, char separator = ' ') {
  std::vector<double> numbers;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, separator);) numbers.push_back(std::stod(word));
  return numbers;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// From x y z qx qy qz qw, by the formula of a rotation matrix and not by Eigen's conversion.
Eigen::Matrix4d matrix_of(const std::vector<double>& v) {
  const double x = v[3], y = v[4], z = v[5], w = v[6];
  Eigen::Matrix4d m;
  m << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), v[0],  //
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), v[1],   //
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), v[2],   //
      0, 0, 0, 1;
  return m;
}

constexpr double kRounding = 1e-14;  // of a product of doubles; positions are written as they are

void expect_same_pose(const std::vector<double>& numbers, const Eigen::Isometry3d& T) {
  ASSERT_EQ(numbers.size(), 7u);
  EXPECT_GE(numbers[6], 0);
  const Eigen::Matrix4d m = matrix_of(numbers);
  EXPECT_LT((m.topLeftCorner<3, 3>() - T.linear()).norm(), kRounding);
  EXPECT_EQ(Eigen::Vector3d(m.col(3).head<3>()), Eigen::Vector3d(T.translation()));
}

TEST(PoseExport, TumHasARegisteredScanALineWithItsNumberInPlaceOfTheTime) {
  const auto poses = three_poses();
  const auto lines = lines_of(poses_as_tum(poses));
  ASSERT_EQ(lines.size(), 2u);
  for (const std::size_t k : {0U, 1U}) {
    auto numbers = numbers_of(lines[k]);
    EXPECT_EQ(numbers.at(0), 2.0 * static_cast<double>(k));
    numbers.erase(numbers.begin());
    expect_same_pose(numbers, poses[2 * k].T_reference_scan);
  }
}

TEST(PoseExport, KittiHasTheUpperRowsOfTheMatrixBitForBit) {
  const auto poses = three_poses();
  const auto lines = lines_of(poses_as_kitti(poses));
  ASSERT_EQ(lines.size(), 2u);
  const auto numbers = numbers_of(lines[1]);
  ASSERT_EQ(numbers.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(numbers[static_cast<std::size_t>(i)], poses[2].T_reference_scan.matrix()(i / 4, i % 4)) << i;
  }
}

TEST(PoseExport, CsvHasEveryScanAndLeavesEmptyWhatAnUnregisteredOneDoesNotHave) {
  const auto poses = three_poses();
  const auto lines = lines_of(poses_as_csv(poses));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "scan,file,status,component,x,y,z,qx,qy,qz,qw");
  EXPECT_EQ(lines[2], "1,\"b, \"\"c\"\".ply\",unregistered,0,,,,,,,");
  ASSERT_TRUE(lines[3].starts_with("2,d.ply,reference,0,"));
  expect_same_pose(numbers_of(lines[3].substr(20), ','), poses[2].T_reference_scan);
}

TEST(PoseExport, G2oHasVerticesByNumberAndEdgesWithTheRelativePose) {
  const auto poses = three_poses();
  PoseGraphEdge edge{0, 2};
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) edge.information(i, k) = 10 * std::min(i, k) + std::max(i, k);
  }
  const auto lines = lines_of(poses_as_g2o(poses, {edge}));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[0].starts_with("VERTEX_SE3:QUAT 0 "));
  ASSERT_TRUE(lines[1].starts_with("VERTEX_SE3:QUAT 2 "));
  expect_same_pose(numbers_of(lines[1].substr(18)), poses[2].T_reference_scan);
  ASSERT_TRUE(lines[2].starts_with("EDGE_SE3:QUAT 0 2 "));
  const auto numbers = numbers_of(lines[2].substr(18));
  ASSERT_EQ(numbers.size(), 7u + 21u);
  const Eigen::Matrix4d relative = matrix_of({numbers.begin(), numbers.begin() + 7});
  const Eigen::Matrix4d reached = poses[0].T_reference_scan.matrix() * relative;
  EXPECT_LT((reached - poses[2].T_reference_scan.matrix()).norm(), 1e-8);  // of 5,000 km
  const std::vector<double> upper{0, 1, 2, 3, 4, 5, 11, 12, 13, 14, 15, 22, 23, 24, 25, 33, 34, 35, 44, 45, 55};
  EXPECT_EQ(std::vector<double>(numbers.begin() + 7, numbers.end()), upper);
}

TEST(PoseExport, AnEdgeToAScanWithoutAPoseIsRefused) {
  EXPECT_THROW(poses_as_g2o(three_poses(), {{0, 1}}), InvalidInput);
}

TEST(PoseExport, WithoutRegisteredScansThereAreNoLines) {
  const std::vector<ScanPose> none{pose_of("a", ScanStatus::kUnregistered), pose_of("b", ScanStatus::kUnregistered)};
  EXPECT_EQ(poses_as_tum(none), "");
  EXPECT_EQ(poses_as_kitti(none), "");
  EXPECT_EQ(poses_as_g2o(none, {}), "");
  EXPECT_EQ(lines_of(poses_as_csv(none)).size(), 3u);
}

TEST(PoseExport, WritesAFileForEachFormat) {
  const TempFolder folder;
  const auto poses = three_poses();
  write_pose_exports(folder.path(), poses, {{0, 2}});
  EXPECT_EQ(read_text(folder.path() / "poses.csv"), poses_as_csv(poses));
  EXPECT_EQ(read_text(folder.path() / "tum.txt"), poses_as_tum(poses));
  EXPECT_EQ(read_text(folder.path() / "kitti.txt"), poses_as_kitti(poses));
  EXPECT_EQ(read_text(folder.path() / "graph.g2o"), poses_as_g2o(poses, {{0, 2}}));
  EXPECT_THROW(write_pose_exports(folder.path() / "none", poses, {}), OutputError);
}

}  // namespace
}  // namespace tcm_icp
