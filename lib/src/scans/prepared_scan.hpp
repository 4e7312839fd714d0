#pragma once
// A scan as the registration sees it: resolutions common to the set, samples for fits, and samples kept from them.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scans/scan_sampling.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/registration/scan_pyramid.hpp"
#include "tcm_icp/tcm/robust_tcm.hpp"
#include "tcm_icp/visibility/sight.hpp"

namespace tcm_icp {

/// Pairs of scans, a < b, by their places in a set.
using ScanPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Voxel edges common to all scans of a set [m].
struct Resolutions {
  double coarse_m = 0;  ///< scans are placed with
  double fine_m = 0;    ///< and adjusted with
};

/// Holds a cloud's points, and so the means of any of them.
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius_m = 0;

  Ball() = default;
  explicit Ball(const Points& points);
};

struct PreparedScan {
  ScanPyramid pyramid;        ///< from the coarse voxel upwards; surface normals
  PyramidLevel fine;          ///< fine voxel; surface normals
  Cloud coarse_sample;        ///< for coarse programs: every kind of point
  Cloud fit_sample;           ///< for fine programs: surfaces, at the coarse voxel
  Cloud held_out_sample;      ///< surfaces at the coarse voxel; in no fit
  Cloud verification_sample;  ///< the same, and as many more as were asked for, where there are too few of them
  PointMoments moments;       ///< of verification_sample
  Cloud fine_sample;          ///< surfaces at the fine voxel, for the adjustment
  std::string key;            ///< of random numbers: stream_key()
  Ball ball;                  ///< all its points lie in it
  Sight sight{};              ///< none until make_sights(); groups of scans have none
  std::string digest{};       ///< of all that this and the sight depend on; empty without a work folder
};

/// The median over the scans of the voxel edge at which a scan has the wanted number of voxels.
Resolutions choose_resolutions(const std::vector<SampledScan>& scans, const SamplingOptions& options, int num_threads);

PreparedScan prepare_scan(const SampledScan& scan, const Resolutions& resolutions, const SampleSizes& options,
                          std::uint64_t seed);

/// Whether points of the two may lie within `distance_m` of one another at all: what costs nothing to rule out.
bool may_meet(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b, double distance_m);

/// Levels of every pyramid: gates up to 32 coarse voxels are served at a fitting resolution.
constexpr std::size_t kNumPyramidLevels = 4;

}  // namespace tcm_icp
