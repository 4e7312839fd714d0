// A user's program: registers clouds in memory. Exits with 0 where the second cloud lies where it was taken from.

#include <iostream>
#include <random>
#include <vector>

#include "tcm_icp/pipeline/register_scans.hpp"

int main() {
  const Eigen::Isometry3d T_0_1 = Eigen::Translation3d(2, -1, 0.2) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
  std::mt19937_64 random(7);  // a yard of boxes of all sizes; each point is seen in one of two scans
  std::uniform_real_distribution<double> place(-20, 20), size(0.5, 6), unit(0, 1);
  std::vector<tcm_icp::Cloud> clouds(2);
  for (int box = 0; box < 60; ++box) {
    const Eigen::Vector3d corner(place(random), place(random), 0), edges(size(random), size(random), size(random));
    for (int k = 0; k < 1500; ++k) {
      Eigen::Vector3d on_face(unit(random), unit(random), unit(random));
      on_face[k % 3] = k % 2;
      const Eigen::Vector3d point = corner + on_face.cwiseProduct(edges);
      const bool is_first = unit(random) < 0.5;
      clouds[is_first ? 0 : 1].points.push_back(is_first ? point : T_0_1.inverse() * point);
    }
  }
  tcm_icp::RegistrationOptions options;
  options.reference = "cloud_0";
  const tcm_icp::RegisteredScan scan = tcm_icp::register_scans(clouds, options).scans[1];
  const double error_m = (scan.T_reference_scan.translation() - T_0_1.translation()).norm();
  std::cout << scan.name << ": " << to_string(scan.verdict) << ", " << to_string(scan.reason) << ", probability "
            << scan.probability << ", " << error_m << " m off\n";
  return scan.is_registered() && error_m < 0.05 ? 0 : 1;
}
