#include "street_scan.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

constexpr double kMaxRange_m = 80, kNoise_m = 0.01;
constexpr double kLowestRay_rad = -25 * std::numbers::pi / 180, kHighestRay_rad = 15 * std::numbers::pi / 180;

using Box = Eigen::AlignedBox3d;

Box box_at(const Eigen::Vector2d& centre, const Eigen::Vector3d& size) {
  const Eigen::Vector3d low(centre.x() - size.x() / 2, centre.y() - size.y() / 2, 0);
  return {low, low + size};
}

// The street runs along x: houses with gaps and unequal fronts on both sides, parked cars, poles.
std::vector<Box> street() {
  Rng rng = make_stream(1, "benchmark street");
  const auto between = [&](double low, double high) { return low + (high - low) * uniform01(rng); };
  std::vector<Box> boxes;
  for (const double side : {-1.0, 1.0}) {
    for (double x = -90; x < 90; x += 14) {
      const Eigen::Vector3d size(between(8, 13), 10, between(4, 12));
      boxes.push_back(box_at({x + between(-1, 1), side * (between(9, 12) + 5)}, size));
    }
    for (double x = -80; x < 80; x += 11) {
      boxes.push_back(box_at({x + between(-3, 3), side * between(5, 6)}, {between(3.8, 4.8), 1.8, between(1.4, 2)}));
    }
    for (double x = -85; x < 85; x += 17) {
      boxes.push_back(box_at({x + between(-4, 4), side * between(7, 8)}, {0.25, 0.25, between(5, 8)}));
    }
  }
  return boxes;
}

// Distance along the ray to the box from outside it (slabs); infinite where the ray misses.
double distance_to(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& inverse_direction) {
  const Eigen::Array3d a = (box.min() - from).cwiseProduct(inverse_direction);
  const Eigen::Array3d b = (box.max() - from).cwiseProduct(inverse_direction);
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter > 0 && enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

double range(const std::vector<Box>& boxes, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d inverse = direction.cwiseInverse();
  double nearest = direction.z() < 0 ? -from.z() / direction.z() : std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) nearest = std::min(nearest, distance_to(box, from, inverse));
  return nearest;
}

// All rings fire at once, then the head turns by one column.
Points scan(const Eigen::Isometry3d& T_world_scanner, int rings, int columns, std::uint64_t seed) {
  const std::vector<Box> boxes = street();
  Rng rng = make_stream(seed, "benchmark scan");
  Points out;
  for (int column = 0; column < columns; ++column) {
    const double azimuth = 2 * std::numbers::pi * (column + 0.5) / columns;
    for (int ring = 0; ring < rings; ++ring) {
      const double elevation = kLowestRay_rad + (kHighestRay_rad - kLowestRay_rad) * (ring + 0.5) / rings;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const double r = range(boxes, T_world_scanner.translation(), T_world_scanner.linear() * ray);
      if (r <= kMaxRange_m) out.push_back((r + kNoise_m * standard_normal(rng)) * ray);
    }
  }
  return out;
}

}  // namespace

Points street_scan(const Eigen::Isometry3d& T_world_scanner, std::size_t count, std::uint64_t seed) {
  // 28 columns a ring: the shape of a 64-ring scan. Rays into the sky are made up for by more columns.
  const int rings = std::max(4, static_cast<int>(std::sqrt(static_cast<double>(count) / 28)));
  Points points;
  for (int columns = 28 * rings; points.size() < count; columns += columns / 4) {
    points = scan(T_world_scanner, rings, columns, seed);
  }
  return even_sample(points, count);
}

}  // namespace tcm_icp
