#include "pose_json.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

constexpr double kRigidOnReading = 1e-3;  // poses typed in with four digits pass, a scaled or sheared matrix does not
constexpr double kRigid = 1e-9;

bool has_four_entries(const nlohmann::json& value) { return value.is_array() && value.size() == 4; }

bool is_4x4_numbers(const nlohmann::json& rows) {
  const auto is_number = [](const nlohmann::json& value) { return value.is_number(); };
  return has_four_entries(rows) && std::all_of(rows.begin(), rows.end(), [&](const nlohmann::json& row) {
           return has_four_entries(row) && std::all_of(row.begin(), row.end(), is_number);
         });
}

Eigen::Matrix4d matrix_of(const nlohmann::json& rows, const std::filesystem::path& path, const std::string& place) {
  if (!is_4x4_numbers(rows)) {
    throw InputError(path, place, "the pose is not 4 x 4 numbers", "write it as four rows of four numbers");
  }
  Eigen::Matrix4d matrix;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = rows[row][column].get<double>();
    }
  }
  return matrix;
}

}  // namespace

nlohmann::json read_json_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path, "", "is a folder", "name the file in it");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path, "", "cannot be opened", "check the path and the permissions");
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::parse_error& e) {
    throw InputError(path, "byte " + std::to_string(e.byte), std::string("is not JSON: ") + e.what(), "mend it there");
  } catch (const nlohmann::json::out_of_range& e) {
    throw InputError(path, "", std::string("holds a number beyond the range of double: ") + e.what(), "mend it there");
  }
}

const nlohmann::json& scans_of(const nlohmann::json& document, const std::filesystem::path& path) {
  if (!document.is_object() || !document.contains("scans") || !document["scans"].is_array()) {
    throw InputError(path, "", "has no list 'scans'", "give a poses.json or a truth.json");
  }
  const auto& scans = document["scans"];
  std::set<std::string> files;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::string place = "scans[" + std::to_string(i) + "]";
    if (!scans[i].is_object() || !scans[i].contains("file") || !scans[i]["file"].is_string()) {
      throw InputError(path, place, "has no text 'file'", "name the scan's file there");
    }
    const std::string file = scans[i]["file"];
    if (!files.insert(file).second) {
      throw InputError(path, place, "is the second entry for '" + file + "'", "remove one of them");
    }
  }
  return scans;
}

std::optional<Eigen::Isometry3d> pose_of(const nlohmann::json& entry, const char* key,
                                         const std::filesystem::path& path, const std::string& place) {
  if (!entry.contains(key) || entry[key].is_null()) return std::nullopt;
  const Eigen::Matrix4d matrix = matrix_of(entry[key], path, place + "." + key);
  if (!is_rigid(matrix, kRigidOnReading)) {
    throw InputError(path, place + "." + key, "the pose is not a rigid motion",
                     "the upper 3 x 3 block must be a rotation, the last row 0 0 0 1, without scale or mirror image");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = matrix.topRightCorner<3, 1>();
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  // What we have written ourselves must come back with the same bits.
  pose.linear() = is_rigid(matrix, kRigid) ? R : project_onto_so3(R);
  return pose;
}

std::optional<int> whole_number_of(const nlohmann::json& value) {
  const bool fits = value.is_number_unsigned()
                        ? std::in_range<int>(value.get<std::uint64_t>())
                        : value.is_number_integer() && std::in_range<int>(value.get<std::int64_t>());
  return fits ? std::optional(value.get<int>()) : std::nullopt;
}

}  // namespace tcm_icp
