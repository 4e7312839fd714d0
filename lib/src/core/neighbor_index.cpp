#include "tcm_icp/core/neighbor_index.hpp"

#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <CGAL/Splitters.h>

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

// Distances only, no predicates: doubles are enough.
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

// The tree holds indices; coordinates are looked up in one array.
struct PointOfIndex {
  using key_type = std::uint32_t;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::lvalue_property_map_tag;
  const Point* points = nullptr;
  const Point& operator[](key_type i) const { return points[i]; }
  friend reference get(const PointOfIndex& map, key_type i) { return map.points[i]; }
};

using BaseTraits = CGAL::Search_traits_3<Kernel>;
using Traits = CGAL::Search_traits_adapter<std::uint32_t, PointOfIndex, BaseTraits>;
using Splitter = CGAL::Sliding_midpoint<Traits>;
using Tree = CGAL::Kd_tree<Traits, Splitter, CGAL::Tag_true, CGAL::Tag_true>;  // extended nodes, cached coordinates
using Distance = CGAL::Distance_adapter<std::uint32_t, PointOfIndex, CGAL::Euclidean_distance<BaseTraits>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits, Distance, Splitter, Tree>;
using Sphere = CGAL::Fuzzy_sphere<Traits>;

constexpr unsigned kBucketSize = 24;  // 20 to 40 are equally fast

Point to_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

bool nearer(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance_m2 != b.squared_distance_m2 ? a.squared_distance_m2 < b.squared_distance_m2
                                                        : a.index < b.index;
}

}  // namespace

struct NeighborIndex::Impl {
  explicit Impl(std::span<const Eigen::Vector3d> input)
      : points(copy(input)),
        map{points.data()},
        tree(boost::counting_iterator<std::uint32_t>(0),
             boost::counting_iterator<std::uint32_t>(static_cast<std::uint32_t>(points.size())), Splitter(kBucketSize),
             Traits(map)),
        distance(map) {
    if (!points.empty()) tree.build();  // or the first query would, and no longer be const
  }

  static std::vector<Point> copy(std::span<const Eigen::Vector3d> input) {
    if (input.size() >= std::numeric_limits<std::uint32_t>::max()) {
      throw InvalidInput("a neighbour index holds at most 2^32 - 2 points, not " + std::to_string(input.size()));
    }
    std::vector<Point> out;
    out.reserve(input.size());
    for (const auto& p : input) {
      if (!p.allFinite()) throw InvalidInput("a neighbour index cannot hold a point that is not finite");
      out.push_back(to_point(p));
    }
    return out;
  }

  std::vector<Point> points;
  PointOfIndex map;
  Tree tree;
  Distance distance;
};

NeighborIndex::NeighborIndex(std::span<const Eigen::Vector3d> points) : impl_(std::make_unique<Impl>(points)) {}
NeighborIndex::~NeighborIndex() = default;
NeighborIndex::NeighborIndex(NeighborIndex&&) noexcept = default;
NeighborIndex& NeighborIndex::operator=(NeighborIndex&&) noexcept = default;

std::size_t NeighborIndex::size() const { return impl_->points.size(); }

Neighbor NeighborIndex::nearest(const Eigen::Vector3d& query) const {
  if (impl_->points.empty()) return {};
  const Search search(impl_->tree, to_point(query), 1, 0.0, true, impl_->distance);
  return {search.begin()->first, search.begin()->second};
}

Neighbor NeighborIndex::nearest_within(const Eigen::Vector3d& query, double radius_m) const {
  const Neighbor n = nearest(query);
  return n.squared_distance_m2 <= radius_m * radius_m ? n : Neighbor{};
}

void NeighborIndex::nearest_k(const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& out) const {
  out.clear();
  if (impl_->points.empty() || k == 0) return;
  const Search search(impl_->tree, to_point(query), static_cast<unsigned>(std::min(k, impl_->points.size())), 0.0, true,
                      impl_->distance);
  for (const auto& [index, squared] : search) out.push_back({index, squared});
  std::sort(out.begin(), out.end(), nearer);
}

void NeighborIndex::within(const Eigen::Vector3d& query, double radius_m, std::vector<Neighbor>& out) const {
  out.clear();
  if (impl_->points.empty()) return;
  const Point centre = to_point(query);
  std::vector<std::uint32_t> indices;
  impl_->tree.search(std::back_inserter(indices), Sphere(centre, radius_m, 0.0, Traits(impl_->map)));
  for (const std::uint32_t i : indices) out.push_back({i, CGAL::squared_distance(centre, impl_->points[i])});
  std::sort(out.begin(), out.end(), nearer);
}

}  // namespace tcm_icp
