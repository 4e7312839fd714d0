#include "scan_pair.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "street_scan.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/random.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/scan_reader.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kNumVoxels = 20'000;
constexpr double kStartRotation_rad = 5 * std::numbers::pi / 180, kStartTranslation_m = 0.5;

Points read_points(const std::filesystem::path& path) {
  ScanReader reader(path, ReadAttributes::kNo);
  Points points;
  for (PointBlock block; reader.read(block);) points.insert(points.end(), block.points.begin(), block.points.end());
  return points;
}

// The truth of a scene names all scans of its folder.
Eigen::Isometry3d pose_of(const std::filesystem::path& scan, const std::filesystem::path& truth) {
  std::vector<std::string> files{scan.filename().string()};
  for (const auto& entry : std::filesystem::directory_iterator(truth.parent_path() / ".")) {
    const std::string file = entry.path().filename().string();
    if (file != files.front()) files.push_back(file);
  }
  const auto pose = read_initial_poses(truth, files).front();
  if (!pose) throw InvalidInput(truth.string() + " has no pose of " + scan.string());
  return *pose;
}

Eigen::Vector3d centroid(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

void sample(ScanPair& pair) {
  pair.voxel_size_m = std::max(voxel_size_for(pair.target, kNumVoxels), voxel_size_for(pair.source, kNumVoxels));
  for (Points* points : {&pair.target, &pair.source}) {
    *points = voxel_downsample({std::move(*points), {}}, pair.voxel_size_m).points;
  }
}

Eigen::Vector3d random_direction(Rng& rng) {
  return Eigen::Vector3d(standard_normal(rng), standard_normal(rng), standard_normal(rng)).normalized();
}

}  // namespace

ScanPair street_pair() {
  Eigen::Isometry3d T_world_target = Eigen::Isometry3d::Identity(), T_world_source = Eigen::Isometry3d::Identity();
  T_world_target.translation() << 1, 0.5, 2;
  T_world_source.translation() << 9, -0.5, 2;
  T_world_source.rotate(Eigen::AngleAxisd(20 * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()));
  ScanPair pair{.name = "street",
                .target = street_scan(T_world_target, 150'000, 1),
                .source = street_scan(T_world_source, 150'000, 2),
                .T_target_source = T_world_target.inverse() * T_world_source};
  sample(pair);
  return pair;
}

ScanPair read_pair(const std::filesystem::path& target, const std::filesystem::path& source,
                   const std::filesystem::path& truth) {
  const Eigen::Isometry3d T_world_target = pose_of(target, truth), T_world_source = pose_of(source, truth);
  ScanPair pair{.name = target.parent_path().filename().string(),
                .target = read_points(target),
                .source = read_points(source),
                .T_target_source = T_world_target.inverse() * T_world_source};
  // Coordinates of a map's size would cost PCL's floats their digits: both scans are taken about their own centroids.
  const Eigen::Vector3d target_centre = centroid(pair.target), source_centre = centroid(pair.source);
  for (auto& p : pair.target) p -= target_centre;
  for (auto& p : pair.source) p -= source_centre;
  pair.T_target_source =
      Eigen::Translation3d(-target_centre) * pair.T_target_source * Eigen::Translation3d(source_centre);
  sample(pair);
  return pair;
}

std::vector<Eigen::Isometry3d> starts_near_truth(const ScanPair& pair, std::size_t count) {
  Rng rng = make_stream(3, "benchmark starts");
  const Eigen::Vector3d centre = pair.T_target_source * centroid(pair.source);
  std::vector<Eigen::Isometry3d> starts;
  for (std::size_t i = 0; i < count; ++i) {
    Twist twist;
    twist.head<3>() = kStartRotation_rad * random_direction(rng);
    twist.tail<3>() = kStartTranslation_m * random_direction(rng);
    starts.push_back(isometry_about(centre, twist) * pair.T_target_source);
  }
  return starts;
}

}  // namespace tcm_icp
