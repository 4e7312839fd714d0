#include "place_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "place_grid.hpp"

namespace tcm_icp {
namespace {

// Scanners stand within what they see, or beside it. A flat scan is looked at from above and below, too.
constexpr double kGridPlaces = 1200;
constexpr float kGridMargin = 0.3F, kLeastMargin = 0.1F;

// As good as the best, but for chance.
constexpr double kAsGoodFactor = 1.25, kAsGoodMargin = 0.001;
constexpr int kTrialMoves = 48;
constexpr double kLongestMove = 0.2;
constexpr double kStartFactor = 1.5;  // of looks for others: clear of the bound that they must not cross

double most_as_good(const Found& best) { return kAsGoodFactor * best.hidden + kAsGoodMargin; }

// Places along the line on which those as good lie: a narrow field of view leaves the distance open, and few random
// moves meet that line.
void look_along(HiddenShare& hidden, const Found& from, std::vector<Found>& found) {
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const Place& p : as_good(found, from)) spread += (p - from.place) * (p - from.place).transpose();
  const Eigen::Vector3f direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(spread).eigenvectors().col(2);
  for (const double length : {0.0125, 0.025, 0.05, 0.1, 0.2}) {
    for (const double sign : {-1.0, 1.0}) {
      const Place place = from.place + static_cast<float>(sign * length) * direction;
      found.push_back({hidden(place, most_as_good(from)), place});
    }
  }
}

}  // namespace

std::vector<Found> best_of(std::vector<Found> found, std::size_t count, double apart) {
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.hidden < b.hidden; });
  return first_apart(found, count, apart, [](const Found& f) { return f.place; });
}

Eigen::AlignedBox3f search_box(const Eigen::AlignedBox3f& of_points) {
  const Eigen::Vector3f margin = (kGridMargin * of_points.sizes()).cwiseMax(kLeastMargin);
  return {of_points.min() - margin, of_points.max() + margin};
}

std::vector<Found> search_grid(HiddenShare& hidden, const Eigen::AlignedBox3f& box, std::size_t count) {
  const PlaceGrid<float> grid = grid_of_places(box, kGridPlaces);
  std::vector<Found> found;
  for (const Place& place : grid.places) found.push_back({hidden(place), place});
  return best_of(found, count, kNotNextSteps * grid.step);
}

void descend(HiddenShare& hidden, double first_step, double last_step, Found& at,
             const std::function<bool(const Place&)>& allowed) {
  at.hidden = hidden(at.place);
  for (double step = first_step; step >= last_step; step /= 2) {
    int failed = 0;
    for (int k = 0; failed < 6; k = (k + 1) % 6) {
      Place place = at.place;
      place[k / 2] += static_cast<float>(k % 2 == 0 ? step : -step);
      const double share = !allowed || allowed(place) ? hidden(place, at.hidden) : 1;
      if (share < at.hidden) {
        at = {share, place};
        failed = 0, --k;
      } else {
        ++failed;
      }
    }
  }
}

std::vector<Place> as_good(const std::vector<Found>& around, const Found& best) {
  std::vector<Place> good;
  for (const Found& f : around) {
    if (f.hidden <= most_as_good(best)) good.push_back(f.place);
  }
  return good;
}

std::vector<Found> look_around(HiddenShare& hidden, const Found& from, Rng& rng) {
  std::vector<Found> found;
  for (int k = 0; k < kTrialMoves; ++k) {
    const Eigen::Vector3d direction(standard_normal(rng), standard_normal(rng), standard_normal(rng));
    const double length = kLongestMove * uniform01(rng);
    const Place place = from.place + (length * direction.normalized()).cast<float>();
    found.push_back({hidden(place, most_as_good(from)), place});
  }
  look_along(hidden, from, found);
  return found;
}

std::vector<Place> look_for_others(HiddenShare& hidden, const Found& from, double apart, double too_far) {
  std::vector<Place> others;
  for (int code = 0; code < 27; ++code) {
    const Eigen::Vector3f direction(static_cast<float>(code % 3 - 1), static_cast<float>(code / 3 % 3 - 1),
                                    static_cast<float>(code / 9 - 1));
    if (direction.isZero()) continue;
    Found other{1, from.place + static_cast<float>(kStartFactor * apart) * direction.normalized()};
    descend(hidden, apart / 2, apart / 4, other,
            [&](const Place& p) { return (p - from.place).norm() >= static_cast<float>(apart); });
    if (other.hidden > most_as_good(from)) continue;
    others.push_back(other.place);
    if ((other.place - from.place).norm() > static_cast<float>(too_far)) break;
  }
  return others;
}

}  // namespace tcm_icp
