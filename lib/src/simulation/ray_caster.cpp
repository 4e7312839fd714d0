#include "tcm_icp/simulation/ray_caster.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <vector>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Iterator = std::vector<Kernel::Triangle_3>::const_iterator;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Eigen::Vector3d twice_area(const Triangle& t) { return (t.b - t.a).cross(t.c - t.a); }

}  // namespace

struct RayCaster::Impl {
  std::vector<Triangle> triangles;
  std::vector<Kernel::Triangle_3> cgal_triangles;  ///< the same, in the same order
  Tree tree;
};

RayCaster::RayCaster(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>()) {
  for (const Triangle& t : mesh.triangles) {
    if (!t.a.allFinite() || !t.b.allFinite() || !t.c.allFinite()) throw InvalidInput("mesh: a corner is not finite");
    if (!(twice_area(t).norm() > 0)) continue;
    impl_->triangles.push_back(t);
    impl_->cgal_triangles.emplace_back(to_cgal(t.a), to_cgal(t.b), to_cgal(t.c));
  }
  if (impl_->triangles.empty()) throw InvalidInput("mesh: no triangle has an area");
  impl_->tree.insert(impl_->cgal_triangles.cbegin(), impl_->cgal_triangles.cend());
  // Both would otherwise happen in the first const query, which may run on several threads.
  impl_->tree.build();
  impl_->tree.accelerate_distance_queries();
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::optional<RayHit> RayCaster::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                           double max_range_m) const {
  const Kernel::Ray_3 ray(to_cgal(origin), Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
  const auto primitive = impl_->tree.first_intersected_primitive(ray);
  if (!primitive) return std::nullopt;
  const Triangle& hit = impl_->triangles[static_cast<std::size_t>(*primitive - impl_->cgal_triangles.cbegin())];
  const Eigen::Vector3d normal = twice_area(hit).normalized();
  const double approach = normal.dot(direction);
  if (approach == 0) return std::nullopt;  // along the surface: no light comes back
  const double range = normal.dot(hit.a - origin) / approach;
  if (range > max_range_m) return std::nullopt;
  return RayHit{range, approach > 0 ? Eigen::Vector3d(-normal) : normal, hit.reflectivity};
}

double RayCaster::distance_m(const Eigen::Vector3d& point) const {
  return std::sqrt(impl_->tree.squared_distance(to_cgal(point)));
}

}  // namespace tcm_icp
