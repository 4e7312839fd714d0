#pragma once
// JSON with errors that name file and place.

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace tcm_icp {

/// @throws InputError  if the file is missing, or not JSON (with line and column)
nlohmann::json read_json_file(const std::filesystem::path& path);

/// The list "scans" of a poses.json or truth.json: objects, each with a string "file", none of them twice.
/// @throws InputError  where it is not
const nlohmann::json& scans_of(const nlohmann::json& document, const std::filesystem::path& path);

/// A 4 x 4 matrix, rigid to 1e-3; the rotation is projected onto SO(3) where it is not rigid to 1e-9. nullopt where
/// `entry` has no `key`, or null.
/// @throws InputError  with `place`, where it is something else
std::optional<Eigen::Isometry3d> pose_of(const nlohmann::json& entry, const char* key,
                                         const std::filesystem::path& path, const std::string& place);

/// A whole number within the range of int; nullopt where `value` is something else. By hand: the library casts whatever
/// number there is, and one beyond the range has no defined value.
std::optional<int> whole_number_of(const nlohmann::json& value);

}  // namespace tcm_icp
