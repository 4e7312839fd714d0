#pragma once
// Places spread over a box, and the best of them that are apart.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tcm_icp {

/// Best places of a grid that are this far apart are not next to one another.
constexpr double kNotNextSteps = 1.5;

template <typename Scalar>
struct PlaceGrid {
  std::vector<Eigen::Matrix<Scalar, 3, 1>> places;
  double step = 0;  ///< about the distance between neighbours
};

/// Middles of about `count` cells of the box, which are nearly cubes.
template <typename Scalar>
PlaceGrid<Scalar> grid_of_places(const Eigen::AlignedBox<Scalar, 3>& box, double count) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Vector sizes = box.sizes();
  PlaceGrid<Scalar> grid;
  grid.step = std::cbrt(static_cast<double>(sizes.prod()) / count);
  Eigen::Array3i counts;
  for (int k = 0; k < 3; ++k) {
    counts[k] = std::max(1, static_cast<int>(std::lround(sizes[k] / static_cast<Scalar>(grid.step))));
  }
  for (int i = 0; i < counts[0]; ++i) {
    for (int j = 0; j < counts[1]; ++j) {
      for (int k = 0; k < counts[2]; ++k) {
        const Vector share = (Eigen::Array3i(i, j, k).cast<Scalar>() + Scalar(0.5)) / counts.cast<Scalar>();
        grid.places.push_back(box.min() + share.cwiseProduct(sizes));
      }
    }
  }
  return grid;
}

/// The first `count`, none nearer to one before it than `apart`.
/// @param place_of  the place of a `Found`
template <typename Found, typename PlaceOf>
std::vector<Found> first_apart(const std::vector<Found>& sorted, std::size_t count, double apart, PlaceOf place_of) {
  std::vector<Found> out;
  for (const Found& f : sorted) {
    if (out.size() == count) break;
    const bool known = std::any_of(out.begin(), out.end(), [&](const Found& o) {
      return static_cast<double>((place_of(o) - place_of(f)).norm()) < apart;
    });
    if (!known) out.push_back(f);
  }
  return out;
}

}  // namespace tcm_icp
