#pragma once
// Poses in files: poses.json, initial poses, single transforms (docs/formats.md).

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tcm_icp/core/verdict.hpp"

namespace tcm_icp {

struct ScanPose {
  std::string file;  ///< name of the scan, as scan_names() has it
  ScanStatus status = ScanStatus::kUnregistered;
  Eigen::Isometry3d T_reference_scan = Eigen::Isometry3d::Identity();  ///< [m] for raw coordinates; unless unregistered
  std::optional<Eigen::Isometry3d> pose_in_component;  ///< for scans that hold together, but not with the reference
  int component = 0;
  Verdict verdict = Verdict::kRejected;
  std::string reason;      ///< for a person
  std::string unit = "m";  ///< of the coordinates in the file; poses are for these in metres
};

/// poses.json, schema 1.
struct PoseFile {
  std::string reference;  ///< file of the reference scan
  std::vector<ScanPose> scans;
  std::string frame = {};  ///< what defines the common frame; empty: the reference scan
  std::string crs = {};    ///< coordinate system of that frame, EPSG:n or well-known text; empty: not known
};

/// Numbers have 17 significant digits: reading gives the same bits. `pose` is null where a scan is unregistered. Bytes
/// of a file name that are not UTF-8 become U+FFFD, since JSON knows nothing else.
/// @throws InvalidInput  if a pose is not rigid to 1e-9, or not finite
/// @throws OutputError   if the file cannot be written
void write_pose_file(const std::filesystem::path& path, const PoseFile& poses);

/// @throws InputError  naming file and place: not JSON, not schema 1, a field missing or of the wrong kind, an unknown
///                     status, a pose that is missing or not rigid, two entries for one scan
PoseFile read_pose_file(const std::filesystem::path& path);

/// Initial poses for the scans `files` (names as scan_names() has them), from a poses.json or a truth.json: `{"scans":
/// [{"file": "a.ply", "pose": [[4x4]]}]}`. A scan without an entry, or with `"pose": null`, stays nullopt. A pose that
/// is rigid to 1e-3 only has its rotation projected onto SO(3); its translation is taken as it is.
/// @throws InputError  naming file and place: what read_pose_file() finds, and an entry for a scan that is not in
/// `files`
std::vector<std::optional<Eigen::Isometry3d>> read_initial_poses(const std::filesystem::path& path,
                                                                 const std::vector<std::string>& files);

/// How well an initial pose is known.
struct PoseSigmas {
  double position_m = 0, rotation_rad = 0;  ///< > 0
};

/// Of the same entries: fields "sigma_position_m" and "sigma_rotation_deg". nullopt where a scan has neither.
/// @throws InputError  where an entry has one of the two, is not above 0, or has no pose
std::vector<std::optional<PoseSigmas>> read_initial_sigmas(const std::filesystem::path& path,
                                                           const std::vector<std::string>& files);

/// The 4 x 4 matrix as four lines of text, 17 significant digits: what CloudCompare's "Apply transformation" reads.
/// @throws OutputError  if the file cannot be written
void write_transform(const std::filesystem::path& path, const Eigen::Isometry3d& T);

}  // namespace tcm_icp
