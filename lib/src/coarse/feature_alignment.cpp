#include "tcm_icp/coarse/feature_alignment.hpp"

#include <algorithm>
#include <string>

#include "core/pick.hpp"
#include "feature_hypotheses.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/place_sampling.hpp"
#include "tcm_icp/registration/normal_space_sampling.hpp"

namespace tcm_icp {

void FeatureAlignmentOptions::validate() const {
  features.validate();
  const auto at_least = [](double value, double bound, const char* name) {
    if (!(value >= bound)) {
      throw InvalidOptions(std::string(name) + " must be at least " + std::to_string(bound) + ", not " +
                           std::to_string(value));
    }
  };
  const auto positive = [](double value, const char* name) {
    if (!(value > 0)) throw InvalidOptions(std::string(name) + " must be above 0, not " + std::to_string(value));
  };
  if (levels.empty()) throw InvalidOptions("levels must name at least one level");
  positive(tolerance_voxels, "tolerance_voxels");
  at_least(min_length_voxels, 0, "min_length_voxels");
  positive(max_normal_cosine_difference, "max_normal_cosine_difference");
  at_least(max_hypotheses, 1, "max_hypotheses");
  at_least(max_candidates, 1, "max_candidates");
  at_least(check_points, 1, "check_points");
}

DescribedScan describe_scan(const ScanPyramid& pyramid, const FeatureAlignmentOptions& options, Rng& rng) {
  options.validate();
  DescribedScan out;
  for (const std::size_t l : options.levels) {
    if (l >= pyramid.num_levels()) {
      throw InvalidOptions("level " + std::to_string(l) + " is not in a pyramid of " +
                           std::to_string(pyramid.num_levels()) + " levels");
    }
    out.levels.push_back(find_features(pyramid.level(l), options.features));
  }
  const auto& [voxel_size_m, cloud, index] = pyramid.level(0);
  const auto priorities = place_priorities(cloud.points, voxel_size_m, rng);
  const auto count = static_cast<std::size_t>(options.check_points);
  out.check_sample = pick(cloud, normal_space_sample(cloud, count, priorities));
  return out;
}

std::vector<PoseCandidate> align_by_features(const FeatureView& target, const FeatureView& source,
                                             const FeatureAlignmentOptions& options) {
  options.validate();
  const auto hypotheses = feature_hypotheses(target, source, options);
  std::vector<PoseCandidate> out;
  for (std::size_t k = 0; k < hypotheses.size() && k < static_cast<std::size_t>(options.max_candidates); ++k) {
    // Where there is no other pose, a single match could always make one.
    const double other = hypotheses.size() > 1 ? hypotheses[k == 0 ? 1 : 0].score() : 1;
    const double score = hypotheses[k].score();
    out.push_back({hypotheses[k].T_target_source, CoarseMethod::kFeatures, score, score / std::max(other, 1.0)});
  }
  return out;
}

}  // namespace tcm_icp
