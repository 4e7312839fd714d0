#include "links/measure_link.hpp"

#include "links/verification_at.hpp"
#include "scans/scan_sight.hpp"
#include "tcm_icp/core/even_sample.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kPoints = 1500;

AlignmentEvidence one_way(const PreparedScan& target, const PreparedScan& source, const Eigen::Isometry3d& T,
                          bool with_slides) {
  VerificationOptions options = verification_at(target.pyramid.level(0).voxel_size_m);
  options.with_slides = with_slides;
  return verify_alignment(even_sample(source.held_out_sample, kPoints), target.pyramid.level(0), T, options);
}

}  // namespace

LinkMeasurements measure_link(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b) {
  const Eigen::Isometry3d T_b_a = T_a_b.inverse();
  const AlignmentEvidence b_in_a = one_way(a, b, T_a_b, false), a_in_b = one_way(b, a, T_b_a, false);
  const bool first = b_in_a.overlap >= a_in_b.overlap;
  const AlignmentEvidence& other = first ? a_in_b : b_in_a;
  return {first ? one_way(a, b, T_a_b, true) : one_way(b, a, T_b_a, true), other.overlap, other.inlier_share,
          free_space(a, b, T_a_b), a.sight.sees_space() && b.sight.sees_space()};
}

}  // namespace tcm_icp
