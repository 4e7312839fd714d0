#pragma once
// Pictures of clouds, without a graphics card.

#include <cstddef>
#include <filesystem>

#include "tcm_icp/core/run_context.hpp"

namespace tcm_icp {

enum class RenderView { kTop, kOblique, kBoth };

struct RenderOptions {
  RenderView view = RenderView::kBoth;
  int width = 1600, height = 800;      ///< [pixels] 16..8000
  std::size_t max_points = 2'000'000;  ///< >= 1; drawn, evenly over all there are
  void validate() const;               ///< throws InvalidOptions
};

/// Draws a merged cloud, each scan in the colour that reports give it, from above (y up), obliquely from the
/// south-west, or both side by side, as PNG.
/// @param cloud  folder of a result, which has one registered.*; or a file of points. Scans are told by the property
///               "scan", or as those of one file
/// @throws InputError, OutputError, InvalidOptions, Cancelled
void render_cloud(const std::filesystem::path& cloud, const std::filesystem::path& picture,
                  const RenderOptions& options, const RunContext& context);

}  // namespace tcm_icp
