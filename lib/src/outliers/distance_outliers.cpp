#include <CGAL/Simple_cartesian.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/property_map.h>
#include <CGAL/remove_outliers.h>

#include <algorithm>
#include <numeric>

#include "outliers/outlier_detectors.hpp"

namespace tcm_icp::detail {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

constexpr unsigned kSpacingNeighbors = 6;  // CGAL's manual: one ring of neighbours on a surface

}  // namespace

std::vector<std::size_t> distance_outliers(const Points& points, int num_neighbors, double factor,
                                           double& threshold_m) {
  std::vector<Point> cgal_points;
  cgal_points.reserve(points.size());
  for (const auto& p : points) cgal_points.emplace_back(p.x(), p.y(), p.z());
  const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(cgal_points, kSpacingNeighbors);
  threshold_m = factor * spacing;

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
