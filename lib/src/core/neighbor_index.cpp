#include "tcm_icp/core/neighbor_index.hpp"

#include <CGAL/Kd_tree.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Splitters.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <string>

#include "bounded_descent.hpp"
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

constexpr unsigned kBucketSize = 24;  // 20 to 40 are equally fast

Point to_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

bool nearer(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance_m2 != b.squared_distance_m2 ? a.squared_distance_m2 < b.squared_distance_m2
                                                        : a.index < b.index;
}

struct NearestOne {
  Neighbor best;  ///< starts at the radius; no point has the index it starts with
  double limit_m2() const { return best.squared_distance_m2; }
  void take(std::uint32_t index, double squared_m2) {
    const Neighbor candidate{index, squared_m2};
    if (nearer(candidate, best)) best = candidate;
  }
};

// The k nearest so far, sorted; places not yet taken are infinitely far. Few candidates get in, so that a heap is
// slower.
struct NearestK {
  std::vector<Neighbor>& sorted;
  double limit_m2() const { return sorted.back().squared_distance_m2; }
  void take(std::uint32_t index, double squared_m2) {
    const Neighbor candidate{index, squared_m2};
    if (!nearer(candidate, sorted.back())) return;
    std::size_t i = sorted.size() - 1;
    for (; i > 0 && nearer(candidate, sorted[i - 1]); --i) sorted[i] = sorted[i - 1];
    sorted[i] = candidate;
  }
};

// The first one found ends the search: nothing lies within a negative limit.
struct OneWithin {
  double squared_radius_m2;
  Neighbor found;
  double limit_m2() const { return found.found() ? -1 : squared_radius_m2; }
  void take(std::uint32_t index, double squared_m2) { found = {index, squared_m2}; }
};

struct AllWithin {
  double squared_radius_m2;
  std::vector<Neighbor>& found;
  double limit_m2() const { return squared_radius_m2; }
  void take(std::uint32_t index, double squared_m2) { found.push_back({index, squared_m2}); }
};

}  // namespace

struct NeighborIndex::Impl {
  explicit Impl(std::span<const Eigen::Vector3d> input) : size(input.size()) {
    if (size == 0) return;
    const std::vector<Point> points = copy(input);
    Tree built(boost::counting_iterator<std::uint32_t>(0),
               boost::counting_iterator<std::uint32_t>(static_cast<std::uint32_t>(size)), Splitter(kBucketSize),
               Traits(PointOfIndex{points.data()}));
    built.build();  // or the first query would, and no longer be const
    tree = FlatTree(built);
  }

  static std::vector<Point> copy(std::span<const Eigen::Vector3d> input) {
    constexpr std::size_t kMost = 4'000'000'000;  // what 32 bits count, with room for marks
    if (input.size() > kMost) {
      throw InvalidInput("a neighbour index holds at most 4,000,000,000 points, not " + std::to_string(input.size()));
    }
    std::vector<Point> out;
    out.reserve(input.size());
    for (const auto& p : input) {
      if (!p.allFinite()) throw InvalidInput("a neighbour index cannot hold a point that is not finite");
      out.push_back(to_point(p));
    }
    return out;
  }

  /// Shows the visitor what may lie within its limit: nothing where the index is empty or the query not finite.
  template <typename Visitor>
  void search(const Eigen::Vector3d& query, Visitor& visitor) const {
    if (size > 0 && query.allFinite()) BoundedDescent(tree, query, visitor).run();
  }

  std::size_t size;
  FlatTree tree;
};

NeighborIndex::NeighborIndex(std::span<const Eigen::Vector3d> points) : impl_(std::make_unique<Impl>(points)) {}
NeighborIndex::NeighborIndex(const NeighborIndex& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
NeighborIndex::~NeighborIndex() = default;
NeighborIndex::NeighborIndex(NeighborIndex&&) noexcept = default;
NeighborIndex& NeighborIndex::operator=(NeighborIndex&&) noexcept = default;

std::size_t NeighborIndex::size() const { return impl_->size; }

Neighbor NeighborIndex::nearest(const Eigen::Vector3d& query) const {
  return nearest_within(query, std::numeric_limits<double>::infinity());
}

Neighbor NeighborIndex::nearest_within(const Eigen::Vector3d& query, double radius_m) const {
  constexpr std::uint32_t kNone = Neighbor{}.index;
  NearestOne visitor{{kNone, radius_m * radius_m}};
  impl_->search(query, visitor);
  return visitor.best.index != kNone ? visitor.best : Neighbor{};
}

bool NeighborIndex::any_within(const Eigen::Vector3d& query, double radius_m) const {
  return one_within(query, radius_m).found();
}

Neighbor NeighborIndex::one_within(const Eigen::Vector3d& query, double radius_m) const {
  OneWithin visitor{radius_m * radius_m, {}};
  impl_->search(query, visitor);
  return visitor.found;
}

void NeighborIndex::nearest_k(const Eigen::Vector3d& query, std::size_t k, std::vector<Neighbor>& out) const {
  out.clear();
  const std::size_t count = std::min(k, size());
  if (count == 0 || !query.allFinite()) return;
  out.resize(count);
  NearestK visitor{out};
  impl_->search(query, visitor);
}

void NeighborIndex::nearest_k_within(const Eigen::Vector3d& query, std::size_t k, double radius_m,
                                     std::vector<Neighbor>& out) const {
  out.clear();
  if (!query.allFinite()) return;
  out.assign(k, Neighbor{Neighbor{}.index, radius_m * radius_m});
  NearestK visitor{out};
  impl_->search(query, visitor);
}

void NeighborIndex::within(const Eigen::Vector3d& query, double radius_m, std::vector<Neighbor>& out) const {
  within_unordered(query, radius_m, out);
  std::sort(out.begin(), out.end(), nearer);
}

void NeighborIndex::within_unordered(const Eigen::Vector3d& query, double radius_m, std::vector<Neighbor>& out) const {
  out.clear();
  AllWithin visitor{radius_m * radius_m, out};
  impl_->search(query, visitor);
}

}  // namespace tcm_icp
