#include "links/measure_link.hpp"

#include "links/verification_at.hpp"
#include "scans/scan_sight.hpp"
#include "tcm_icp/coarse/slide_axes.hpp"
#include "tcm_icp/core/even_sample.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kPoints = 1500, kPointsOfSlide = 750;
constexpr double kTrialSlides[] = {8, 16};  // [coarse voxels]

AlignmentEvidence one_way(const PreparedScan& target, const PreparedScan& source, const Eigen::Isometry3d& T,
                          bool with_slides) {
  VerificationOptions options = verification_at(target.pyramid.level(0).voxel_size_m);
  options.with_slides = with_slides;
  return verify_alignment(even_sample(source.verification_sample, kPoints), target.pyramid.level(0), T, options);
}

// A pose that free space holds along a corridor is at the right place of it: at others as much is seen through walls as
// at these. Where two scans hardly overlap they see through one another's walls as soon as they come nearer, but not
// when they part.
FreeSpaceEvidence slid_space(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b) {
  if (!a.sight.sees_space() && !b.sight.sees_space()) return {};
  const SightedScan target{a.pyramid.level(0), a.sight}, source{b.pyramid.level(0), b.sight};
  const Eigen::Vector3d axis =
      slide_axes(a.verification_sample.normals, b.verification_sample.normals, T_a_b.linear()).col(0);
  FreeSpaceEvidence ways[2];
  for (int way = 0; way < 2; ++way) {
    for (const double voxels : kTrialSlides) {
      const Eigen::Translation3d slide((way == 0 ? voxels : -voxels) * target.surfaces.voxel_size_m * axis);
      ways[way] += measure_violations(target, source, slide * T_a_b, kPointsOfSlide);
    }
  }
  return ways[0].violation_share() <= ways[1].violation_share() ? ways[0] : ways[1];
}

}  // namespace

LinkMeasurements measure_link(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b) {
  const Eigen::Isometry3d T_b_a = T_a_b.inverse();
  const AlignmentEvidence b_in_a = one_way(a, b, T_a_b, false), a_in_b = one_way(b, a, T_b_a, false);
  const bool first = b_in_a.overlap >= a_in_b.overlap;
  const AlignmentEvidence& other = first ? a_in_b : b_in_a;
  return {first ? one_way(a, b, T_a_b, true) : one_way(b, a, T_b_a, true),
          other.overlap,
          other.inlier_share,
          free_space(a, b, T_a_b),
          slid_space(a, b, T_a_b),
          a.sight.sees_space() && b.sight.sees_space()};
}

}  // namespace tcm_icp
