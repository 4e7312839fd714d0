// A user's program: registers clouds in memory. Exits with 0 where every cloud lies where it was taken from.

#include <iostream>
#include <random>
#include <vector>

#include "tcm_icp/pipeline/register_scans.hpp"

int main() {
  const Eigen::Isometry3d T_0_1 = Eigen::Translation3d(2, -1, 0.2) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
  std::mt19937_64 random(7);  // a yard of boxes of all sizes, seen twice
  std::uniform_real_distribution<double> place(-12, 12), size(0.5, 4), unit(0, 1);
  std::vector<tcm_icp::Cloud> clouds(2);
  for (int box = 0; box < 40; ++box) {
    const Eigen::Vector3d corner(place(random), place(random), 0), edges(size(random), size(random), size(random));
    for (int k = 0; k < 2000; ++k) {
      Eigen::Vector3d on_face(unit(random), unit(random), unit(random));
      on_face[k % 3] = k % 2;
      const Eigen::Vector3d point = corner + on_face.cwiseProduct(edges);
      clouds[static_cast<std::size_t>(k / 3 % 2)].points.push_back(k / 3 % 2 == 0 ? point : T_0_1.inverse() * point);
    }
  }
  tcm_icp::RegistrationOptions options;
  options.reference = "cloud_0";
  const tcm_icp::Registration result = tcm_icp::register_scans(clouds, options);
  const tcm_icp::RegisteredScan& scan = result.scans[1];
  const double error_m = (scan.T_reference_scan.translation() - T_0_1.translation()).norm();
  std::cout << scan.name << ": " << to_string(scan.verdict) << ", " << to_string(scan.reason) << ", " << error_m
            << " m off\n";
  return scan.is_registered() && error_m < 0.05 ? 0 : 1;
}
