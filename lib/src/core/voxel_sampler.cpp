#include "tcm_icp/core/voxel_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/tie.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "voxel_table.hpp"

namespace tcm_icp {
namespace {

// The first voxel edge as a share of the scan's size: 2.5 mm for a scan whose points lie 10 m from its middle.
constexpr double kFirstVoxelShare = 1.0 / 4096;
// Of a voxel that had to grow: means nearer than this are of one place.
constexpr double kJoinedShare = 0.5;

constexpr double kVoxelStepsPerDecade = 31;

struct Voxel {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
};

std::int64_t floor_to_int(double value) {
  constexpr double kLimit = 0x1.0p61;
  const double clamped = std::clamp(value, -kLimit, kLimit);
  const auto truncated = static_cast<std::int64_t>(clamped);  // std::floor is a call on plain x86-64
  return truncated - (static_cast<double>(truncated) > clamped ? 1 : 0);
}

}  // namespace

VoxelKey voxel_key(const Eigen::Vector3d& point, double voxel_size_m) {
  return {floor_to_int(point.x() / voxel_size_m), floor_to_int(point.y() / voxel_size_m),
          floor_to_int(point.z() / voxel_size_m)};
}

double rounded_voxel_size(double voxel_size_m) {
  if (!(voxel_size_m > 0)) return voxel_size_m;
  return std::pow(10.0, std::round(kVoxelStepsPerDecade * std::log10(voxel_size_m)) / kVoxelStepsPerDecade);
}

std::size_t VoxelKeyHash::operator()(const VoxelKey& key) const {
  std::uint64_t h = static_cast<std::uint64_t>(key.x) * 0x9e3779b97f4a7c15ULL;
  h ^= static_cast<std::uint64_t>(key.y) * 0xc2b2ae3d27d4eb4fULL + (h >> 29);
  h ^= static_cast<std::uint64_t>(key.z) * 0x165667b19e3779f9ULL + (h >> 31);
  h ^= h >> 32;
  h *= 0xd6e8feb86659fd93ULL;
  return h ^ (h >> 32);
}

struct VoxelSampler::Impl {
  explicit Impl(std::size_t max) : max_voxels(max) {}

  std::size_t max_voxels;
  double size = 0;
  bool has_grown = false;
  Eigen::Vector3d waiting = Eigen::Vector3d::Zero();  ///< the one place where all points so far lie
  double num_waiting = 0;
  VoxelTable table;
  std::vector<Voxel> voxels;

  void choose_size(const Points& points) {
    std::vector<double> values(points.size());
    Eigen::Vector3d middle;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][axis];
      middle[axis] = median(values);
    }
    // The median, so that a stray point a light year away decides nothing.
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = (points[i] - middle).norm();
    double length = median(values);
    if (length == 0) {
      length = *std::max_element(values.begin(), values.end());
    }
    size = kFirstVoxelShare * length;
  }

  void insert(const VoxelKey& key, const Eigen::Vector3d& sum, double count) {
    add(key, sum, count);
    while (voxels.size() > max_voxels) coarsen();
  }

  void coarsen() {
    std::vector<Voxel> finer;
    finer.swap(voxels);
    const VoxelTable finer_table = std::exchange(table, VoxelTable());
    size *= 2;
    has_grown = true;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      const VoxelKey& key = finer_table.keys()[i];
      // Arithmetic shift: floor(k / 2) for negative keys too.
      add({key.x >> 1, key.y >> 1, key.z >> 1}, finer[i].sum, finer[i].count);
    }
  }

  // Where a voxel's border runs through one place, its points' means lie on both sides of it, nearer to one another
  // than voxels are wide. They become one, or neighbours of a point would be that one place over and over.
  void join_split_places() {
    std::vector<std::uint32_t> order(voxels.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return voxels[a].count > voxels[b].count; });
    const double reach = kJoinedShare * size;
    for (const std::uint32_t i : order) {
      if (voxels[i].count == 0) continue;
      const Eigen::Vector3d mean = voxels[i].sum / voxels[i].count;
      for (int n = 0; n < VoxelTable::kBlock; ++n) {
        const std::uint32_t j = table.find_in_block(table.keys()[i], n);
        if (j == VoxelTable::kNone || j == i || voxels[j].count == 0) continue;
        if ((voxels[j].sum / voxels[j].count - mean).squaredNorm() > reach * reach) continue;
        voxels[i].sum += voxels[j].sum;
        voxels[i].count += voxels[j].count;
        voxels[j].count = 0;
      }
    }
    std::erase_if(voxels, [](const Voxel& v) { return v.count == 0; });
  }

  void add(const VoxelKey& key, const Eigen::Vector3d& sum, double count) {
    const std::uint32_t number = table.find_or_insert(key);
    if (number == voxels.size()) voxels.emplace_back();
    voxels[number].sum += sum;
    voxels[number].count += count;
  }
};

VoxelSampler::VoxelSampler(std::size_t max_voxels) : impl_(nullptr) {
  if (max_voxels < 8) {
    throw InvalidOptions("max_voxels is " + std::to_string(max_voxels) + "; it must be at least 8");
  }
  impl_ = std::make_unique<Impl>(max_voxels);
}
VoxelSampler::~VoxelSampler() = default;
VoxelSampler::VoxelSampler(VoxelSampler&&) noexcept = default;
VoxelSampler& VoxelSampler::operator=(VoxelSampler&&) noexcept = default;

void VoxelSampler::add(std::span<const Eigen::Vector3d> points) {
  auto& s = *impl_;
  if (points.empty()) return;
  if (s.size == 0) {
    // As long as all points are equal they wait as one: there is no length yet.
    Points all(points.begin(), points.end());
    if (s.num_waiting > 0) all.push_back(s.waiting);
    s.choose_size(all);
    if (s.size == 0) {
      s.waiting = points.front();
      s.num_waiting += static_cast<double>(points.size());
      return;
    }
    if (s.num_waiting > 0) s.insert(voxel_key(s.waiting, s.size), s.num_waiting * s.waiting, s.num_waiting);
  }
  for (const auto& p : points) s.insert(voxel_key(p, s.size), p, 1);
}

VoxelSample VoxelSampler::finish() {
  auto& s = *impl_;
  if (s.size == 0) {
    if (s.num_waiting == 0) return {};
    return {{s.waiting}, {static_cast<float>(s.num_waiting)}};
  }
  if (s.has_grown) s.join_split_places();
  VoxelSample out;
  out.points.reserve(s.voxels.size());
  out.counts.reserve(s.voxels.size());
  for (const auto& v : s.voxels) {
    out.points.push_back(v.sum / v.count);
    out.counts.push_back(static_cast<float>(v.count));
  }
  return out;
}

double VoxelSampler::voxel_size_m() const { return impl_->size; }

std::size_t count_voxels(const Points& points, double voxel_size_m, std::size_t stop_at) {
  VoxelTable table;
  for (const auto& p : points) {
    if (table.size() >= stop_at) break;
    table.find_or_insert(voxel_key(p, voxel_size_m));
  }
  return table.size();
}

Cloud voxel_downsample(const Cloud& cloud, double voxel_size_m) {
  VoxelTable table;
  std::vector<Voxel> voxels;
  std::vector<std::uint32_t> voxel_of(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    voxel_of[i] = table.find_or_insert(voxel_key(cloud.points[i], voxel_size_m));
    if (voxel_of[i] == voxels.size()) voxels.emplace_back();
    voxels[voxel_of[i]].sum += cloud.points[i];
    voxels[voxel_of[i]].count += 1;
  }
  Cloud out;
  out.points.reserve(voxels.size());
  for (const auto& v : voxels) out.points.push_back(v.sum / v.count);
  if (!cloud.has_normals()) return out;

  // Normals have no sign: take the point nearest the mean for the direction, and add the others turned its way. Of two
  // points, both are as near: the first.
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> nearest(voxels.size(), kNone);
  std::vector<double> nearest_squared(voxels.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double squared = (cloud.points[i] - out.points[voxel_of[i]]).squaredNorm();
    if (!cloud.normals[i].isZero() && clearly_less(squared, nearest_squared[voxel_of[i]])) {
      nearest_squared[voxel_of[i]] = squared;
      nearest[voxel_of[i]] = static_cast<std::uint32_t>(i);
    }
  }
  out.normals.assign(voxels.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t v = voxel_of[i];
    if (nearest[v] == kNone) continue;
    const double along = cloud.normals[i].dot(cloud.normals[nearest[v]]);
    out.normals[v] += along < 0 ? Eigen::Vector3d(-cloud.normals[i]) : cloud.normals[i];
  }
  for (auto& n : out.normals) {
    const double length = n.norm();
    n = length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::Zero();
  }
  return out;
}

}  // namespace tcm_icp
