#pragma once
// Which ground is taken: rectangles that must not overlap.

#include <Eigen/Core>
#include <vector>

namespace tcm_icp {

/// A turned rectangle on the ground [m].
struct Footprint {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double heading_rad = 0;
  Eigen::Vector2d half_size_m = Eigen::Vector2d::Ones();
};

bool overlap(const Footprint& a, const Footprint& b);

class SitePlan {
 public:
  /// True where the footprint, `margin_m` wider on each side, touches nothing that is taken.
  bool is_free(const Footprint& footprint, double margin_m) const;
  void take(const Footprint& footprint) { taken_.push_back(footprint); }

 private:
  std::vector<Footprint> taken_;
};

}  // namespace tcm_icp
