#include "tcm_icp/pipeline/cloud_render.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/scalar.hpp"
#include "report/cloud_picture.hpp"
#include "report/scene.hpp"
#include "report/scene_sample.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

namespace fs = std::filesystem;

fs::path cloud_of(const fs::path& path) {
  if (!fs::is_directory(path)) return path;
  for (const char* const name :
       {"registered.ply", "registered.las", "registered.e57", "registered.pcd", "registered.xyz"}) {
    if (fs::exists(path / name)) return path / name;
  }
  throw InputError(path, "", "the folder has no merged cloud", "name a folder that tcm-icp register wrote, or a file");
}

// Where the attribute that tells scans apart stands.
struct ScanColumn {
  std::size_t offset = 0;
  ScalarType type = ScalarType::kUInt16;
};

std::optional<ScanColumn> scan_column(const std::vector<Attribute>& attributes) {
  std::size_t offset = 0;
  for (const Attribute& attribute : attributes) {
    if (attribute.name == "scan") return ScanColumn{offset, attribute.type};
    offset += scalar_size(attribute.type);
  }
  return std::nullopt;
}

class CloudSampler {
 public:
  CloudSampler(const fs::path& cloud, const RunContext& context)
      : context_(context), paths_(scans_in(cloud_of(cloud))) {}

  Scene sample(std::size_t max_points) {
    std::map<std::size_t, std::uint64_t> counts;
    stream([&](std::size_t scan, const Eigen::Vector3d& p) {
      if (counts.empty()) origin_ = p;
      ++counts[scan];
    });
    std::vector<std::uint64_t> num_points(counts.empty() ? 0 : counts.rbegin()->first + 1, 0);
    for (const auto& [scan, n] : counts) num_points[scan] = n;
    SceneSampler sampler(num_points, max_points);
    stream([&](std::size_t scan, const Eigen::Vector3d& p) { sampler.add(scan, {&p, 1}, origin_); });
    // All of a cloud's scans share one frame, so points are evened over cells of one size.
    ScenePoints points = sampler.take(std::vector<double>(num_points.size(), cell_m(sampler)), context_.num_threads);
    Scene scene;
    scene.groups.front().origin = origin_;
    for (auto& of_scan : points) {
      scene.scans.emplace_back();
      scene.scans.back().points = std::move(of_scan);
    }
    scene.groups.front().box = box_without_stray_points(scene);
    return scene;
  }

 private:
  static double cell_m(const SceneSampler& sampler) {
    constexpr double kCellsByExtent = 150;
    return std::max(1e-9, sampler.extent_m() / kCellsByExtent);
  }

  template <typename Use>
  void stream(const Use& use) const {
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      ScanReader reader(paths_[k]);
      const auto column = scan_column(reader.attributes());
      const std::size_t stride = reader.attribute_stride();
      PointBlock block;
      while (reader.read(block)) {
        context_.report("drawing", k, paths_.size());
        for (std::size_t i = 0; i < block.size(); ++i) {
          std::size_t scan = k;
          if (column) scan = scan_at(block.attributes.data() + i * stride + column->offset, column->type);
          use(scan, block.points[i]);
        }
      }
    }
  }

  // Files of others may hold anything there.
  static std::size_t scan_at(const std::byte* bytes, ScalarType type) {
    constexpr double kMost = 65535;
    const double number = load_scalar(bytes, type);
    return number >= 0 && number <= kMost ? static_cast<std::size_t>(number) : 0;
  }

  const RunContext& context_;
  std::vector<fs::path> paths_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

Image draw(const std::vector<PicturePoint>& points, const Eigen::AlignedBox3d& box, const RenderOptions& o) {
  if (o.view == RenderView::kBoth) return draw_preview(points, box, o.width, o.height);
  const PictureView view = o.view == RenderView::kTop ? PictureView::kTop : PictureView::kOblique;
  return draw_cloud(points, box, view, o.width, o.height);
}

}  // namespace

void RenderOptions::validate() const {
  constexpr int kLeast = 16, kMost = 8000;
  if (std::min(width, height) < kLeast || std::max(width, height) > kMost) {
    throw InvalidOptions("size must be 16 to 8000 pixels either way, not " + std::to_string(width) + "x" +
                         std::to_string(height));
  }
  if (max_points == 0) throw InvalidOptions("points must be at least 1, not 0");
}

void render_cloud(const fs::path& cloud, const fs::path& picture, const RenderOptions& options,
                  const RunContext& context) {
  options.validate();
  const Scene scene = CloudSampler(cloud, context).sample(options.max_points);
  if (scene.num_points() == 0) throw InputError(cloud, "", "there are no points to draw", "name another cloud");
  std::ofstream out(picture, std::ios::binary);
  out << png(draw(picture_points(scene), scene.registered().box, options));
  out.close();
  if (!out) throw OutputError(picture, "cannot be written", "check that its folder is there, and the disk not full");
}

}  // namespace tcm_icp
