#include "density_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

using Unknowns = Eigen::Matrix<double, 5, 1>;  // place, log_step, log_thinned
using Information = Eigen::Matrix<double, 5, 5>;

constexpr double kLossScale = 0.3;         // of log areas: edges, plants and passers-by are beyond
constexpr double kLeastCosine = 0.03;      // of incidence
constexpr double kLeastAcross = 0.1;       // cosine of elevation: the pole
constexpr double kThinnedQuantile = 0.05;  // of areas
constexpr int kMaxSteps = 40;
constexpr double kFirstDamping = 1e-3, kMostDamping = 1e6;
constexpr double kLeastGain = 1e-6;  // of the loss

struct Term {
  double value;
  Unknowns slope;
};

// The larger of a spacing and the least one, smoothly: (a^4 + v^4)^(1/4). All is in fourth powers, which take no
// logarithm and no exponential each.
class AreaModel {
 public:
  explicit AreaModel(const DensityModel& model)
      : model_(model), step_(std::exp(4 * model.log_step)), thinned_(std::exp(4 * model.log_thinned)) {}

  double log_area(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    return log_area_of(parts(point, normal));
  }

  Term with_slope(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    const Parts p = parts(point, normal);
    const double around_share = p.around / (p.around + thinned_), falling_share = p.falling / (p.falling + thinned_);
    Eigen::Vector3d around_slope = -p.ray / p.square, falling_slope = around_slope;  // of the logarithm of the range
    if (p.cosine2 > kLeastCosine * kLeastCosine) falling_slope += normal / p.along - p.ray / p.square;
    if (p.across2 > kLeastAcross * kLeastAcross && model_.axis) {
      const double up = model_.axis->dot(p.ray);
      around_slope += up * (*model_.axis - up / p.square * p.ray) / (p.square * p.across2);
    }
    Term term{log_area_of(p), {}};
    term.slope << around_share * around_slope + falling_share * falling_slope, around_share + falling_share,
        2 - around_share - falling_share;
    return term;
  }

 private:
  struct Parts {
    Eigen::Vector3d ray;
    double square, along;  // of the ray, and its share along the normal
    double cosine2, across2;
    double around, falling;  // spacings to the fourth
  };

  Parts parts(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    Parts p;
    p.ray = point - model_.place;
    p.square = std::max(p.ray.squaredNorm(), 1e-18);
    p.along = normal.dot(p.ray);
    p.cosine2 = p.along * p.along / p.square;
    p.across2 = 1;
    if (model_.axis) {
      const double up = model_.axis->dot(p.ray);
      p.across2 = 1 - up * up / p.square;
    }
    const double cosine2 = std::max(p.cosine2, kLeastCosine * kLeastCosine);
    const double across2 = std::max(p.across2, kLeastAcross * kLeastAcross);
    const double even = step_ * p.square * p.square;
    p.around = even * across2 * across2;
    p.falling = even / (cosine2 * cosine2);
    return p;
  }

  double log_area_of(const Parts& p) const { return std::log((p.around + thinned_) * (p.falling + thinned_)) / 4; }

  const DensityModel& model_;
  double step_, thinned_;  // to the fourth
};

// Soft L1: 2 (sqrt(1 + e^2) - 1), and its weight in least squares.
double loss_of(double residual) {
  const double e = residual / kLossScale;
  return 2 * (std::sqrt(1 + e * e) - 1);
}

double weight_of(double residual) {
  const double e = residual / kLossScale;
  return 1 / std::sqrt(1 + e * e);
}

DensityModel moved(const DensityModel& model, const Unknowns& by) {
  DensityModel out = model;
  out.place += by.head<3>();
  out.log_step += by[3];
  out.log_thinned += by[4];
  return out;
}

}  // namespace

std::vector<double> density_residuals(const DensityModel& model, const DensitySamples& samples) {
  const AreaModel area(model);
  std::vector<double> out;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    out.push_back(samples.log_area[i] - area.log_area(samples.points[i], samples.normals[i]));
  }
  return out;
}

double density_loss(const DensityModel& model, const DensitySamples& samples, std::size_t stride) {
  const AreaModel area(model);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.points.size(); i += stride, ++count) {
    sum += loss_of(samples.log_area[i] - area.log_area(samples.points[i], samples.normals[i]));
  }
  return sum / static_cast<double>(count);
}

DensityModel model_from(const Eigen::Vector3d& place, const DensitySamples& samples, std::size_t stride) {
  std::vector<double> steps, areas;
  for (std::size_t i = 0; i < samples.points.size(); i += stride) {
    const Eigen::Vector3d ray = samples.points[i] - place;
    const double range = std::max(ray.norm(), 1e-9), cosine = std::abs(samples.normals[i].dot(ray)) / range;
    steps.push_back((samples.log_area[i] + std::log(std::max(cosine, kLeastCosine))) / 2 - std::log(range));
    areas.push_back(samples.log_area[i]);
  }
  DensityModel model;
  model.place = place;
  model.log_step = median(steps);
  model.log_thinned = quantile(areas, kThinnedQuantile) / 2;
  return model;
}

DensityModel fit_density(const DensityModel& start, const DensitySamples& samples, std::size_t stride) {
  DensityModel model = start;
  double loss = density_loss(model, samples, stride), damping = kFirstDamping;
  for (int step = 0; step < kMaxSteps && damping < kMostDamping; ++step) {
    const AreaModel area(model);
    Information information = Information::Zero();
    Unknowns gradient = Unknowns::Zero();
    for (std::size_t i = 0; i < samples.points.size(); i += stride) {
      const Term term = area.with_slope(samples.points[i], samples.normals[i]);
      const double residual = samples.log_area[i] - term.value;
      const Unknowns weighted = weight_of(residual) * term.slope;
      for (int column = 0; column < 5; ++column) {
        for (int row = column; row < 5; ++row) information(row, column) += weighted[row] * term.slope[column];
      }
      gradient += residual * weighted;
    }
    bool better = false;
    double gain = 0;
    for (; !better && damping < kMostDamping; damping *= better ? 0.1 : 10) {
      Information damped = information;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-12 * information.trace();
      const Unknowns by = Eigen::LDLT<Information>(damped).solve(gradient);
      if (!by.allFinite()) continue;
      const DensityModel next = moved(model, by);
      const double next_loss = density_loss(next, samples, stride);
      if (!(next_loss < loss)) continue;
      gain = loss - next_loss;
      model = next;
      loss = next_loss;
      better = true;
    }
    if (!better || gain < kLeastGain * loss) break;
  }
  return model;
}

}  // namespace tcm_icp
