#include <pcl/features/fpfh.h>
#include <pcl/registration/sample_consensus_prerejective.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "pair_set.hpp"
#include "pcl_icp.hpp"
#include "pcl_methods.hpp"
#include "pcl_surface.hpp"
#include "tcm_icp/baselines/principal_axes.hpp"
#include "tcm_icp/baselines/spanning_tree.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {
namespace {

using Search = PclSearch<pcl::PointNormal>;
using PclFeatures = pcl::PointCloud<pcl::FPFHSignature33>;

// Voxels for the features in point spacings, coarse ones first, as far as they leave a scan so many points.
constexpr double kMultiples[] = {32, 16, 8, 4};
constexpr std::size_t kLeastPoints = 1000, kMostPoints = 10'000;
constexpr double kConsensusReach = 2.5;  // voxels
constexpr int kConsensusIterations = 50'000, kIcpIterations = 50;
constexpr int kSamples = 3, kCandidates = 5;  // points of a sample, and features like each of them

/// Points in units of the voxel, each with its normal and features.
struct Described {
  PclSurface surface;
  PclFeatures::Ptr features = pcl::make_shared<PclFeatures>();
};

Described describe(const Points& scan, double voxel_m) {
  Described out{pcl_surface_of(*to_pcl(scan, voxel_m), 2)};
  pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> features;
  features.setInputCloud(out.surface.points);
  features.setInputNormals(out.surface.points);
  features.setSearchMethod(pcl::make_shared<Search>(out.surface.index));
  features.setRadiusSearch(5);
  features.compute(*out.features);
  return out;
}

/// False where no pose was found. Lengths are in voxels.
bool find_consensus(const Described& source, const Described& target, double voxel_m, PairFit& fit) {
  // PCL reads past the end of clouds with fewer points than a sample, or than a feature's candidates.
  constexpr auto kLeast = static_cast<std::size_t>(std::max(kSamples, kCandidates));
  if (std::min(source.features->size(), target.features->size()) < kLeast) return false;
  pcl::SampleConsensusPrerejective<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> consensus;
  consensus.setInputSource(source.surface.points);
  consensus.setSourceFeatures(source.features);
  consensus.setInputTarget(target.surface.points);
  consensus.setTargetFeatures(target.features);
  consensus.setMaximumIterations(kConsensusIterations);
  consensus.setNumberOfSamples(kSamples);
  consensus.setCorrespondenceRandomness(kCandidates);
  consensus.setSimilarityThreshold(0.9F);
  consensus.setMaxCorrespondenceDistance(kConsensusReach);
  consensus.setSearchMethodTarget(pcl::make_shared<Search>(target.surface.index, kConsensusReach), true);
  consensus.setInlierFraction(0.1F);  // the tutorial's 0.25 is for an object that is wholly in the scene
  pcl::PointCloud<pcl::PointNormal> moved;
  consensus.align(moved);
  fit.ransac_iterations = kConsensusIterations;  // PCL's loop has no other end
  if (consensus.hasConverged()) fit.T_target_source = from_pcl(consensus.getFinalTransformation(), voxel_m);
  return consensus.hasConverged();
}

std::vector<Points> sampled(const std::vector<Points>& scans, double voxel_m) {
  std::vector<Points> out;
  for (const auto& points : scans) out.push_back(voxel_downsample({points, {}}, voxel_m).points);
  return out;
}

/// Where no multiple leaves a sensible number of points: the one that comes nearest to 4,000.
std::vector<double> voxels_to_try(const PairInput& input) {
  std::vector<double> fitting;
  double best_m = 0, least = std::numeric_limits<double>::infinity();
  for (const double multiple : kMultiples) {
    const double voxel_m = multiple * input.spacing_m;
    std::vector<std::size_t> counts;
    for (const auto& points : input.scans) counts.push_back(count_voxels(points, voxel_m));
    std::sort(counts.begin(), counts.end());
    const std::size_t count = counts[counts.size() / 2];
    if (count >= kLeastPoints && count <= kMostPoints) fitting.push_back(voxel_m);
    const double distance = std::abs(std::log(static_cast<double>(count) / 4000));
    if (distance < least) best_m = voxel_m, least = distance;
  }
  return fitting.empty() ? std::vector{best_m} : fitting;
}

/// All pairs with one size of voxel, the tree's polished on the finer points that all sizes share.
PairFits fit_at(double voxel_m, const PairInput& input, const PairSet& fine, const RunContext& context) {
  const std::vector<Points> scans = sampled(input.scans, voxel_m);
  const PairSet set(scans, voxel_m);
  std::vector<Described> described;
  for (const auto& points : scans) described.push_back(describe(points, voxel_m));
  PairFits out;
  out.feature_voxel_m = voxel_m;
  for_each_pair(set, context, [&](PairFit& fit) {
    const bool found = find_consensus(described[fit.source], described[fit.target], voxel_m, fit);
    if (!found) {
      // The pair must have some pose to be merged at: the coarse start of ICP.
      fit.T_target_source =
          coarse_alignment_by_axes(set.points(fit.target), set.index(fit.target), set.points(fit.source));
    }
    icp_stage(set.in_voxels(fit.source).cloud, set.in_voxels(fit.target), voxel_m, {kPartnerVoxels, kIcpIterations},
              fit);
    fit.converged = fit.converged && found;
    set.measure(fit);
    if (!found) fit.share = 0;  // taken only where nothing else holds a scan
    out.pairs.push_back(fit);
  });
  for (const std::size_t k : maximum_spanning_tree(set.size(), out.pairs)) {
    PairFit& fit = out.pairs[k];
    const bool found = fit.share > 0;
    for (const double reach : {voxel_m / fine.voxel_size_m(), kIcpReachVoxels, kPartnerVoxels}) {
      const IcpStage stage{reach, kIcpIterations};
      icp_stage(fine.in_voxels(fit.source).cloud, fine.in_voxels(fit.target), fine.voxel_size_m(), stage, fit);
    }
    fit.converged = fit.converged && found;
  }
  return out;
}

/// Mean share of the tree's pairs at the resolution all sizes share.
double rating(const PairFits& fits, const PairSet& fine) {
  double sum = 0;
  const auto tree = maximum_spanning_tree(fine.size(), fits.pairs);
  for (const std::size_t k : tree) {
    PairFit fit = fits.pairs[k];
    const bool found = fit.share > 0;
    fine.measure(fit);
    if (found) sum += fit.share / static_cast<double>(tree.size());
  }
  return sum;
}

}  // namespace

PairFits features_pairs(const PairInput& input, const RunContext& context) {
  for (const auto& T : input.T_init) {
    if (T) throw InvalidOptions("--method features finds its poses by itself; leave --init out, or use --method icp");
  }
  std::srand(static_cast<unsigned>(context.seed));
  const PairSet fine(input.scans, input.voxel_size_m);
  std::optional<PairFits> best;
  double best_rating = 0;
  for (const double voxel_m : voxels_to_try(input)) {
    PairFits fits = fit_at(voxel_m, input, fine, context);
    const double mine = rating(fits, fine);
    context.debug("features at voxels of " + std::to_string(voxel_m) + ": mean share " + std::to_string(mine));
    if (best && mine <= best_rating) continue;
    best = std::move(fits);
    best_rating = mine;
  }
  return std::move(*best);
}

}  // namespace tcm_icp
