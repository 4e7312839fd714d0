#include "tcm_icp/tcm/tcm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tcm/require_two.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

Eigen::Vector3d mean(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

double min_squared_distance(const Points& points, const NeighborIndex& index) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Neighbor> pair;
  for (const auto& p : points) {
    // The nearest is the point itself or its duplicate, so the second is the nearest other one in either case.
    index.nearest_k(p, 2, pair);
    least = std::min(least, pair[1].squared_distance_m2);
  }
  return least;
}

}  // namespace

TcmCloud::TcmCloud(const Points& points)
    : index_(require_two(points, "the compatibility measure")),
      centroid_(mean(points)),
      min_squared_distance_m2_(min_squared_distance(points, index_)) {}

double tcm_f(const TcmCloud& a, const TcmCloud& b, const Eigen::Isometry3d& T_a_b) {
  // Moving the one query point, not the cloud, keeps both trees valid.
  const double x = a.index().nearest(T_a_b * b.centroid()).squared_distance_m2;
  const double y = b.index().nearest(T_a_b.inverse() * a.centroid()).squared_distance_m2;
  return x + y;
}

double tcm_g(const TcmCloud& a, const TcmCloud& b) {
  return std::abs(a.min_squared_distance_m2() - b.min_squared_distance_m2());
}

double tcm_h(const TcmCloud& a, const TcmCloud& b) {
  return 1.0 / (static_cast<double>(a.size()) * static_cast<double>(b.size()));
}

TcmTerms tcm_terms(const TcmCloud& a, const TcmCloud& b, const Eigen::Isometry3d& T_a_b) {
  return {tcm_f(a, b, T_a_b), tcm_g(a, b), tcm_h(a, b)};
}

double tcm(const Cloud& a, const Cloud& b) { return tcm_terms(TcmCloud(a.points), TcmCloud(b.points)).tau(); }

TcmEvaluator::TcmEvaluator(const TcmCloud& fixed, const TcmCloud& moving)
    : fixed_(fixed), moving_(moving), gh_(tcm_g(fixed, moving) * tcm_h(fixed, moving)) {}

double TcmEvaluator::operator()(const Eigen::Isometry3d& T_fixed_moving) const {
  return tcm_f(fixed_, moving_, T_fixed_moving) * gh_;
}

}  // namespace tcm_icp
