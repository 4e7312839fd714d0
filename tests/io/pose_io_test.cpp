#include "tcm_icp/io/pose_io.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using test::error_of;
using test::read_text;
using test::TempFolder;

Eigen::Isometry3d motion(double scale) {
  Twist twist;
  twist << 0.7 * scale, -1.1, 0.4, 500000.123456789, -4999999.987654321 * scale, 1.0 / 3;
  return isometry_from_twist(twist);
}

PoseFile some_poses() {
  PoseFile poses{"b \"1\".ply", {}};
  poses.scans.push_back({"a.ply", ScanStatus::kRegistered, motion(1), {}, 0, Verdict::kAccepted, "two links agree"});
  poses.scans.push_back(
      {"b \"1\".ply", ScanStatus::kReference, Eigen::Isometry3d::Identity(), {}, 0, Verdict::kAccepted, ""});
  poses.scans.push_back({"c\u00fc.ply", ScanStatus::kUnregistered, Eigen::Isometry3d::Identity(), motion(0.5), 1,
                         Verdict::kRejected, "back\\slash"});
  return poses;
}

/// A document with one entry for a.ply that has this pose.
std::string with_pose(const std::string& pose) { return R"({"scans": [{"file": "a.ply", "pose": )" + pose + "}]}"; }

TEST(PoseIo, APoseFileComesBackBitForBit) {
  const TempFolder folder;
  const auto path = folder.path() / "poses.json";
  const PoseFile written = some_poses();
  write_pose_file(path, written);
  const PoseFile read = read_pose_file(path);
  EXPECT_EQ(read.reference, written.reference);
  ASSERT_EQ(read.scans.size(), written.scans.size());
  for (std::size_t i = 0; i < read.scans.size(); ++i) {
    const ScanPose &a = read.scans[i], &b = written.scans[i];
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.T_reference_scan.matrix(), b.T_reference_scan.matrix());
    ASSERT_EQ(a.pose_in_component.has_value(), b.pose_in_component.has_value());
    if (a.pose_in_component) {
      EXPECT_EQ(a.pose_in_component->matrix(), b.pose_in_component->matrix());
    }
    EXPECT_EQ(a.component, b.component);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.reason, b.reason);
  }
}

TEST(PoseIo, TheFileKeepsTheContract) {
  const TempFolder folder;
  const auto path = folder.path() / "poses.json";
  write_pose_file(path, some_poses());
  const std::string text = read_text(path);
  EXPECT_EQ(text.find("{\"schema\": 1, \"reference\": \"b \\\"1\\\".ply\","), 0u);
  EXPECT_NE(text.find("\"status\": \"unregistered\",\n   \"pose\": null"), std::string::npos);
  EXPECT_NE(text.find("500000.12345678901"), std::string::npos);  // 17 significant digits
  EXPECT_EQ(text.find("nan"), std::string::npos);
  write_pose_file(path, {"", {}});
  EXPECT_TRUE(read_pose_file(path).scans.empty());
}

TEST(PoseIo, APoseThatIsNotRigidIsNotWritten) {
  const TempFolder folder;
  PoseFile poses = some_poses();
  poses.scans[0].T_reference_scan.linear() *= 1 + 1e-8;
  EXPECT_THROW(write_pose_file(folder.path() / "a.json", poses), InvalidInput);
  poses = some_poses();
  poses.scans[2].pose_in_component->linear()(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_pose_file(folder.path() / "a.json", poses), InvalidInput);
}

TEST(PoseIo, AFileThatCannotBeWrittenIsAnError) {
  const TempFolder folder;
  EXPECT_THROW(write_pose_file(folder.path() / "none" / "a.json", some_poses()), OutputError);
  EXPECT_THROW(write_transform(folder.path(), motion(1)), OutputError);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(write_pose_file("/dev/full", some_poses()), OutputError);
  }
}

TEST(PoseIo, InitialPosesComeInTheOrderOfTheScans) {
  const TempFolder folder;
  const auto own = folder.path() / "poses.json";
  write_pose_file(own, some_poses());
  const auto poses = read_initial_poses(own, {"d.ply", "c\u00fc.ply", "b \"1\".ply", "a.ply"});
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_FALSE(poses[0]);
  EXPECT_FALSE(poses[1]);
  ASSERT_TRUE(poses[2] && poses[3]);
  EXPECT_EQ(poses[2]->matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(poses[3]->matrix(), motion(1).matrix());
}

TEST(PoseIo, TruthFilesAreTakenAndOtherFieldsIgnored) {
  const TempFolder folder;
  const auto path = folder.write(
      "truth.json",
      R"({"tolerance": {"rmse_m": 1}, "scans": [{"file": "a.ply", "points": 7, "pose": [[0,-1,0,5],[1,0,0,6],[0,0,1,7.5],[0,0,0,1]]}, {"file": "b.ply"}]})");
  const auto poses = read_initial_poses(path, {"a.ply", "b.ply"});
  ASSERT_TRUE(poses[0]);
  EXPECT_EQ(*poses[0] * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(5, 7, 7.5));
  EXPECT_FALSE(poses[1]);
}

TEST(PoseIo, ARoundedRotationIsProjected) {
  const TempFolder folder;
  const auto path = folder.write("a.json", with_pose("[[0.8776,-0.4794,0,5],[0.4794,0.8776,0,6],[0,0,1,7],[0,0,0,1]]"));
  const auto poses = read_initial_poses(path, {"a.ply"});
  ASSERT_TRUE(poses[0]);
  EXPECT_TRUE(is_rigid(poses[0]->matrix(), 1e-9));
  EXPECT_NEAR(poses[0]->linear()(0, 0), std::cos(0.5), 1e-4);  // four digits were given
  EXPECT_EQ(poses[0]->translation(), Eigen::Vector3d(5, 6, 7));
}

TEST(PoseIo, WhatIsWrongIsNamedWithItsPlace) {
  const TempFolder folder;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "is not JSON"},
      {"{\"scans\": [\n  nonsense]}", "byte 16: is not JSON"},
      {"{\"scans\": [1e999]}", "beyond the range of double"},
      {std::string(100000, '['), "is not JSON"},
      {"[]", "has no list 'scans'"},
      {"{\"scans\": 7}", "has no list 'scans'"},
      {"{\"scans\": [{\"pose\": null}]}", "scans[0]: has no text 'file'"},
      {"{\"scans\": [7]}", "scans[0]: has no text 'file'"},
      {with_pose("7"), "scans[0].pose: the pose is not 4 x 4 numbers"},
      {with_pose("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]"), "the pose is not 4 x 4 numbers"},
      {with_pose("[[1,0,0,0],[0,1,0,0],[0,0,1],[0,0,0,1]]"), "the pose is not 4 x 4 numbers"},
      {with_pose("[[1,0,0,0],[0,1,0,\"7\"],[0,0,1,0],[0,0,0,1]]"), "the pose is not 4 x 4 numbers"},
      {with_pose("[[1,0,0,0],[0,1,0,null],[0,0,1,0],[0,0,0,1]]"), "the pose is not 4 x 4 numbers"},
      {with_pose("[[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]"), "the pose is not a rigid motion"},
      {with_pose("[[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]"), "the pose is not a rigid motion"},
      {with_pose("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[1,0,0,1]]"), "the pose is not a rigid motion"},
      {R"({"scans": [{"file": "a.ply"}, {"file": "x.ply"}]})", "scans[1]: names 'x.ply', which is not among the scans"},
      {R"({"scans": [{"file": "a.ply"}, {"file": "a.ply"}]})", "scans[1]: is the second entry for 'a.ply'"},
  };
  for (const auto& [content, expected] : cases) {
    const auto path = folder.write("broken.json", content);
    const std::string message = error_of<InputError>([&] { read_initial_poses(path, {"a.ply"}); });
    EXPECT_NE(message.find(expected), std::string::npos) << "message: " << message << "\nexpected: " << expected;
    EXPECT_EQ(message.find(path.string()), 0u) << message;
  }
  EXPECT_THROW(read_initial_poses(folder.path() / "none.json", {}), InputError);
  EXPECT_THROW(read_initial_poses(folder.path(), {}), InputError);
}

TEST(PoseIo, APoseFileIsReadStrictly) {
  const TempFolder folder;
  const std::string pose = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
  const std::string rest = R"(, "component": 0, "verdict": "accepted", "reason": ""}]})";
  const std::string start = R"({"schema": 1, "reference": "a.ply", "scans": [{"file": "a.ply", )";
  ASSERT_NO_THROW(
      read_pose_file(folder.write("a.json", start + "\"status\": \"reference\", \"pose\": " + pose + rest)));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"schema": 2, "reference": "a.ply", "scans": []})", "is not of schema 1"},
      {R"({"reference": "a.ply", "scans": []})", "has no usable 'schema'"},
      {R"({"schema": 1e49, "reference": "a.ply", "scans": []})", "has no usable 'schema'"},
      {R"({"schema": 4294967297, "reference": "a.ply", "scans": []})", "has no usable 'schema'"},
      {R"({"schema": 18446744073709551615, "reference": "a.ply", "scans": []})", "has no usable 'schema'"},
      {R"({"schema": 1, "scans": []})", "has no usable 'reference'"},
      {start + "\"pose\": " + pose + rest, "scans[0]: has no usable 'status'"},
      {start + "\"status\": \"reference\", \"pose\": " + pose +
           R"(, "component": 0, "verdict": "fine", "reason": ""}]})",
       "scans[0]: has the unknown verdict 'fine'"},
      {start + "\"status\": \"lost\", \"pose\": " + pose + rest, "scans[0]: has the unknown status 'lost'"},
      {start + "\"status\": \"registered\", \"pose\": null" + rest, "has no pose, but is not unregistered"},
      {start + "\"status\": \"unregistered\", \"pose\": " + pose + rest, "is unregistered, but has a pose"},
      {start + "\"status\": \"reference\", \"pose\": " + pose + "}]}", "has no usable 'component'"},
  };
  for (const auto& [content, expected] : cases) {
    const auto path = folder.write("broken.json", content);
    const std::string message = error_of<InputError>([&] { read_pose_file(path); });
    EXPECT_NE(message.find(expected), std::string::npos) << "message: " << message << "\nexpected: " << expected;
  }
}

TEST(PoseIo, WithoutAVerdictAPoseIsTaken) {
  const TempFolder folder;
  const auto path = folder.write(
      "a.json",
      R"({"schema": 1, "reference": "a.ply", "scans": [{"file": "a.ply", "status": "reference", )"
      R"("pose": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "component": 0, "verdict": "", "reason": ""}, )"
      R"({"file": "b.ply", "status": "unregistered", "pose": null, "component": 1, "verdict": "", "reason": ""}]})");
  const PoseFile poses = read_pose_file(path);
  ASSERT_EQ(poses.scans.size(), 2u);
  EXPECT_EQ(poses.scans[0].verdict, Verdict::kAccepted);
  EXPECT_EQ(poses.scans[1].verdict, Verdict::kRejected);
}

TEST(PoseIo, ATransformIsFourLinesOfFullPrecision) {
  const TempFolder folder;
  const auto path = folder.path() / "a.txt";
  const Eigen::Isometry3d T = motion(1);
  write_transform(path, T);
  std::istringstream text(read_text(path));
  std::string line;
  for (int row = 0; row < 4; ++row) {
    ASSERT_TRUE(std::getline(text, line));
    std::istringstream numbers(line);
    for (int column = 0; column < 4; ++column) {
      double value = 0;
      ASSERT_TRUE(numbers >> value);
      EXPECT_EQ(value, T.matrix()(row, column));
    }
    EXPECT_TRUE((numbers >> std::ws).eof());
  }
  EXPECT_FALSE(std::getline(text, line));
}

TEST(PoseIo, TheFrameAndItsCoordinateSystemComeBack) {
  const test::TempFolder folder;
  const auto path = folder.path() / "poses.json";
  PoseFile written = some_poses();
  write_pose_file(path, written);
  EXPECT_EQ(test::read_text(path).find("frame"), std::string::npos);
  written.frame = "control points";
  written.crs = "PROJCS[\"somewhere\"]";
  write_pose_file(path, written);
  EXPECT_EQ(read_pose_file(path).frame, written.frame);
  EXPECT_EQ(read_pose_file(path).crs, written.crs);
}

TEST(PoseIo, InitialPosesMayHaveStandardDeviations) {
  const test::TempFolder folder;
  const std::string pose = "\"pose\": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]";
  const auto read = [&](const std::string& fields) {
    const auto path = folder.write("init.json", "{\"scans\": [{\"file\": \"a.ply\"" + fields + "}]}");
    return read_initial_sigmas(path, {"b.ply", "a.ply"});
  };
  const auto sigmas = read(", \"sigma_position_m\": 0.5, \"sigma_rotation_deg\": 90, " + pose);
  EXPECT_FALSE(sigmas[0].has_value());
  EXPECT_EQ(sigmas[1]->position_m, 0.5);
  EXPECT_NEAR(sigmas[1]->rotation_rad, std::acos(0.0), 1e-15);
  EXPECT_FALSE(read(", " + pose)[1].has_value());
  EXPECT_THROW(read(", \"sigma_position_m\": 0.5, " + pose), InputError);
  EXPECT_THROW(read(", \"sigma_position_m\": 0, \"sigma_rotation_deg\": 1, " + pose), InputError);
  EXPECT_THROW(read(", \"sigma_position_m\": \"1\", \"sigma_rotation_deg\": 1, " + pose), InputError);
  EXPECT_THROW(read(", \"sigma_position_m\": 1, \"sigma_rotation_deg\": 1"), InputError);
}

}  // namespace
}  // namespace tcm_icp
