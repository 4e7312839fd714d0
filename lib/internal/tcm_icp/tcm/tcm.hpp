#pragma once
// Transformation Compatibility Measure, Eqs. 1-4 and 7-10 of the paper, as printed.

#include <Eigen/Geometry>
#include <cstddef>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"

namespace tcm_icp {

/// The three factors of a measure and their product, as the report shows them.
struct TcmTerms {
  double f = 0;  ///< [m^2] distance of the clouds from each other
  double g = 0;  ///< how much their point spacings differ: [m^2] in the paper's measure, a ratio in the robust one
  double h = 0;  ///< normalisation, without unit

  double tau() const { return f * g * h; }  ///< Eq. 1; smaller is more compatible
};

/// What the measure needs of one cloud: computed once, in the cloud's own frame. A rigid motion changes none of it.
/// Cost O(N log N); about 60 bytes a point.
class TcmCloud {
 public:
  /// @throws InvalidInput  if there are fewer than 2 points, or a coordinate is not finite
  explicit TcmCloud(const Points& points);

  std::size_t size() const { return index_.size(); }
  const NeighborIndex& index() const { return index_; }
  const Eigen::Vector3d& centroid() const { return centroid_; }
  /// M of Eq. 8 [m^2]: the least squared distance between two points of different index; 0 where a point occurs twice.
  double min_squared_distance_m2() const { return min_squared_distance_m2_; }

 private:
  NeighborIndex index_;
  Eigen::Vector3d centroid_;
  double min_squared_distance_m2_;
};

/// f = X + Y [m^2], Eqs. 2-4: the least squared distance of a's points from b's centroid, plus the same the other way
/// round, with b moved by T_a_b. Cost: two nearest-neighbour queries.
double tcm_f(const TcmCloud& a, const TcmCloud& b, const Eigen::Isometry3d& T_a_b = Eigen::Isometry3d::Identity());

/// g = |M - N| [m^2], Eqs. 7-9.
/// @note The paper prints M - N, whose sign depends on which cloud is named first; docs/decisions/0002-tcm-sign.md.
double tcm_g(const TcmCloud& a, const TcmCloud& b);

/// h = 1 / (|a| |b|), Eq. 10.
double tcm_h(const TcmCloud& a, const TcmCloud& b);

/// All three factors, with b moved by T_a_b. Finite and >= 0 for coordinates up to 1e70. Symmetric: exchanging the
/// clouds and inverting the motion changes nothing but rounding.
TcmTerms tcm_terms(const TcmCloud& a, const TcmCloud& b,
                   const Eigen::Isometry3d& T_a_b = Eigen::Isometry3d::Identity());

/// Transformation Compatibility Measure tau(a, b) = f g h [m^4], Eq. 1; smaller is better.
///
/// @param a, b  clouds in one frame; each needs >= 2 points
/// @throws InvalidInput  if a cloud has fewer than 2 points or a coordinate that is not finite
/// @note Equal least spacings (a duplicate point in both, for one) give tau = 0: merge_order.hpp settles such ties.
/// Cost O((N + M) log(N + M)). Thread-safe.
double tcm(const Cloud& a, const Cloud& b);

/// tau of one cloud that moves against one that stays, for the descent: g and h do not change under a rigid motion, so
/// each call costs two nearest-neighbour queries. Keeps references: both clouds must outlive it. Thread-safe.
class TcmEvaluator {
 public:
  TcmEvaluator(const TcmCloud& fixed, const TcmCloud& moving);

  /// tau(fixed, moving moved by T_fixed_moving) [m^4].
  double operator()(const Eigen::Isometry3d& T_fixed_moving) const;

 private:
  const TcmCloud& fixed_;
  const TcmCloud& moving_;
  double gh_;
};

}  // namespace tcm_icp
