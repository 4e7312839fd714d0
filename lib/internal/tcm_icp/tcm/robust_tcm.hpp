#pragma once
// The compatibility measure with statistics in place of minima: no single point decides.

#include <Eigen/Geometry>
#include <cstddef>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/tcm/tcm.hpp"

namespace tcm_icp {

struct RobustTcmOptions {
  /// (0, 1]; f looks at this share of the smaller cloud. A quarter: clouds that share a quarter of their points are
  /// then judged by the points they share, and with less overlap f grows quickly, as the order of merging wants it.
  double quantile = 0.25;
  std::size_t max_samples = 2000;  ///< >= 1; points of each cloud that are looked up in the other
  void validate() const;           ///< throws InvalidOptions
};

/// What the robust measure needs of one cloud, in the cloud's own frame. A rigid motion changes none of it.
class RobustTcmCloud {
 public:
  /// @throws InvalidInput  if there are fewer than 2 points, or a coordinate is not finite; InvalidOptions
  explicit RobustTcmCloud(const Points& points, const RobustTcmOptions& options = {});

  std::size_t size() const { return index_.size(); }
  const NeighborIndex& index() const { return index_; }
  const Points& sample() const { return sample_; }
  double median_spacing_m() const { return median_spacing_m_; }
  double quantile() const { return quantile_; }

 private:
  NeighborIndex index_;
  Points sample_;
  double median_spacing_m_;
  double quantile_;
};

/// Robust reading of Eqs. 1-10 (docs/decisions/0003-tcm-frames.md), with b moved by T_a_b:
///   f [m^2] = Q_a + Q_b, Q the squared distance to the other cloud that the nearest share of a cloud's points stays
///   within.
///             The share is quantile * min(1, |other| / |own|), so a small scan that lies inside a large merged cloud
///             is not charged for all the rest; this takes the clouds to be sampled about equally densely.
///   g       = 1 + |s_a - s_b| / max(s_a, s_b), s the median spacing; 1..2. Equal spacings do not make tau zero.
///   h       = 1: quantiles do not grow with the number of points, so nothing is left to normalise; the printed
///             1 / (|a| |b|) would let the largest scan win.
/// The quantile is that of `a`.
/// Cost: 2 x max_samples nearest-neighbour queries. Thread-safe.
TcmTerms robust_tcm_terms(const RobustTcmCloud& a, const RobustTcmCloud& b,
                          const Eigen::Isometry3d& T_a_b = Eigen::Isometry3d::Identity());

}  // namespace tcm_icp
