#include "report/residual_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace tcm_icp {
namespace {

constexpr double kThreeSigma = 3 * 1.4826;  // medians of the absolute value
constexpr std::size_t kClasses = 31;        // odd: the middle one is about 0

// Reorders the values.
double percentile(std::vector<float>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

void append(const LinkRecord& link, std::vector<float>& to) {
  for (const LinkResidual& match : link.residuals.matches) to.push_back(match.distance_m);
}

}  // namespace

std::optional<ResidualStatistics> residual_statistics(std::vector<float> distances_m, double limit_m, double most_m) {
  if (distances_m.empty()) return std::nullopt;
  ResidualStatistics out;
  out.num = distances_m.size();
  out.class_m = 2 * most_m / static_cast<double>(kClasses);
  out.counts.assign(kClasses, 0);
  const double n = static_cast<double>(out.num);
  double sum = 0, squares = 0;
  for (float& distance : distances_m) {
    const auto d = static_cast<double>(distance);
    sum += d;
    squares += d * d;
    const double at = std::clamp(std::floor((d + most_m) / out.class_m), 0.0, static_cast<double>(kClasses - 1));
    ++out.counts[static_cast<std::size_t>(at)];
    distance = std::abs(distance);
  }
  out.mean_m = sum / n;
  out.rms_all_m = std::sqrt(squares / n);
  out.median_m = percentile(distances_m, 0.5);
  out.p95_m = percentile(distances_m, 0.95);
  double squares_within = 0, num_within = 0;
  for (const float distance : distances_m) {
    const auto d = static_cast<double>(distance);
    if (d > kThreeSigma * out.median_m) continue;
    squares_within += d * d;
    ++num_within;
  }
  out.rms_m = std::sqrt(squares_within / num_within);
  if (limit_m > 0) {
    const auto within = std::count_if(distances_m.begin(), distances_m.end(),
                                      [&](float d) { return static_cast<double>(d) <= limit_m; });
    out.share_accepted = static_cast<double>(within) / n;
  }
  return out;
}

Json to_json(const std::optional<ResidualStatistics>& s) {
  if (!s) return nullptr;
  return {{"points", s->num},
          {"rms_m", s->rms_m},
          {"rms_all_m", s->rms_all_m},
          {"median_m", s->median_m},
          {"p95_m", s->p95_m},
          {"mean_m", s->mean_m},
          {"share_within_limit", s->share_accepted ? Json(*s->share_accepted) : Json(nullptr)},
          {"histogram", {{"class_m", s->class_m}, {"counts", s->counts}}}};
}

ResidualsOfRun residuals_of(const PipelineResult& result, double limit_m) {
  // As far as the noise reaches: what lies beyond is counted at the ends.
  const double most_m = result.uncertainty.noise_m > 0 ? 4 * result.uncertainty.noise_m : 2 * result.fine_voxel_m;
  ResidualsOfRun out;
  std::vector<std::vector<float>> of_scan(result.scans.size());
  std::vector<float> all;
  for (const LinkRecord& link : result.links) {
    std::vector<float> distances;
    append(link, distances);
    if (link.verdict != Verdict::kRejected) {
      append(link, of_scan[link.a]);
      append(link, of_scan[link.b]);
      if (!result.has_frame_of_its_own(link.a)) append(link, all);
    }
    out.links.push_back(residual_statistics(std::move(distances), limit_m, most_m));
  }
  for (auto& distances : of_scan) out.scans.push_back(residual_statistics(std::move(distances), limit_m, most_m));
  out.all = residual_statistics(std::move(all), limit_m, most_m);
  return out;
}

}  // namespace tcm_icp
