#pragma once
// Matches between scans of a made-up room with known poses, without any search for neighbours.

#include <vector>

#include "support/synthetic_scene.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/joint_links.hpp"

namespace tcm_icp::testing {

struct JointScene {
  std::vector<TwistFrame> frames;  ///< of each scan, in the common frame
  std::vector<Twist> truth_m;      ///< steps that bring each scan home; zero for scan 0
  std::vector<JointLink> links;
};

struct JointSceneOptions {
  std::size_t num_scans = 4;
  std::size_t matches_per_link = 200;
  double noise_m = 0;    ///< [m] standard deviation of each residual
  double step_m = 0.05;  ///< [m] scale of the true steps
  double shared_noise_m =
      0;  ///< [m] standard deviation of an error of each scan in each cube; above 0, normals are shared, too
  double shared_edge_m = 1;  ///< [m] edge of these cubes
  bool only_ground = false;  ///< all normals up: nothing holds along x and y and about z
};

/// All pairs of scans in both directions; points all over 20 x 20 x 6 m, normals of every direction. Residuals are
/// those of the linearised problem, so that the steps are exact. `truth` is the same for every noise of one rng state.
inline JointScene joint_scene(const JointSceneOptions& options, Rng& rng) {
  JointScene scene;
  for (std::size_t i = 0; i < options.num_scans; ++i) {
    scene.frames.push_back({Eigen::Vector3d(4.0 * static_cast<double>(i), 2, 1), 8});
    Twist step = Twist::Zero();
    for (double& x : step) x = i == 0 ? 0 : options.step_m * standard_normal(rng);
    scene.truth_m.push_back(step);
  }
  const auto direction = [&rng] {
    return Eigen::Vector3d(standard_normal(rng), standard_normal(rng), standard_normal(rng)).normalized();
  };
  const auto cells = static_cast<std::size_t>(20 / options.shared_edge_m) + 1;
  std::vector<double> errors_m(options.num_scans * cells * cells * cells);  // of each scan in each cube
  for (double& x : errors_m) x = options.shared_noise_m * standard_normal(rng);
  Points normals;
  for (std::size_t k = 0; k < cells * cells * cells; ++k) normals.push_back(direction());
  const auto cell = [&](double x) { return static_cast<std::size_t>(x / options.shared_edge_m); };
  for (std::size_t t = 0; t < options.num_scans; ++t) {
    for (std::size_t s = 0; s < options.num_scans; ++s) {
      if (s == t) continue;
      JointLink link{t, s, {}};
      for (std::size_t k = 0; k < options.matches_per_link; ++k) {
        Correspondence m;
        m.source = {20 * uniform01(rng), 20 * uniform01(rng), 6 * uniform01(rng)};
        const std::size_t cube = (cell(m.source.x()) * cells + cell(m.source.y())) * cells + cell(m.source.z());
        m.normal = options.shared_noise_m > 0 ? normals[cube] : direction();
        if (options.only_ground) m.normal = Eigen::Vector3d::UnitZ();
        const std::size_t size = normals.size();
        const double error =
            options.noise_m * standard_normal(rng) + errors_m[s * size + cube] - errors_m[t * size + cube];
        const double r = error - residual_gradient(m, scene.frames[s]).dot(scene.truth_m[s]) +
                         residual_gradient(m, scene.frames[t]).dot(scene.truth_m[t]);
        m.target = m.source - r * m.normal;
        link.matches.push_back(m);
      }
      scene.links.push_back(link);
    }
  }
  return scene;
}

}  // namespace tcm_icp::testing
