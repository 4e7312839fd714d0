#include "support/synthetic_scene.hpp"

#include <cmath>
#include <numbers>

#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp::testing {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct SurfacePoint {
  Vector3d point, normal;
};

/// A parallelogram, or a tube of length `u` where radius_m > 0.
struct Surface {
  Vector3d origin, u, v;
  double radius_m = 0;

  double area() const { return radius_m > 0 ? 2 * std::numbers::pi * radius_m * u.norm() : u.cross(v).norm(); }

  SurfacePoint draw(Rng& rng) const {
    const double a = uniform01(rng), b = uniform01(rng);
    if (radius_m <= 0) return {origin + a * u + b * v, u.cross(v).normalized()};
    const Vector3d x = u.unitOrthogonal(), y = u.normalized().cross(x);
    const Vector3d out = std::cos(2 * std::numbers::pi * b) * x + std::sin(2 * std::numbers::pi * b) * y;
    return {origin + a * u + radius_m * out, out};
  }
};

void add_box(const Vector3d& corner, const Vector3d& size, double heading_rad, std::vector<Surface>& surfaces) {
  const Eigen::AngleAxisd turn(heading_rad, Vector3d::UnitZ());
  const Vector3d x = turn * Vector3d(size.x(), 0, 0), y = turn * Vector3d(0, size.y(), 0), z(0, 0, size.z());
  surfaces.push_back({corner + z, x, y});
  surfaces.push_back({corner, x, z});
  surfaces.push_back({corner, y, z});
  surfaces.push_back({corner + y, x, z});
  surfaces.push_back({corner + x, y, z});
}

std::vector<Surface> yard() {
  std::vector<Surface> s;
  s.push_back({{-12, -9, 0}, {24, 0, 0}, {0, 18, 0}});
  s.push_back({{-12, -9, 0}, {24, 0, 0}, {0, 0, 5}});
  s.push_back({{-12, -9, 0}, {-3, 17, 0}, {0, 0, 4}});
  s.push_back({{2, 9, 0}, {10, -2, 0}, {0, 0, 6}});
  s.push_back({{12, -9, 0}, {1.5, 14, 0}, {0, 0, 5}});
  s.push_back({{6, -9, 3}, {4, 1, 0}, {-1, 4, 2}});
  add_box({-7, -4, 0}, {3, 2, 2.5}, 0.4, s);
  add_box({2, -5, 0}, {2, 4, 1.5}, 1.1, s);
  add_box({-2, 3, 0}, {4, 1.5, 3}, -0.3, s);
  add_box({7, 1, 0}, {2.5, 2.5, 2}, 0.8, s);
  add_box({-10, 4, 0}, {1.5, 3, 3.5}, 0.15, s);
  add_box({8, -6, 0}, {1, 1, 4}, 0.6, s);
  add_box({-9, -8, 0}, {2, 1.5, 3}, 0.9, s);
  add_box({-3, -7, 0}, {1.5, 2.5, 1}, 0.25, s);
  add_box({4, 5, 0}, {2, 1, 4.5}, 1.3, s);
  add_box({9, 4.5, 0}, {1, 2, 3}, -0.5, s);
  add_box({-6, 1, 0}, {1.2, 1.2, 4}, 0.7, s);
  add_box({-12, -1, 0}, {2, 2, 1.2}, -0.2, s);
  add_box({3, 0.5, 0}, {1, 1.8, 2.2}, 0.5, s);
  add_box({11, -3, 0}, {1.5, 1, 3.2}, 1.2, s);
  s.push_back({{0, -1.5, 0}, {0, 0, 5}, {1, 0, 0}, 0.6});
  s.push_back({{-5, 7, 0}, {0, 0, 4}, {1, 0, 0}, 0.9});
  return s;
}

std::vector<Surface> rubble(Rng& rng) {
  std::vector<Surface> s;
  for (int i = 0; i < 60; ++i) {
    const Isometry3d T = random_pose(9, rng);
    s.push_back(
        {T.translation(), T.linear().col(0) * (1 + 3 * uniform01(rng)), T.linear().col(1) * (1 + 3 * uniform01(rng))});
  }
  return s;
}

std::vector<Surface> surfaces_of(SyntheticShape shape, Rng& rng) {
  if (shape == SyntheticShape::kRubble) return rubble(rng);
  if (shape == SyntheticShape::kParallelPlanes) {
    return {{{-12, -9, 0}, {24, 0, 0}, {0, 18, 0}}, {{-12, -9, 3}, {24, 0, 0}, {0, 18, 0}}};
  }
  return yard();
}

const Surface& draw_surface(const std::vector<Surface>& surfaces, Rng& rng) {
  double total = 0;
  for (const auto& s : surfaces) total += s.area();
  double left = total * uniform01(rng);
  for (const auto& s : surfaces) {
    left -= s.area();
    if (left < 0) return s;
  }
  return surfaces.back();
}

Vector3d random_direction(Rng& rng) {
  const double x = standard_normal(rng), y = standard_normal(rng), z = standard_normal(rng);
  return Vector3d(x, y, z).normalized();
}

SurfacePoint draw_point(const std::vector<Surface>& surfaces, const Vector3d& scanner,
                        const SyntheticSceneOptions& options, Rng& rng) {
  if (uniform01(rng) < options.outlier_share) {
    const double x = 2 * uniform01(rng) - 1, y = 2 * uniform01(rng) - 1, z = uniform01(rng);
    return {scanner + Vector3d(x * options.range_m, y * options.range_m, 6 * z), random_direction(rng)};
  }
  while (true) {
    SurfacePoint p = draw_surface(surfaces, rng).draw(rng);
    if ((p.point - scanner).head<2>().norm() > options.range_m) continue;
    p.point += options.noise_m * standard_normal(rng) * p.normal;
    return p;
  }
}

}  // namespace

Isometry3d random_pose(double reach_m, Rng& rng) {
  const double w = standard_normal(rng), x = standard_normal(rng), y = standard_normal(rng), z = standard_normal(rng);
  const double tx = 2 * uniform01(rng) - 1, ty = 2 * uniform01(rng) - 1, tz = 2 * uniform01(rng) - 1;
  Isometry3d T = Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  T.translation() = reach_m * Vector3d(tx, ty, tz);
  return T;
}

SyntheticScene synthetic_scene(const SyntheticSceneOptions& options, Rng& rng) {
  SyntheticScene scene;
  const std::vector<Surface> surfaces = surfaces_of(options.shape, rng);
  double area = 0;
  for (const auto& s : surfaces) area += s.area();
  scene.spacing_m = std::sqrt(area / static_cast<double>(options.points_per_scan));
  for (std::size_t i = 0; i < options.num_scans; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(options.num_scans);
    const Vector3d scanner(7 * std::cos(angle), 4.5 * std::sin(angle), 1.5);
    const Isometry3d T_world_scan = Eigen::Translation3d(scanner) * random_pose(0, rng);
    Cloud cloud;
    for (std::size_t k = 0; k < options.points_per_scan; ++k) {
      const SurfacePoint p = draw_point(surfaces, scanner, options, rng);
      cloud.points.push_back(p.point);
      cloud.normals.push_back(p.normal);
    }
    scene.scans.push_back(transformed(cloud, T_world_scan.inverse()));
    scene.T_world_scan.push_back(T_world_scan);
  }
  return scene;
}

Isometry3d perturbed(const Isometry3d& T, const Points& points, double angle_rad, double shift_m, Rng& rng) {
  Vector3d middle = Vector3d::Zero();
  for (const auto& p : points) middle += T * p / static_cast<double>(points.size());
  Twist twist;
  twist.head<3>() = angle_rad * random_direction(rng);
  twist.tail<3>() = shift_m * random_direction(rng);
  return isometry_about(middle, twist) * T;
}

double pose_rmse_m(const Isometry3d& expected, const Isometry3d& actual, const Points& points) {
  return rms_displacement(expected.inverse() * actual, points);
}

Cloud scaled_cloud(Cloud cloud, double factor) {
  for (auto& p : cloud.points) p *= factor;
  return cloud;
}

Isometry3d scaled_pose(Isometry3d T, double factor) {
  T.translation() *= factor;
  return T;
}

}  // namespace tcm_icp::testing
