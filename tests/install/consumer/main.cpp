// A user's program: moves a cloud and finds each point again by its nearest neighbour. Exits with 0 where all are
// found.

#include <Eigen/Geometry>
#include <iostream>

#include "tcm_icp/core/cloud.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

int main() {
  tcm_icp::Cloud cloud;
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 10; ++y) cloud.points.emplace_back(x, y, 0.1 * x * y);
  }
  tcm_icp::Twist twist;
  twist << 0.3, -0.2, 1.1, 5, -3, 2;
  const Eigen::Isometry3d T_map_scan = tcm_icp::isometry_from_twist(twist);
  const tcm_icp::Cloud moved = tcm_icp::transformed(cloud, T_map_scan);

  const tcm_icp::NeighborIndex index(moved.points);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const tcm_icp::Neighbor neighbor = index.nearest(T_map_scan * cloud.points[i]);
    if (neighbor.index != i || !(neighbor.squared_distance_m2 < 1e-20)) {
      std::cerr << "point " << i << " was not found again\n";
      return 1;
    }
  }
  std::cout << "found all " << index.size() << " points again\n";
  return 0;
}
