#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <CGAL/remove_outliers.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "outliers/outlier_detectors.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp::detail {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

constexpr std::size_t kSpacingNeighbors = 6;  // CGAL's manual: one ring of neighbours on a surface
constexpr std::size_t kSpacingSamples = 2000;

// Median over the cloud of the mean distance to the six nearest. CGAL::compute_average_spacing takes the mean over the
// cloud, which strays among them raise as much as they please.
double typical_spacing(const Points& points) {
  const NeighborIndex index(points);
  std::vector<double> spacings;
  std::vector<Neighbor> nearest;
  for (const auto& p : even_sample(points, kSpacingSamples)) {
    index.nearest_k(p, kSpacingNeighbors + 1, nearest);
    double sum = 0;
    for (const auto& n : nearest) sum += std::sqrt(n.squared_distance_m2);
    spacings.push_back(sum / static_cast<double>(nearest.size() - 1));  // the point itself is at 0
  }
  return median(spacings);
}

}  // namespace

std::vector<std::size_t> distance_outliers(const Points& points, int num_neighbors, double factor,
                                           double& threshold_m) {
  std::vector<Point> cgal_points;
  cgal_points.reserve(points.size());
  for (const auto& p : points) cgal_points.emplace_back(p.x(), p.y(), p.z());
  threshold_m = factor * typical_spacing(points);
  if (threshold_m == 0) return {};  // mostly duplicates: no length to compare with

  std::vector<std::size_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  // 100 %: the distance alone decides, however many there are.
  const auto first_outlier =
      CGAL::remove_outliers<CGAL::Sequential_tag>(indices, static_cast<unsigned>(num_neighbors),
                                                  CGAL::parameters::point_map(CGAL::make_property_map(cgal_points))
                                                      .threshold_percent(100)
                                                      .threshold_distance(threshold_m));
  std::vector<std::size_t> outliers(first_outlier, indices.end());
  std::sort(outliers.begin(), outliers.end());
  return outliers;
}

}  // namespace tcm_icp::detail
