#include "report/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {
namespace {

// Matches are a sample of the surfaces, of a few percent: the small cell that has one tells, else the large one.
constexpr double kSmallCellInVoxels = 4, kLargeCellInVoxels = 10;
constexpr double kMostInVoxels = 2;  // as far as matches are looked for
constexpr double kStray = 0.005;     // of the points on either side of an axis, left out of the box

struct CellKey {
  std::array<int, 3> at;
  bool operator==(const CellKey&) const = default;
};

struct CellHash {
  std::size_t operator()(const CellKey& k) const {
    std::size_t h = 0;
    for (const int x : k.at) h = (h ^ static_cast<std::size_t>(x)) * 0x9e3779b97f4a7c15U;
    return h ^ (h >> 29U);
  }
};

CellKey cell_of(const Eigen::Vector3f& p, double cell_m) {
  CellKey key{};
  for (int k = 0; k < 3; ++k) {
    key.at[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(static_cast<double>(p[k]) / cell_m));
  }
  return key;
}

// Mean distance of a scan's matches in each cell.
class DistanceGrid {
 public:
  explicit DistanceGrid(double cell_m) : cell_m_(cell_m) {}
  void add(const LinkResidual& match) {
    auto& [sum, n] = cells_[cell_of(match.point, cell_m_)];
    sum += std::abs(static_cast<double>(match.distance_m));
    ++n;
  }
  std::uint8_t code(const Eigen::Vector3f& point, double most_m) const {
    const auto at = cells_.find(cell_of(point, cell_m_));
    if (at == cells_.end()) return Scene::kNoSurface;
    const double mean_m = at->second.first / static_cast<double>(at->second.second);
    return static_cast<std::uint8_t>(std::lround(254 * std::sqrt(std::min(1.0, mean_m / most_m))));
  }

 private:
  double cell_m_;
  std::unordered_map<CellKey, std::pair<double, std::size_t>, CellHash> cells_;
};

void measure_distances(const PipelineResult& result, int num_threads, Scene& scene) {
  const double voxel_m = result.fine_voxel_m;
  scene.most_m = kMostInVoxels * result.fine_voxel_m;
  for (SceneScan& scan : scene.scans) scan.distances.assign(scan.points.size(), Scene::kNoSurface);
  if (!(voxel_m > 0)) return;
  parallel_for(num_threads, scene.scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      DistanceGrid small(kSmallCellInVoxels * voxel_m), large(kLargeCellInVoxels * voxel_m);
      for (const LinkRecord& link : result.links) {
        if (link.a != i && link.b != i) continue;
        for (const LinkResidual& match : link.residuals.matches) {
          if ((match.of_b ? link.b : link.a) != i) continue;
          small.add(match);
          large.add(match);
        }
      }
      SceneScan& scan = scene.scans[i];
      for (std::size_t k = 0; k < scan.points.size(); ++k) {
        scan.distances[k] = small.code(scan.points[k], scene.most_m);
        if (scan.distances[k] == Scene::kNoSurface) scan.distances[k] = large.code(scan.points[k], scene.most_m);
      }
    }
  });
}

std::size_t group_of(int component, const Eigen::Vector3d& origin, Scene& scene) {
  const auto known = std::find_if(scene.groups.begin() + 1, scene.groups.end(),
                                  [&](const SceneGroup& g) { return g.component == component; });
  const auto number = static_cast<std::size_t>(known - scene.groups.begin());
  if (known == scene.groups.end()) scene.groups.push_back({component, origin, {}});
  return number;
}

}  // namespace

std::size_t Scene::num_points() const {
  std::size_t n = 0;
  for (const auto& scan : scans) n += scan.points.size();
  return n;
}

Eigen::AlignedBox3d box_without_stray_points(const Scene& scene, std::size_t group) {
  constexpr std::size_t kEvery = 5;  // points are enough to find where nearly all are
  std::array<std::vector<double>, 3> values;
  for (const auto& scan : scene.scans) {
    if (scan.group != group) continue;
    for (std::size_t k = 0; k < scan.points.size(); k += kEvery) {
      const Eigen::Vector3d p = scan.T_view_scan * scan.points[k].cast<double>();
      for (int axis = 0; axis < 3; ++axis) values[static_cast<std::size_t>(axis)].push_back(p[axis]);
    }
  }
  Eigen::Vector3d least = Eigen::Vector3d::Zero(), most = Eigen::Vector3d::Zero();
  if (values[0].empty()) return {least, most};
  for (int axis = 0; axis < 3; ++axis) {
    auto& v = values[static_cast<std::size_t>(axis)];
    const auto stray = static_cast<std::ptrdiff_t>(kStray * static_cast<double>(v.size()));
    std::nth_element(v.begin(), v.begin() + stray, v.end());
    least[axis] = v[static_cast<std::size_t>(stray)];
    std::nth_element(v.begin(), v.end() - 1 - stray, v.end());
    most[axis] = *(v.end() - 1 - stray);
  }
  return {least, most};
}

Scene make_scene(const PipelineResult& result, ScenePoints points, int num_threads) {
  Scene scene;
  scene.groups.front().origin = result.local_origin();
  scene.scans.resize(result.scans.size());
  for (std::size_t i = 0; i < scene.scans.size(); ++i) {
    SceneScan& scan = scene.scans[i];
    const ScanPose& pose = result.poses[i];
    const Eigen::Vector3d& origin = result.scans[i].origin;
    if (result.has_frame_of_its_own(i)) scan.group = group_of(pose.component, result.local_origin(i), scene);
    scan.points = std::move(points[i]);
    const bool is_in_group = scan.group != 0;
    scan.T_input_scan.translation() =
        origin - (is_in_group ? scene.groups[scan.group].origin : result.scans[result.reference].origin);
    scan.T_view_scan = (is_in_group ? *pose.pose_in_component : pose.T_reference_scan) * Eigen::Translation3d(origin);
    scan.T_view_scan.pretranslate(-scene.groups[scan.group].origin);
    scan.middle = scan.T_view_scan * result.scans[i].middle;
    if ((pose.status == ScanStatus::kUnregistered && !is_in_group) || result.viewpoints.empty()) continue;
    const auto& viewpoint = result.viewpoints[i];
    if (viewpoint && viewpoint->determined()) scan.setup = scan.T_view_scan * (viewpoint->place - origin);
  }
  measure_distances(result, num_threads, scene);
  for (std::size_t g = 0; g < scene.groups.size(); ++g) scene.groups[g].box = box_without_stray_points(scene, g);
  return scene;
}

}  // namespace tcm_icp
