#pragma once
// Fast point feature histograms: what the surface around a point looks like, whatever the pose of the scan.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

constexpr int kFpfhBins = 11;  ///< of each of the three angles
constexpr int kFpfhSize = 3 * kFpfhBins;

/// One column a point.
using Descriptors = Eigen::Matrix<float, kFpfhSize, Eigen::Dynamic>;

/// FPFH (Rusu et al., 2009) for normals that are axes: each neighbour's normal is turned to the side of the point's
/// own, and the histogram is turned at the end to the side its neighbours lie on. So the descriptor does not depend on
/// the signs of the normals, and needs no place of the scanner. Columns are square roots of shares (their dot product
/// is Bhattacharyya's coefficient), scaled to length 1; zero where a point has no normal or no neighbour with one.
///
/// @param cloud     with normals; a zero normal takes the point out
/// @param radius_m  > 0; of the neighbourhood [m]
/// @throws InvalidInput  without normals
/// Cost O(N k), k neighbours each.
Descriptors fpfh(const Cloud& cloud, double radius_m);

}  // namespace tcm_icp
