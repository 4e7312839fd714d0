#include "tcm_icp/evaluation/truth.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "io/pose_json.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using Json = nlohmann::json;

constexpr double kRigidWithin = 1e-3;  // as the scorer of the shared scenes has it

Eigen::MatrixXd matrix(const Json& rows, const std::filesystem::path& path) {
  const auto columns = rows.empty() ? 0 : rows.front().size();
  for (const Json& row : rows) {  // before there is room for all: a long row among short ones would ask for too much
    if (!row.is_array() || row.size() != columns)
      throw InputError(path, "", "a matrix has rows of different lengths", "see docs/formats.md");
  }
  Eigen::MatrixXd m(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows.at(r).at(c).get<double>();
    }
  }
  return m;
}

TrueScan true_scan(const Json& entry, const std::filesystem::path& path) {
  TrueScan scan;
  scan.file = entry.at("file").get<std::string>();
  if (const auto group = entry.find("group"); group != entry.end()) {
    const auto number = whole_number_of(*group);
    if (!number) throw InputError(path, "scan " + scan.file, "has no usable 'group'", "give a whole number");
    scan.group = *number;
  }
  const Eigen::MatrixXd pose = matrix(entry.at("pose"), path);
  if (pose.rows() != 4 || pose.cols() != 4 || !is_rigid(pose, kRigidWithin)) {
    throw InputError(path, "scan " + scan.file, "pose is not a rigid 4x4 matrix", "give rotation and translation");
  }
  scan.T_world_scan.matrix() = pose;
  return scan;
}

Truth truth_from(const Json& json, const std::filesystem::path& path) {
  Truth truth;
  std::set<std::string> names;
  for (const Json& entry : json.at("scans")) {
    truth.scans.push_back(true_scan(entry, path));
    if (!names.insert(truth.scans.back().file).second) {
      throw InputError(path, "scan " + truth.scans.back().file, "is named twice", "name each scan once");
    }
  }
  if (const auto tolerance = json.find("tolerance"); tolerance != json.end()) {
    truth.tolerance.rotation_deg = tolerance->value("rotation_deg", truth.tolerance.rotation_deg);
    truth.tolerance.rmse_m = tolerance->value("rmse_m", truth.tolerance.rmse_m);
  }
  if (const auto overlap = json.find("overlap"); overlap != json.end()) {
    truth.overlap = matrix(*overlap, path);
    const auto n = static_cast<Eigen::Index>(truth.scans.size());
    if (truth.overlap.rows() != n || truth.overlap.cols() != n) {
      throw InputError(path, "overlap", "has not one row and one column for each scan", "");
    }
  }
  return truth;
}

}  // namespace

bool Truth::pair_counts(std::size_t i, std::size_t j, double min_overlap) const {
  if (scans[i].group != scans[j].group) return false;
  if (overlap.size() == 0) return true;
  const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
  return std::max(overlap(a, b), overlap(b, a)) >= min_overlap;
}

Truth read_truth(const std::filesystem::path& path) {
  const Json json = read_json_file(path);
  try {
    return truth_from(json, path);
  } catch (const Json::exception& e) {
    throw InputError(path, "", std::string("is not a truth file: ") + e.what(), "see docs/formats.md");
  }
}

}  // namespace tcm_icp
