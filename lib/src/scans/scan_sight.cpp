#include "scans/scan_sight.hpp"

#include <array>

#include "core/memory_budget.hpp"
#include "scans/scan_steps.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {

std::optional<Viewpoint> find_viewpoint_of(const SampledScan& sampled, std::uint64_t seed) {
  const Scan& scan = sampled.scan;
  // Scan lines tell it sharply, where there are any, density nearly so, and both also outdoors, where little hides
  // behind anything.
  if (sampled.clues.by_lines) return sampled.clues.by_lines;
  Rng for_density = make_stream(seed, "point density", stream_key(scan));
  auto by_density = find_viewpoint_by_density(scan.cloud, sampled.clues.densities, for_density);
  if (by_density && by_density->determined()) return by_density;
  Rng rng = make_stream(seed, "viewpoint", stream_key(scan));
  auto by_occlusion = find_viewpoint(scan.cloud, std::array{Eigen::Vector3d(-scan.origin)}, rng);
  const bool occlusion_tells = by_occlusion && by_occlusion->roughly_determined();
  return by_density && by_density->roughly_determined() && !occlusion_tells ? by_density : by_occlusion;
}

std::vector<std::optional<Viewpoint>> find_viewpoints(const std::vector<SampledScan>& scans, const RunContext& context,
                                                      const StepStore* steps) {
  context.report("finding viewpoints", 0, scans.size());
  std::vector<std::optional<Viewpoint>> out(scans.size());
  parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      out[i] = steps != nullptr ? find_viewpoint_once(*steps, scans[i], context.seed)
                                : find_viewpoint_of(scans[i], context.seed);
    }
  });
  return out;
}

void make_sights(const std::vector<std::optional<Viewpoint>>& viewpoints, const RunContext& context,
                 std::vector<PreparedScan>& scans) {
  parallel_for(context.num_threads, scans.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      scans[i].sight =
          in_budget(make_sight(viewpoints[i], scans[i].fine.cloud.points, scans[i].pyramid.level(0).cloud));
    }
  });
}

FreeSpaceEvidence free_space(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b) {
  return measure_free_space({a.pyramid.level(0), a.sight}, {b.pyramid.level(0), b.sight}, T_a_b);
}

FreeSpaceEvidence violations(const PreparedScan& a, const PreparedScan& b, const Eigen::Isometry3d& T_a_b) {
  return measure_violations({a.pyramid.level(0), a.sight}, {b.pyramid.level(0), b.sight}, T_a_b);
}

}  // namespace tcm_icp
