#include "tcm_icp/io/pose_io.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "number_text.hpp"
#include "pose_json.hpp"
#include "scan_status.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "text_file.hpp"

namespace tcm_icp {
namespace {

/// The numbers of one row of a matrix.
std::string row_text(const Eigen::Isometry3d& T, int row, std::string_view separator) {
  std::string text;
  for (int column = 0; column < 4; ++column) {
    if (column > 0) text += separator;
    text += digits17(T.matrix()(row, column));
  }
  return text;
}

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A matrix on one line of JSON.
std::string json_matrix(const Eigen::Isometry3d& T, const std::string& file) {
  if (!is_rigid(T.matrix(), 1e-9)) throw InvalidInput("the pose of '" + file + "' is not rigid to 1e-9");
  std::string text;
  for (int row = 0; row < 4; ++row) {
    text += row == 0 ? "[[" : ", [";
    text += row_text(T, row, ", ") + "]";
  }
  return text + "]";
}

std::string json_scan(const ScanPose& scan) {
  const bool placed = scan.status != ScanStatus::kUnregistered;
  std::string text = "  {\"file\": " + json_string(scan.file) +
                     ", \"status\": " + json_string(std::string(to_string(scan.status))) +
                     ",\n   \"pose\": " + (placed ? json_matrix(scan.T_reference_scan, scan.file) : "null") + ",\n";
  if (scan.pose_in_component) {
    text += "   \"pose_in_component\": " + json_matrix(*scan.pose_in_component, scan.file) + ",\n";
  }
  return text + "   \"component\": " + std::to_string(scan.component) +
         ", \"verdict\": " + json_string(std::string(to_string(scan.verdict))) +
         ", \"reason\": " + json_string(scan.reason) +
         (scan.unit == "m" ? "" : ", \"unit\": " + json_string(scan.unit)) + "}";
}

/// Nothing where there is no such text.
std::string optional_field(std::string_view name, std::string_view text) {
  return text.empty() ? "" : "\n " + json_string(name) + ": " + json_string(text) + ",";
}

/// A field of an entry, of the kind of T; InputError where it is missing or of another kind.
template <typename T>
T field_of(const nlohmann::json& entry, const char* key, const std::filesystem::path& path, const std::string& place) {
  try {
    return entry.at(key).get<T>();
  } catch (const nlohmann::json::exception&) {
    throw InputError(path, place, std::string("has no usable '") + key + "'", "give a poses.json that tcm-icp wrote");
  }
}

int whole_number(const nlohmann::json& entry, const char* key, const std::filesystem::path& path,
                 const std::string& place) {
  if (const auto number = whole_number_of(field_of<nlohmann::json>(entry, key, path, place))) return *number;
  throw InputError(path, place, std::string("has no usable '") + key + "'", "give a poses.json that tcm-icp wrote");
}

ScanPose read_scan(const nlohmann::json& entry, const std::filesystem::path& path, const std::string& place) {
  ScanPose scan;
  scan.file = field_of<std::string>(entry, "file", path, place);
  const auto status_name = field_of<std::string>(entry, "status", path, place);
  const auto status = status_from_name(status_name);
  if (!status) {
    throw InputError(path, place, "has the unknown status '" + status_name + "'",
                     "reference, registered and unregistered are known");
  }
  scan.status = *status;
  const auto pose = pose_of(entry, "pose", path, place);
  if (pose.has_value() != (scan.status != ScanStatus::kUnregistered)) {
    throw InputError(path, place, pose ? "is unregistered, but has a pose" : "has no pose, but is not unregistered",
                     "give a poses.json that tcm-icp wrote");
  }
  if (pose) scan.T_reference_scan = *pose;
  scan.pose_in_component = pose_of(entry, "pose_in_component", path, place);
  scan.component = whole_number(entry, "component", path, place);
  const auto verdict_name = field_of<std::string>(entry, "verdict", path, place);
  // Poses of other programs say no more than that they are there.
  const auto verdict = !verdict_name.empty()                      ? verdict_from_name(verdict_name)
                       : scan.status == ScanStatus::kUnregistered ? Verdict::kRejected
                                                                  : Verdict::kAccepted;
  if (!verdict) {
    throw InputError(path, place, "has the unknown verdict '" + verdict_name + "'",
                     "accepted, doubtful and rejected are known");
  }
  scan.verdict = *verdict;
  scan.reason = field_of<std::string>(entry, "reason", path, place);
  if (entry.contains("unit")) scan.unit = field_of<std::string>(entry, "unit", path, place);
  return scan;
}

}  // namespace

void write_pose_file(const std::filesystem::path& path, const PoseFile& poses) {
  std::string text = "{\"schema\": 1, \"reference\": " + json_string(poses.reference) + "," +
                     optional_field("frame", poses.frame) + optional_field("crs", poses.crs) + "\n \"scans\": [";
  for (std::size_t i = 0; i < poses.scans.size(); ++i) text += (i == 0 ? "\n" : ",\n") + json_scan(poses.scans[i]);
  write_text_file(path, text + "\n ]}\n");
}

PoseFile read_pose_file(const std::filesystem::path& path) {
  const nlohmann::json document = read_json_file(path);
  const auto& scans = scans_of(document, path);
  if (whole_number(document, "schema", path, "") != 1) {
    throw InputError(path, "", "is not of schema 1", "read it with the version of tcm-icp that wrote it");
  }
  PoseFile poses;
  poses.reference = field_of<std::string>(document, "reference", path, "");
  if (document.contains("frame")) poses.frame = field_of<std::string>(document, "frame", path, "");
  if (document.contains("crs")) poses.crs = field_of<std::string>(document, "crs", path, "");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    poses.scans.push_back(read_scan(scans[i], path, "scans[" + std::to_string(i) + "]"));
  }
  return poses;
}

std::vector<std::optional<Eigen::Isometry3d>> read_initial_poses(const std::filesystem::path& path,
                                                                 const std::vector<std::string>& files) {
  const nlohmann::json document = read_json_file(path);
  const auto& scans = scans_of(document, path);
  std::vector<std::optional<Eigen::Isometry3d>> poses(files.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::string place = "scans[" + std::to_string(i) + "]";
    const std::string file = scans[i]["file"];
    const auto at = std::find(files.begin(), files.end(), file);
    if (at == files.end()) {
      throw InputError(path, place, "names '" + file + "', which is not among the scans",
                       "name that scan on the command line, or remove the entry");
    }
    poses[static_cast<std::size_t>(at - files.begin())] = pose_of(scans[i], "pose", path, place);
  }
  return poses;
}

std::vector<std::optional<PoseSigmas>> read_initial_sigmas(const std::filesystem::path& path,
                                                           const std::vector<std::string>& files) {
  constexpr const char *kPosition = "sigma_position_m", *kRotation = "sigma_rotation_deg";
  const nlohmann::json document = read_json_file(path);
  const auto& scans = scans_of(document, path);
  std::vector<std::optional<PoseSigmas>> out(files.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const nlohmann::json& entry = scans[i];
    if (!entry.contains(kPosition) && !entry.contains(kRotation)) continue;
    const std::string place = "scans[" + std::to_string(i) + "]";
    const auto at = std::find(files.begin(), files.end(), std::string(entry["file"]));
    if (at == files.end() || !pose_of(entry, "pose", path, place)) {
      throw InputError(path, place, "has standard deviations, but no pose of a scan",
                       "give its pose, or leave them out");
    }
    for (const char* const key : {kPosition, kRotation}) {
      if (entry.contains(key) && entry[key].is_number()) continue;
      throw InputError(path, place, std::string("has no number '") + key + "'",
                       "give both standard deviations, or none");
    }
    const PoseSigmas sigmas{entry[kPosition].get<double>(), entry[kRotation].get<double>() * std::numbers::pi / 180};
    if (!(sigmas.position_m > 0 && sigmas.rotation_rad > 0)) {
      throw InputError(path, place, "has a standard deviation that is not above 0",
                       "use --fix for a pose that is exact");
    }
    out[static_cast<std::size_t>(at - files.begin())] = sigmas;
  }
  return out;
}

void write_transform(const std::filesystem::path& path, const Eigen::Isometry3d& T) {
  std::string text;
  for (int row = 0; row < 4; ++row) text += row_text(T, row, " ") + "\n";
  write_text_file(path, text);
}

}  // namespace tcm_icp
