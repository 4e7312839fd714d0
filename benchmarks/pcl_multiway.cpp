// Registers scans with PCL, without initial poses, for scripts/compare_registration.py:
//   tcm_icp_pcl_multiway POSES.json SEED CPU_LIMIT_S SCAN.ply...
// Voxel sampling, normals, FPFH, SampleConsensusPrerejective for all pairs, point-to-plane ICP; the maximum spanning
// tree by share of inliers gives the poses, its links refined on voxels of a quarter of the size. A pair is a link from
// a share of 0.3 on; scans without a link to the reference are "unregistered". Voxel sizes are 4, 8, 16 and 32 times
// the spacing as far as they leave 1,000 to 30,000 points of the median scan, coarse ones first; the one that connects
// most scans wins, among equals the one of the best mean share of inliers.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "pcl_pair.hpp"

namespace tcm_icp {
namespace {

constexpr double kMultiples[] = {32, 16, 8, 4};
constexpr std::size_t kLeastPoints = 1000, kMostPoints = 30000;
constexpr double kLeastShare = 0.3;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Answer {
  std::vector<std::optional<Eigen::Isometry3d>> poses;  ///< T_reference_scan; nothing where no link leads
  std::size_t reference = 0;
  std::vector<PclLink> tree;
  double mean_share = 0;  ///< of the tree's links
  std::size_t num_placed() const {
    return static_cast<std::size_t>(std::count_if(poses.begin(), poses.end(), [](const auto& p) { return p; }));
  }
};

template <typename T>
T median_of(std::vector<T> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Sizes that leave a sensible number of points; where none does, the one that comes nearest to 4,000.
std::vector<double> multiples_to_try(const std::vector<PclCloud>& scans, double spacing) {
  std::vector<double> fitting;
  double best = kMultiples[0], best_distance = std::numeric_limits<double>::infinity();
  for (const double multiple : kMultiples) {
    std::vector<std::size_t> counts;
    for (const auto& scan : scans) counts.push_back(pcl_voxel_sample(scan, multiple * spacing)->size());
    const std::size_t count = median_of(counts);
    if (count >= kLeastPoints && count <= kMostPoints) fitting.push_back(multiple);
    const double distance = std::abs(std::log(static_cast<double>(count) / 4000));
    if (distance < best_distance) best = multiple, best_distance = distance;
  }
  return fitting.empty() ? std::vector<double>{best} : fitting;
}

/// Poses by walking the tree's links from the reference.
void place(Answer& answer) {
  std::fill(answer.poses.begin(), answer.poses.end(), std::nullopt);
  answer.poses[answer.reference] = Eigen::Isometry3d::Identity();
  for (std::size_t round = 0; round < answer.poses.size(); ++round) {
    for (const auto& link : answer.tree) {
      auto &source = answer.poses[link.source], &target = answer.poses[link.target];
      if (target && !source) source = *target * link.T_target_source;
      if (source && !target) target = *source * link.T_target_source.inverse();
    }
  }
}

/// The reference is the scan of most links in the largest tree.
Answer join(std::size_t num_scans, std::vector<PclLink> links) {
  std::stable_sort(links.begin(), links.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  std::vector<std::size_t> component(num_scans);
  std::iota(component.begin(), component.end(), std::size_t{0});
  Answer answer;
  for (const auto& link : links) {
    const std::size_t to = component[link.target], from = component[link.source];
    if (to == from) continue;
    std::replace(component.begin(), component.end(), from, to);
    answer.tree.push_back(link);
  }
  std::vector<std::size_t> degree(num_scans, 0);
  for (const auto& link : links) ++degree[link.source], ++degree[link.target];
  answer.poses.resize(num_scans);
  const auto rank = [&](std::size_t k) {
    return std::pair(std::count(component.begin(), component.end(), component[k]), degree[k]);
  };
  for (std::size_t k = 1; k < num_scans; ++k)
    if (rank(k) > rank(answer.reference)) answer.reference = k;
  for (const auto& link : answer.tree) answer.mean_share += link.share / static_cast<double>(answer.tree.size());
  place(answer);
  return answer;
}

/// The tree's links again, on surfaces four times as fine: what the features were sampled for is too coarse for poses.
void refine(Answer& answer, const std::vector<PclCloud>& scans, double voxel_m) {
  std::vector<PclSurface> surfaces;
  for (const auto& scan : scans) surfaces.push_back(pcl_surface(scan, voxel_m / 4));
  for (auto& link : answer.tree) {
    for (const double reach_m : {voxel_m, 1.5 * voxel_m / 4}) {
      link.T_target_source = pcl_refine(surfaces[link.source], surfaces[link.target], link.T_target_source, reach_m);
    }
  }
  place(answer);
}

/// From clouds about their origins to scans as their files have them.
void move_to_files_frames(Answer& answer, const std::vector<Eigen::Vector3d>& origins) {
  const Eigen::Translation3d to_reference(origins[answer.reference]);
  for (std::size_t k = 0; k < origins.size(); ++k) {
    if (answer.poses[k]) *answer.poses[k] = to_reference * *answer.poses[k] * Eigen::Translation3d(-origins[k]);
  }
}

/// Nothing where the time ran out.
std::optional<Answer> register_at(const std::vector<PclCloud>& scans, double voxel_m, double deadline_s) {
  std::vector<PclPrepared> prepared;
  for (const auto& scan : scans) prepared.push_back(pcl_prepare(scan, voxel_m));
  std::vector<PclLink> links;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (std::size_t j = i + 1; j < scans.size(); ++j) {
      if (cpu_s() > deadline_s) return std::nullopt;
      PclLink link = pcl_align_pair(prepared[i], prepared[j], voxel_m);
      link.source = i;
      link.target = j;
      if (link.share >= kLeastShare) links.push_back(link);
    }
  }
  return join(scans.size(), links);
}

nlohmann::json poses_json(const Answer& answer, const std::vector<std::string>& files) {
  nlohmann::json scans = nlohmann::json::array();
  for (std::size_t k = 0; k < files.size(); ++k) {
    const auto& pose = answer.poses[k];
    nlohmann::json rows;
    for (Eigen::Index r = 0; pose && r < 4; ++r)
      rows.push_back({(*pose)(r, 0), (*pose)(r, 1), (*pose)(r, 2), (*pose)(r, 3)});
    const char* status = !pose ? "unregistered" : k == answer.reference ? "reference" : "registered";
    scans.push_back({{"file", files[k].substr(files[k].rfind('/') + 1)}, {"status", status}, {"pose", rows}});
  }
  return {{"reference", scans[answer.reference]["file"]}, {"scans", scans}};
}

int run(const std::string& out, unsigned seed, double limit_s, const std::vector<std::string>& files) {
  std::srand(seed);  // what PCL's sampling draws from
  std::vector<PclCloud> scans;
  std::vector<Eigen::Vector3d> origins;
  std::vector<double> spacings;
  for (const auto& file : files) {
    const PclScan scan = pcl_read(file);
    scans.push_back(scan.cloud);
    origins.push_back(scan.origin);
    spacings.push_back(pcl_spacing(scans.back()));
  }
  const double spacing = median_of(spacings);
  std::optional<Answer> best;
  double chosen = 0;
  nlohmann::json tried = nlohmann::json::array();
  for (const double multiple : multiples_to_try(scans, spacing)) {
    const double begin = cpu_s();
    // The first size is finished whatever it takes: a late answer says more than none.
    const auto answer = register_at(scans, multiple * spacing, best ? limit_s : 1e9);
    if (!answer) {
      tried.push_back({{"multiple", multiple}, {"out_of_time", true}, {"cpu_s", cpu_s() - begin}});
      break;
    }
    tried.push_back({{"multiple", multiple},
                     {"connected", answer->num_placed()},
                     {"fitness", answer->mean_share},
                     {"cpu_s", cpu_s() - begin}});
    const auto rank = [](const Answer& a) { return std::pair(a.num_placed(), a.mean_share); };
    if (best && rank(*best) >= rank(*answer)) continue;
    best = answer;
    chosen = multiple;
  }
  refine(*best, scans, chosen * spacing);
  move_to_files_frames(*best, origins);
  nlohmann::json json = poses_json(*best, files);
  json["chosen_multiple"] = chosen;
  json["tried"] = tried;
  std::ofstream(out) << json.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace tcm_icp

int main(int argc, char** argv) {
  if (argc < 6) {
    std::cerr << "Usage: tcm_icp_pcl_multiway POSES.json SEED CPU_LIMIT_S SCAN.ply SCAN.ply...\n";
    return 1;
  }
  try {
    return tcm_icp::run(argv[1], static_cast<unsigned>(std::stoul(argv[2])), std::stod(argv[3]),
                        {argv + 4, argv + argc});
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
