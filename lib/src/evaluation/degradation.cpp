#include "tcm_icp/evaluation/degradation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/even_sample.hpp"
#include "tcm_icp/core/neighbor_index.hpp"
#include "tcm_icp/core/normals.hpp"

namespace tcm_icp {
namespace {

using Eigen::Vector3d;

constexpr double kBlurInSpacings = 3;      // an edge's neighbourhood, so that it looks round
constexpr double kIsolatedInSpacings = 5;  // nothing would be called a neighbour that far away
constexpr double kFeatureShare = 0.05;
constexpr std::size_t kFeatureSample = 100000;

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

  /// Drops the `number` points with the least keys; of equal ones those that come first.
  void drop_least(const std::vector<double>& keys, std::size_t number) {
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
    std::vector<bool> is_kept(keys.size(), true);
    for (std::size_t i = 0; i < number; ++i) is_kept[order[i]] = false;
    keep_only(is_kept);
  }

  /// Two sectors and two boxes, each as wide as a quarter of what is to be hidden asks for.
  void occlude() {
    constexpr std::size_t kParts = 4;
    Rng rng = stream("occlusion");
    const std::size_t before = points().size(), hidden = count(options_.occlusion_share);
    Vector3d middle = Vector3d::Zero();
    for (const auto& p : points()) middle += p / static_cast<double>(before);
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::size_t number = hidden * (part + 1) / kParts - hidden * part / kParts;
      part % 2 == 0 ? hide_sector(middle, number, rng) : hide_box(number, rng);
    }
    tell("occlusion", options_.occlusion_share, before, hidden, 0);
  }

  void hide_sector(const Vector3d& middle, std::size_t number, Rng& rng) {
    const double begin = 2 * std::numbers::pi * uniform01(rng);
    std::vector<double> keys;
    for (const auto& p : points()) {
      const double angle = std::atan2(p.y() - middle.y(), p.x() - middle.x()) - begin;
      keys.push_back(angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi)));
    }
    drop_least(keys, number);
  }

  void hide_box(std::size_t number, Rng& rng) {
    const Vector3d centre = points()[uniform_index(rng, points().size())];
    std::vector<double> keys;
    for (const auto& p : points()) keys.push_back((p - centre).cwiseAbs().maxCoeff());
    drop_least(keys, number);
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
    const Points features = edges_and_corners();
    const std::size_t before = points().size(), added = count(options_.blur_share);
    for (std::size_t i = 0; i < added; ++i) {
      const Vector3d& feature = features[uniform_index(rng, features.size())];
      add(feature + normal_offset(sigma, rng));
    }
    tell("blur", options_.blur_share, before, added, sigma);
  }

  /// The points about which surfaces vary most.
  Points edges_and_corners() const {
    const Points sample = even_sample(cloud_.points, kFeatureSample);
    const auto estimate = estimate_normals(sample, NeighborIndex(sample), {}, threads_);
    std::vector<std::size_t> order(sample.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return estimate.variation[a] > estimate.variation[b]; });
    order.resize(std::max<std::size_t>(1, static_cast<std::size_t>(kFeatureShare * static_cast<double>(order.size()))));
    Points features;
    for (const std::size_t i : order) features.push_back(sample[i]);
    return features;
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
