#pragma once
// Points drawn without a graphics card.

#include <Eigen/Geometry>
#include <vector>

#include "report/png.hpp"
#include "report/scene.hpp"

namespace tcm_icp {

struct PicturePoint {
  Eigen::Vector3f at;
  Rgb colour;
};

/// Registered points of a scene in the view frame, each scan in its colour, higher ones lighter.
std::vector<PicturePoint> picture_points(const Scene& scene);

enum class PictureView { kTop, kOblique };

/// Parallel projection of the box, as large as the picture has room for: from above, y of the frame up, or obliquely
/// from the south-west. Nearer points hide others; edges of depth are darkened (eye-dome lighting: Boucheny, 2009).
Image draw_cloud(const std::vector<PicturePoint>& points, const Eigen::AlignedBox3d& box, PictureView view, int width,
                 int height);

/// Top view and oblique view side by side.
Image draw_preview(const std::vector<PicturePoint>& points, const Eigen::AlignedBox3d& box, int width, int height);

}  // namespace tcm_icp
