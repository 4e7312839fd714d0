// Files of a scene set.

#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/simulation/scene_set.hpp"

namespace tcm_icp {
namespace {

// Keys stay in the order they are given: a person reads these files.
using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "scans are written as they lie in memory");

void write_file(const std::filesystem::path& path, const std::string& content) {
  std::ofstream out(path, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw OutputError(path, "cannot be written", "check permissions and free space");
}

void write_scan(const LidarScan& scan, const std::filesystem::path& path) {
  std::string content =
      "ply\nformat binary_little_endian 1.0\ncomment made by tcm-icp simulate; metres\nelement vertex " +
      std::to_string(scan.cloud.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\nend_header\n";
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    const Eigen::Vector3f p = scan.cloud.points[i].cast<float>();
    const float record[] = {p.x(), p.y(), p.z(), scan.intensity[i]};
    content.append(reinterpret_cast<const char*>(record), sizeof record);
  }
  write_file(path, content);
}

Json rows(const Eigen::Ref<const Eigen::MatrixXd>& m) {
  Json out = Json::array();
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < m.cols(); ++c) row.push_back(m(r, c));
    out.push_back(row);
  }
  return out;
}

/// What a plain terrestrial scanner does not have, where it is there.
void add_effects(const ScannerOptions& s, Json& out) {
  const ScannerOptions plain;
  if (s.sensor != plain.sensor) out["sensor"] = sensor_name(s.sensor);
  if (s.sensor == SensorKind::kSpinning) out["num_lines"] = s.num_lines;
  if (s.sensor == SensorKind::kAerial) {
    out["half_swath_deg"] = s.half_swath_deg;
    out["strip_length_m"] = s.strip_length_m;
    out["line_spacing_m"] = s.line_spacing_m;
  }
  if (s.max_incidence_deg != plain.max_incidence_deg) out["max_incidence_deg"] = s.max_incidence_deg;
  if (s.dropout_share != plain.dropout_share) out["dropout_share"] = s.dropout_share;
  if (s.beam_width_deg != plain.beam_width_deg) out["beam_width_deg"] = s.beam_width_deg;
  if (s.speed_m_s != plain.speed_m_s) {
    out["speed_m_s"] = s.speed_m_s;
    out["turns_per_s"] = s.turns_per_s;
  }
}

Json scanner_json(const ScannerOptions& s) {
  Json out = {{"step_deg", s.step_deg},
              {"min_elevation_deg", s.min_elevation_deg},
              {"max_elevation_deg", s.max_elevation_deg},
              {"min_range_m", s.min_range_m},
              {"max_range_m", s.max_range_m},
              {"range_noise_m", s.range_noise_m},
              {"angular_noise_deg", s.angular_noise_deg},
              {"full_return_signal", s.full_return_signal},
              {"thinning_voxel_m", s.thinning_voxel_m},
              {"isolated_share", s.isolated_share}};
  add_effects(s, out);
  return out;
}

Json truth_json(const SceneSet& set) {
  Json scans = Json::array();
  for (std::size_t i = 0; i < set.scans.size(); ++i) {
    const Eigen::Vector3d& scanner = set.scanner_in_scan[i];
    scans.push_back({{"file", set.truth.scans[i].file},
                     {"points", set.scans[i].cloud.size()},
                     {"pose", rows(set.truth.scans[i].T_world_scan.matrix())},
                     {"scanner", {scanner.x(), scanner.y(), scanner.z()}}});
  }
  Json out = {{"scene", scene_name(set.options.scene)},
              {"source", "tcm-icp simulate"},
              {"licence", "CC0-1.0"},
              {"units", "m"},
              {"seed", set.seed}};
  // The stations of town and plaza share out their path: their distance is no option.
  const bool is_shared = set.options.scene == SceneKind::kTown || set.options.scene == SceneKind::kPlaza;
  if (!is_shared || set.options.overlap) out["station_spacing_m"] = set.options.station_spacing_m;
  if (set.options.overlap) out["wanted_overlap"] = *set.options.overlap;
  if (set.options.scene == SceneKind::kBays) out["clutter"] = set.options.bays.clutter;
  out["scanner_options"] = scanner_json(set.options.scanner);
  out["scans"] = scans;
  out["tolerance"] = {{"rotation_deg", set.truth.tolerance.rotation_deg}, {"rmse_m", set.truth.tolerance.rmse_m}};
  out["overlap"] = rows(set.truth.overlap);
  return out;
}

Json initial_poses_json(const SceneSet& set) {
  Json scans = Json::array();
  for (std::size_t i = 0; i < set.initial_guess.size(); ++i) {
    scans.push_back({{"file", set.truth.scans[i].file}, {"pose", rows(set.initial_guess[i].matrix())}});
  }
  return {{"max_rotation_deg", set.options.initial_guess->max_rotation_deg},
          {"max_shift_m", set.options.initial_guess->max_shift_m},
          {"scans", scans}};
}

}  // namespace

void write_scene_set(const SceneSet& set, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < set.scans.size(); ++i) write_scan(set.scans[i], folder / set.truth.scans[i].file);
  write_file(folder / "truth.json", truth_json(set).dump(1) + "\n");
  if (!set.initial_guess.empty()) write_file(folder / "initial_poses.json", initial_poses_json(set).dump(1) + "\n");
}

}  // namespace tcm_icp
