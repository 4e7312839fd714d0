#include "tcm_icp/registration/match_precision.hpp"

#include <algorithm>
#include <cmath>

#include "core/tie.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kMaxClasses = 8;
constexpr std::size_t kMatchesOfClass = 100;  // fewest: their median absolute residual is good to about a tenth

double plane_distance_m(const Correspondence& match) { return std::abs(match.normal.dot(match.source - match.target)); }

// Agreements that part the matches into classes of one size, ascending.
std::vector<double> class_borders(std::vector<double> agreements) {
  const std::size_t num_classes = std::clamp<std::size_t>(agreements.size() / kMatchesOfClass, 1, kMaxClasses);
  std::sort(agreements.begin(), agreements.end());
  std::vector<double> borders;
  for (std::size_t k = 1; k < num_classes; ++k) borders.push_back(agreements[k * agreements.size() / num_classes]);
  return borders;
}

}  // namespace

void set_precisions(std::vector<JointLink>& links, const std::vector<std::vector<bool>>& doubted) {
  const auto is_doubted = [&](std::size_t link, std::size_t match) { return !doubted.empty() && doubted[link][match]; };
  std::vector<double> agreements, distances, doubted_distances;
  for (std::size_t l = 0; l < links.size(); ++l) {
    for (std::size_t m = 0; m < links[l].matches.size(); ++m) {
      const Correspondence& match = links[l].matches[m];
      if (is_doubted(l, m)) {
        doubted_distances.push_back(plane_distance_m(match));
      } else {
        agreements.push_back(match.agreement);
        distances.push_back(plane_distance_m(match));
      }
    }
  }
  if (distances.empty()) return;
  const std::vector<double> borders = class_borders(agreements);
  // Two points that are each other's nearest are a match of both links, with one agreement but for rounding: a border
  // between the two would be drawn by rounding.
  const auto class_of = [&](double agreement) {
    return static_cast<std::size_t>(std::upper_bound(borders.begin(), borders.end(), agreement, clearly_less) -
                                    borders.begin());
  };
  std::vector<std::vector<double>> of_class(borders.size() + 1);
  for (std::size_t i = 0; i < distances.size(); ++i) of_class[class_of(agreements[i])].push_back(distances[i]);

  const double typical_m = median(distances);
  const auto precision_of = [&](double own_m) {
    return typical_m > 0 ? typical_m / std::max(own_m, typical_m / kMaxPrecision) : 1;
  };
  std::vector<double> precisions;
  for (auto& values : of_class) {
    precisions.push_back(precision_of(values.empty() ? typical_m : median(values)));
  }
  const double of_doubted = doubted_distances.empty() ? 1 : precision_of(median(doubted_distances));
  for (std::size_t l = 0; l < links.size(); ++l) {
    for (std::size_t m = 0; m < links[l].matches.size(); ++m) {
      Correspondence& match = links[l].matches[m];
      match.precision = precisions[class_of(match.agreement)];
      if (is_doubted(l, m)) match.precision = std::min(match.precision, of_doubted);
    }
  }
}

}  // namespace tcm_icp
