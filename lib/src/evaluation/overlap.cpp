#include "tcm_icp/evaluation/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"
#include "tcm_icp/core/parallel.hpp"

namespace tcm_icp {

Eigen::MatrixXd overlap_matrix(const std::vector<Points>& clouds, int num_threads) {
  constexpr double kNearInSpacings = 3;
  std::vector<NeighborIndex> indices;
  std::vector<double> radii_m;
  // Most pairs of a long street share nothing: no query is needed to see that.
  std::vector<Eigen::AlignedBox3d> reaches;
  for (const Points& points : clouds) {
    indices.emplace_back(points);
    radii_m.push_back(kNearInSpacings * median_spacing(points, indices.back()));
    Eigen::AlignedBox3d& reach = reaches.emplace_back();
    for (const auto& p : points) reach.extend(p);
    reach.min().array() -= radii_m.back();
    reach.max().array() += radii_m.back();
  }
  const std::size_t n = clouds.size();
  Eigen::MatrixXd overlap = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  parallel_for(num_threads, n * n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const std::size_t i = cell / n, j = cell % n;
      if (clouds[i].empty() || !reaches[i].intersects(reaches[j])) continue;
      const auto near = std::count_if(clouds[i].begin(), clouds[i].end(), [&](const Eigen::Vector3d& p) {
        return reaches[j].contains(p) && indices[j].any_within(p, radii_m[j]);
      });
      overlap(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          static_cast<double>(near) / static_cast<double>(clouds[i].size());
    }
  });
  return overlap;
}

}  // namespace tcm_icp
