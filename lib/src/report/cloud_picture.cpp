#include "report/cloud_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "tcm_icp/io/scan_colour.hpp"

namespace tcm_icp {
namespace {

constexpr Rgb kPaper{244, 246, 248};
constexpr std::array<std::pair<int, int>, 4> kAround{{{2, 0}, {-2, 0}, {0, 2}, {0, -2}}};  // [pixels]
constexpr float kFar = std::numeric_limits<float>::infinity();

struct Projection {
  Eigen::Matrix3f axes;  // rows: right, up, towards the viewer
  Eigen::Vector3f centre;
  float pixels_by_m = 1;
};

Eigen::Matrix3f axes_of(PictureView view) {
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();
  if (view == PictureView::kTop) return axes;
  const Eigen::Vector3f towards = Eigen::Vector3f(-0.55F, -0.75F, 0.62F).normalized();
  const Eigen::Vector3f right = Eigen::Vector3f::UnitZ().cross(towards).normalized();
  axes.row(0) = right;
  axes.row(1) = towards.cross(right);
  axes.row(2) = towards;
  return axes;
}

Projection project(const Eigen::AlignedBox3d& box, PictureView view, int width, int height) {
  constexpr double kFilled = 0.94;
  Projection out{axes_of(view), box.center().cast<float>(), 1};
  Eigen::Vector3f most = Eigen::Vector3f::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3f p = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).cast<float>();
    most = most.cwiseMax((out.axes * (p - out.centre)).cwiseAbs());
  }
  const double by_width = kFilled * width / 2 / std::max(1e-9, static_cast<double>(most.x())),
               by_height = kFilled * height / 2 / std::max(1e-9, static_cast<double>(most.y()));
  out.pixels_by_m = static_cast<float>(std::min(by_width, by_height));
  return out;
}

// Darkens a pixel by how far behind its neighbours it lies.
void shade(const std::vector<float>& depth, float reach, Image& image) {
  const int w = image.width, h = image.height;
  const auto at = [&](int x, int y) { return depth[static_cast<std::size_t>(y * w + x)]; };
  const float strength = 60 / reach;
  Image shaded = image;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const float here = at(x, y);
      if (here == kFar) continue;
      float sum = 0;
      for (const auto& [dx, dy] : kAround) {
        const int nx = std::clamp(x + dx, 0, w - 1), ny = std::clamp(y + dy, 0, h - 1);
        const float there = at(nx, ny);
        if (there != kFar) sum += std::min(0.25F, std::max(0.0F, strength * (here - there) / 4));
      }
      const float light = std::exp(-1.1F * sum);
      for (std::size_t c = 0; c < 3; ++c) {
        shaded.at(x, y)[c] = static_cast<std::uint8_t>(static_cast<float>(image.at(x, y)[c]) * light);
      }
    }
  }
  image = std::move(shaded);
}

}  // namespace

std::vector<PicturePoint> picture_points(const Scene& scene) {
  std::vector<PicturePoint> out;
  out.reserve(scene.num_points());
  const double low = scene.registered().box.min().z(), size = std::max(1e-9, scene.registered().box.sizes().z());
  for (std::size_t i = 0; i < scene.scans.size(); ++i) {
    const SceneScan& scan = scene.scans[i];
    if (scan.group != 0) continue;
    const Eigen::Isometry3f T = scan.T_view_scan.cast<float>();
    const auto colour = scan_colour(i);
    for (const auto& point : scan.points) {
      const Eigen::Vector3f p = T * point;
      const double height = std::clamp((static_cast<double>(p.z()) - low) / size, 0.0, 1.0);
      const double light = 0.72 + 0.38 * height;
      Rgb c{};
      for (std::size_t k = 0; k < 3; ++k) c[k] = static_cast<std::uint8_t>(std::min(255.0, light * colour[k]));
      out.push_back({p, c});
    }
  }
  return out;
}

Image draw_cloud(const std::vector<PicturePoint>& points, const Eigen::AlignedBox3d& box, PictureView view, int width,
                 int height) {
  Image image(width, height, kPaper);
  if (points.empty()) return image;
  const Projection to = project(box, view, width, height);
  std::vector<float> depth(image.pixels.size(), kFar);
  // So large that what is covered evenly looks closed.
  const int size = std::clamp(static_cast<int>(std::lround(0.9 * std::sqrt(static_cast<double>(width) * height /
                                                                           static_cast<double>(points.size())))),
                              1, 4);
  for (const auto& point : points) {
    const Eigen::Vector3f p = to.axes * (point.at - to.centre);
    const int x0 = static_cast<int>(std::floor(static_cast<float>(width) / 2 + to.pixels_by_m * p.x())) - size / 2;
    const int y0 = static_cast<int>(std::floor(static_cast<float>(height) / 2 - to.pixels_by_m * p.y())) - size / 2;
    if (x0 < 0 || y0 < 0 || x0 + size > width || y0 + size > height) continue;
    for (int y = y0; y < y0 + size; ++y) {
      for (int x = x0; x < x0 + size; ++x) {
        float& nearest = depth[static_cast<std::size_t>(y * width + x)];
        if (-p.z() >= nearest) continue;
        nearest = -p.z();
        image.at(x, y) = point.colour;
      }
    }
  }
  shade(depth, static_cast<float>(box.sizes().norm()), image);
  return image;
}

Image draw_preview(const std::vector<PicturePoint>& points, const Eigen::AlignedBox3d& box, int width, int height) {
  const int half = width / 2;
  const Image top = draw_cloud(points, box, PictureView::kTop, half, height),
              oblique = draw_cloud(points, box, PictureView::kOblique, width - half, height);
  Image out(width, height, kPaper);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) out.at(x, y) = x < half ? top.at(x, y) : oblique.at(x - half, y);
  }
  return out;
}

}  // namespace tcm_icp
