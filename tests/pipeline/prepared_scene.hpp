#pragma once
// A synthetic scene as the pipeline's inner stages see it, without files.

#include <optional>
#include <string>
#include <vector>

#include "scans/prepared_scan.hpp"
#include "support/synthetic_scene.hpp"

namespace tcm_icp::testing {

struct PreparedScene {
  SyntheticScene scene;
  Resolutions resolutions;
  std::vector<PreparedScan> scans;
};

inline SampledScan sampled(const Cloud& cloud, const std::string& file) {
  SampledScan out;
  out.scan.file = file;
  out.scan.cloud = cloud;
  out.is_surface.assign(cloud.normals.size(), 1);
  return out;
}

inline PreparedScene prepared_scene(const SyntheticSceneOptions& options, Rng& rng) {
  PreparedScene out{synthetic_scene(options, rng), {}, {}};
  std::vector<SampledScan> scans;
  for (std::size_t i = 0; i < out.scene.scans.size(); ++i) {
    scans.push_back(sampled(out.scene.scans[i], std::to_string(i) + ".ply"));
  }
  out.resolutions = choose_resolutions(scans, {}, 1);
  for (const auto& scan : scans) out.scans.push_back(prepare_scan(scan, out.resolutions, {}, 42));
  return out;
}

}  // namespace tcm_icp::testing
