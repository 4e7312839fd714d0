#include "links/slides_from_fits.hpp"

#include <algorithm>
#include <utility>

#include "links/pair_steps.hpp"
#include "tcm_icp/coarse/slide_search.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/rigid_transform.hpp"
#include "tcm_icp/visibility/borders.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kSlidesOfPose = 8;  // from one pose
constexpr double kSameSlide = 2;          // [coarse voxels]

SlideMarks slide_marks(const PreparedScan& scan, const Cloud& borders) {
  const Cloud& surfaces = scan.pyramid.level(0).cloud;
  if (!scan.sight.knows_sides()) return {surfaces, borders, NormalSides::kUnknown};
  return {{surfaces.points, scan.sight.facing}, borders, NormalSides::kSeen};
}

// The best voted for of those within a distance of one another, in this order: many poses slide to one.
std::vector<PoseCandidate> distinct(std::vector<PoseCandidate> slides, double distance_m, const PointMoments& moments) {
  std::stable_sort(slides.begin(), slides.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<PoseCandidate> out;
  for (const PoseCandidate& slide : slides) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const PoseCandidate& other) {
      return rms_displacement(other.T_target_source.inverse() * slide.T_target_source, moments) < distance_m;
    });
    if (!known) out.push_back(slide);
  }
  return out;
}

}  // namespace

SlidesFromFits::SlidesFromFits(const std::vector<PreparedScan>& scans, const PairFits& fits, const RunContext& context,
                               const StepStore* store)
    : scans_(scans),
      fits_(fits),
      context_(context),
      store_(store),
      borders_(scans.size()),
      found_borders_(new std::once_flag[scans.size()]) {}

std::vector<std::vector<PoseCandidate>> SlidesFromFits::candidates(const ScanPairs& pairs) {
  std::vector<std::vector<PoseCandidate>> out(pairs.size());
  parallel_for(context_.num_threads, pairs.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [a, b] = pairs[k];
      const std::vector<Eigen::Isometry3d>& from = fits_.poses_of(a, b);
      if (from.empty()) continue;
      out[k] = candidates_once(
          store_, [&, a = a, b = b] { return slide_key(scans_[a], scans_[b], from); },
          [&, a = a, b = b] { return slides(a, b, from); });
    }
  });
  return out;
}

const Cloud& SlidesFromFits::borders_of(std::size_t scan) {
  std::call_once(found_borders_[scan], [&] {
    borders_[scan] = find_borders({scans_[scan].pyramid.level(0), scans_[scan].sight});
  });
  return borders_[scan];
}

std::vector<PoseCandidate> SlidesFromFits::slides(std::size_t a, std::size_t b,
                                                  const std::vector<Eigen::Isometry3d>& poses) {
  const SlideMarks target = slide_marks(scans_[a], borders_of(a)), source = slide_marks(scans_[b], borders_of(b));
  const double voxel_m = scans_[a].pyramid.level(0).voxel_size_m;
  std::vector<PoseCandidate> out;
  for (const Eigen::Isometry3d& T : poses) {
    const auto slid = slide_candidates(target, source, T, voxel_m, kSlidesOfPose);
    out.insert(out.end(), slid.begin(), slid.end());
  }
  return distinct(std::move(out), kSameSlide * voxel_m, scans_[b].moments);
}

}  // namespace tcm_icp
