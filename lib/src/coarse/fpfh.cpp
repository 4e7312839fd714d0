#include "tcm_icp/coarse/fpfh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fpfh_of_neighbors.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3f;
using Histogram = Eigen::Matrix<float, kFpfhSize, 1>;
using Histograms = Descriptors;

// A value of [-1, 1] is shared by its two nearest bins, so that a little noise moves a little weight.
void add(float value, float weight, float* bins) {
  const float at = (value + 1) * 0.5F * static_cast<float>(kFpfhBins - 1);
  const int low = std::min(std::max(static_cast<int>(at), 0), kFpfhBins - 2);
  const float share = std::min(std::max(at - static_cast<float>(low), 0.0F), 1.0F);
  bins[low] += weight * (1 - share);
  bins[low + 1] += weight * share;
}

// How far a normal counts as on the side of another's, 1, or on the other, 0. At right angles, where walls meet the
// ground, the smallest error would decide between the two: there both count.
float share_of_same_side(float cosine) {
  constexpr float kUndecidedCosine = 0.2F;
  return std::clamp(0.5F + 0.5F * cosine / kUndecidedCosine, 0.0F, 1.0F);
}

struct Surface {
  std::vector<Vector3f> points, normals;  // points in radii of the neighbourhood
  Surface(const Cloud& cloud, double radius_m) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      // About the first point: floats would lose the millimetres of far coordinates. In radii: floats of metres would
      // be rounded otherwise in another unit (decision 0015).
      points.push_back(((cloud.points[i] - cloud.points.front()) / radius_m).cast<float>());
      normals.push_back(cloud.normals[i].cast<float>());
    }
  }
};

// The three angles (as sines and cosines) between a point's Darboux frame and each neighbour's normal.
void simple_histogram(const Surface& s, std::size_t i, std::span<const std::uint32_t> neighbors, float* bins) {
  const Vector3f& u = s.normals[i];
  for (const std::uint32_t j : neighbors) {
    if (s.normals[j].isZero(0)) continue;
    const Vector3f line = s.points[j] - s.points[i];
    Vector3f v = line.cross(u);
    const float squared = line.squaredNorm(), across = v.squaredNorm();
    if (!(across > 1e-6F * squared)) continue;  // the neighbour is on the normal: no frame
    v /= std::sqrt(across);
    const float same = share_of_same_side(u.dot(s.normals[j]));
    const float first = v.dot(s.normals[j]), third = u.cross(v).dot(s.normals[j]);
    add(u.dot(line) / std::sqrt(squared), 1, bins + kFpfhBins);
    if (same > 0) {
      add(first, same, bins);
      add(third, same, bins + 2 * kFpfhBins);
    }
    if (same < 1) {
      add(-first, 1 - same, bins);
      add(-third, 1 - same, bins + 2 * kFpfhBins);
    }
  }
  const float total = Eigen::Map<Eigen::Matrix<float, kFpfhBins, 1>>(bins).sum();
  if (total > 0) Eigen::Map<Histogram>(bins) /= total;
}

// What the histogram would be with the normal's sign changed: the first angle stays, the others change sign.
Histogram turned(const Eigen::Ref<const Histogram>& h) {
  Histogram out;
  out << h.head<kFpfhBins>(), h.segment<kFpfhBins>(kFpfhBins).reverse(), h.tail<kFpfhBins>().reverse();
  return out;
}

// Mean of the second angle: above 0 where the neighbours lie on the normal's side.
float height_of_neighbors(const Histogram& h) {
  float sum = 0;
  for (int b = 0; b < kFpfhBins; ++b) sum += h[kFpfhBins + b] * static_cast<float>(2 * b - (kFpfhBins - 1));
  return sum;
}

Histogram weighted_sum(const Surface& s, const Histograms& simple, std::size_t i,
                       std::span<const std::uint32_t> neighbors) {
  Histogram same = Histogram::Zero(), opposite = Histogram::Zero();
  float total = 0;
  for (const std::uint32_t j : neighbors) {
    const float share = share_of_same_side(s.normals[i].dot(s.normals[j]));
    const float weight = 1 / (0.1F + (s.points[j] - s.points[i]).norm());
    total += weight;
    if (share > 0) same += weight * share * simple.col(j);
    if (share < 1) opposite += weight * (1 - share) * simple.col(j);
  }
  if (!(total > 0)) return simple.col(static_cast<Eigen::Index>(i));
  return simple.col(static_cast<Eigen::Index>(i)) + (same + turned(opposite)) / total;
}

}  // namespace

Descriptors fpfh(const Cloud& cloud, const RadiusNeighbors& neighbors, double radius_m) {
  const auto count = static_cast<Eigen::Index>(cloud.size());
  Histograms simple = Histograms::Zero(kFpfhSize, count), out = Histograms::Zero(kFpfhSize, count);
  if (cloud.empty()) return out;
  const Surface surface(cloud, radius_m);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!surface.normals[i].isZero(0)) {
      simple_histogram(surface, i, neighbors.of(i), simple.col(static_cast<Eigen::Index>(i)).data());
    }
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (simple.col(static_cast<Eigen::Index>(i)).isZero(0)) continue;
    Histogram h = weighted_sum(surface, simple, i, neighbors.of(i));
    if (height_of_neighbors(h) < 0) h = turned(h);
    out.col(static_cast<Eigen::Index>(i)) = h.cwiseMax(0).cwiseSqrt().normalized();
  }
  return out;
}

Descriptors fpfh(const Cloud& cloud, double radius_m) {
  if (!cloud.empty() && !cloud.has_normals()) throw InvalidInput("descriptors need points with normals");
  return fpfh(cloud, radius_neighbors(cloud.points, radius_m), radius_m);
}

}  // namespace tcm_icp
