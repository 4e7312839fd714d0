#include "tcm_icp/evaluation/degradation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "evaluation/edges_and_corners.hpp"
#include "evaluation/occlusion.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

constexpr double kBlurInSpacings = 3;      // an edge's neighbourhood, so that it looks round
constexpr double kIsolatedInSpacings = 5;  // nothing would be called a neighbour that far away

void require_share(const char* field, double value, double most) {
  if (!(value >= 0 && value <= most))
    throw InvalidOptions("degrade: " + std::string(field) + " = " + std::to_string(value) + "; needs 0.." +
                         std::to_string(most));
}

Vector3d normal_offset(double sigma_m, Rng& rng) {
  const double x = standard_normal(rng);
  const double y = standard_normal(rng);
  const double z = standard_normal(rng);
  return sigma_m * Vector3d(x, y, z);
}

class Degrader {
 public:
  Degrader(const Points& points, const DegradationOptions& options, std::uint64_t seed, std::string_view name,
           int num_threads)
      : options_(options), seed_(seed), name_(name), threads_(num_threads) {
    cloud_.points = points;
    cloud_.source.resize(points.size());
    std::iota(cloud_.source.begin(), cloud_.source.end(), 0U);
    spacing_m_ = median_spacing(points, NeighborIndex(points));
  }

  DegradedCloud run() {
    if (options_.occlusion_share > 0) occlude();
    if (options_.removal_share > 0) remove();
    if (options_.noise_share > 0) add_noise();
    if (options_.blur_share > 0) blur();
    if (options_.isolated_share > 0) add_isolated();
    return std::move(cloud_);
  }

 private:
  Points& points() { return cloud_.points; }
  std::size_t count(double share) const {
    return static_cast<std::size_t>(std::llround(share * static_cast<double>(cloud_.points.size())));
  }
  Rng stream(const char* kind) const { return make_stream(seed_, std::string("degrade ") + kind, name_); }

  void tell(const char* kind, double share, std::size_t before, std::size_t changed, double length_m) {
    cloud_.steps.push_back({kind, share, before, cloud_.points.size(), changed, length_m});
  }

  double spacing_m(const char* what) const {
    if (spacing_m_ > 0) return spacing_m_;
    throw InvalidInput(std::string("degrade: most points lie twice in one place, so that ") + what +
                       " has no length; remove the doubles" +
                       (std::string(what) == "noise" ? ", or give --sigma" : ""));
  }

  void keep_only(const std::vector<bool>& is_kept) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < is_kept.size(); ++i) {
      if (!is_kept[i]) continue;
      cloud_.points[to] = cloud_.points[i];
      cloud_.source[to++] = cloud_.source[i];
    }
    cloud_.points.resize(to);
    cloud_.source.resize(to);
  }

  void add(const Vector3d& p) {
    cloud_.points.push_back(p);
    cloud_.source.push_back(DegradedCloud::kAdded);
  }

  void occlude() {
    Rng rng = stream("occlusion");
    const std::size_t before = points().size(), hidden = count(options_.occlusion_share);
    keep_only(visible_points(points(), hidden, rng));
    tell("occlusion", options_.occlusion_share, before, hidden, 0);
  }

  void remove() {
    Rng rng = stream("removal");
    const std::size_t before = points().size(), removed = count(options_.removal_share);
    std::vector<bool> is_kept(before, true);
    for (const std::size_t i : sample_indices(rng, before, removed)) is_kept[i] = false;
    keep_only(is_kept);
    tell("removal", options_.removal_share, before, removed, 0);
  }

  void add_noise() {
    Rng rng = stream("noise");
    const double sigma = options_.sigma_m > 0 ? options_.sigma_m : spacing_m("noise");
    const std::size_t moved = count(options_.noise_share);
    for (const std::size_t i : sample_indices(rng, points().size(), moved)) points()[i] += normal_offset(sigma, rng);
    tell("noise", options_.noise_share, points().size(), moved, sigma);
  }

  void blur() {
    Rng rng = stream("blur");
    const double sigma = kBlurInSpacings * spacing_m("blurring");
    const Points features = edges_and_corners(points(), threads_);
    const std::size_t before = points().size(), added = count(options_.blur_share);
    for (std::size_t i = 0; i < added; ++i) {
      const Vector3d& feature = features[uniform_index(rng, features.size())];
      add(feature + normal_offset(sigma, rng));
    }
    tell("blur", options_.blur_share, before, added, sigma);
  }

  void add_isolated() {
    constexpr int kAttempts = 100;
    Rng rng = stream("isolated");
    const double away = kIsolatedInSpacings * spacing_m("isolation");
    const std::size_t before = points().size(), wanted = count(options_.isolated_share);
    const NeighborIndex index(points());
    Eigen::AlignedBox3d box;
    for (const auto& p : points()) box.extend(p);
    for (std::size_t i = 0; i < wanted; ++i) {
      for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const double x = uniform01(rng);
        const double y = uniform01(rng);
        const double z = uniform01(rng);
        const Vector3d p = box.min() + Vector3d(x, y, z).cwiseProduct(box.sizes());
        if (index.any_within(p, away)) continue;
        add(p);
        break;
      }
    }
    tell("isolated", options_.isolated_share, before, points().size() - before, away);
  }

  const DegradationOptions& options_;
  const std::uint64_t seed_;
  const std::string_view name_;
  const int threads_;
  double spacing_m_ = 0;
  DegradedCloud cloud_;
};

}  // namespace

void DegradationOptions::validate() const {
  require_share("occlusion_share", occlusion_share, 0.95);
  require_share("removal_share", removal_share, 0.99);
  require_share("noise_share", noise_share, 1);
  require_share("blur_share", blur_share, 1);
  require_share("isolated_share", isolated_share, 1);
  if (!(sigma_m >= 0 && std::isfinite(sigma_m)))
    throw InvalidOptions("degrade: sigma_m = " + std::to_string(sigma_m) + "; needs >= 0");
  if (occlusion_share + removal_share + noise_share + blur_share + isolated_share == 0)
    throw InvalidOptions(
        "degrade: nothing to do; give at least one of --noise, --isolated, --occlusion, --remove, --blur");
}

DegradedCloud degrade(const Points& points, const DegradationOptions& options, std::uint64_t seed,
                      std::string_view name, int num_threads) {
  options.validate();
  if (points.size() < 3)
    throw InvalidInput("degrade: " + std::to_string(points.size()) + " finite points; needs at least 3");
  if (points.size() >= DegradedCloud::kAdded) throw InvalidInput("degrade: more than 2^32 - 2 points");
  return Degrader(points, options, seed, name, num_threads).run();
}

}  // namespace tcm_icp
