#include "adjustment/scan_bending.hpp"

#include <Eigen/Eigenvalues>
#include <utility>

namespace tcm_icp {
namespace {

// Of a turn: between directions that are farther apart the end of the turn lies too often, where one sees the place a
// turn later and not a share of one. Sets along a street are the same with an eighth.
constexpr double kMostTurned = 0.25;

Eigen::Vector3d principal_axis(const Eigen::Matrix3d& sum_of_squares) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum_of_squares).eigenvectors().col(2);
}

}  // namespace

ScanBending::ScanBending(std::vector<ScanOrigin> origins)
    : origins_(std::move(origins)),
      ways_(origins_.size(), Eigen::Vector3d::Zero()),
      bends_m_(origins_.size(), Bend::Zero()) {
  for (const auto& origin : origins_) places_.push_back(origin.place);
}

void ScanBending::set_poses(const std::vector<Eigen::Isometry3d>& T_reference_scan) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < origins_.size(); ++i) {
    places_[i] = T_reference_scan[i] * origins_[i].place;
    const Eigen::Vector3d axis = T_reference_scan[i].linear() * origins_[i].axis;
    if (origins_[i].located) axes += axis * axis.transpose();
  }
  // As it was before: motions have their sign by it.
  const Eigen::Vector3d axis = principal_axis(axes);
  axis_ = axis_.dot(axis) < 0 ? Eigen::Vector3d(-axis) : axis;
}

// Of each scan the axis along which the places of its neighbours lie.
void ScanBending::find_ways(const std::vector<JointLink>& links) {
  std::vector<Eigen::Matrix3d> sums(origins_.size(), Eigen::Matrix3d::Zero());
  for (const auto& link : links) {
    if (!origins_[link.source].located || !origins_[link.target].located) continue;
    const Eigen::Vector3d way = (places_[link.source] - places_[link.target]).stableNormalized();
    sums[link.source] += way * way.transpose();
    sums[link.target] += way * way.transpose();
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    ways_[i] = sums[i].isZero() ? Eigen::Vector3d::Zero() : principal_axis(sums[i]);
  }
}

Eigen::Vector3d ScanBending::direction(std::size_t scan, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d ray = point - places_[scan];
  const double length_m = ray.norm();
  return length_m > 0 ? Eigen::Vector3d(ray / length_m) : Eigen::Vector3d::Zero();
}

Eigen::Vector3d ScanBending::offset_of(std::size_t scan, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d u = direction(scan, point);
  const Bend& bend = bends_m_[scan];
  return {bend.segment<3>(0).dot(u), bend.segment<3>(3).dot(u), bend.segment<3>(6).dot(u)};
}

double ScanBending::turned(const JointLink& link, const Correspondence& match) const {
  if (!origins_[link.source].located || !origins_[link.target].located) return 0;
  const Eigen::Vector3d from_source = match.source - places_[link.source];
  const Eigen::Vector3d from_target = match.target - places_[link.target];
  const double cosine = from_source.dot(from_target) - axis_.dot(from_source) * axis_.dot(from_target);
  const double share = std::atan2(axis_.dot(from_target.cross(from_source)), cosine) / (2 * EIGEN_PI);
  return std::abs(share) <= kMostTurned ? share : 0;
}

void ScanBending::straighten(JointLink& link) const {
  if (!any()) return;
  const Eigen::Vector3d motion_m = (bends_m_[link.source][kHarmonicUnknowns] * ways_[link.source] +
                                    bends_m_[link.target][kHarmonicUnknowns] * ways_[link.target]) /
                                   2;
  for (auto& match : link.matches) {
    const double share = motion_.any() ? turned(link, match) : 0;
    match.source += offset_of(link.source, match.source) + share * motion_m;
    match.target += offset_of(link.target, match.target);
  }
}

ScanBending::Harmonic ScanBending::harmonic_gradient(const JointLink& link, const Correspondence& match,
                                                     bool is_target) const {
  const Eigen::Vector3d n = match.precision * match.normal;
  const Eigen::Vector3d u =
      is_target ? Eigen::Vector3d(-direction(link.target, match.target)) : direction(link.source, match.source);
  Harmonic out;
  out << n.x() * u, n.y() * u, n.z() * u;
  return out;
}

// Of the residual by a step of the link's target or source.
ScanBending::Gradient ScanBending::gradient(const JointLink& link, const Correspondence& match, bool is_target,
                                            const TwistFrame& frame, double share) const {
  const std::size_t scan = is_target ? link.target : link.source;
  Gradient out = Gradient::Zero();
  out.head<kPoseUnknowns>() = (is_target ? -1 : 1) * residual_gradient(match, frame);
  if (harmonic_.any() && origins_[scan].swept) {
    out.segment<kHarmonicUnknowns>(kPoseUnknowns) = harmonic_gradient(link, match, is_target);
  }
  out[kBentUnknowns - 1] = share / 2 * match.precision * match.normal.dot(ways_[scan]);
  return out;
}

BentSums ScanBending::sums(const JointLink& link, const TwistFrame& target, const TwistFrame& source,
                           double threshold_m) const {
  // Rows of many matches are gathered, so that their outer products are one of matrices.
  constexpr int kRows = 2 * kBentUnknowns + 1;
  constexpr Eigen::Index kColumns = 64;
  Eigen::Matrix<double, kRows, kRows> products = Eigen::Matrix<double, kRows, kRows>::Zero();
  Eigen::Matrix<double, kRows, kColumns> rows;
  Eigen::Index filled = 0;
  const auto add_rows = [&] {
    products.noalias() += rows.leftCols(filled) * rows.leftCols(filled).transpose();
    filled = 0;
  };
  for (const auto& match : link.matches) {
    const double r = residual_m(match);
    const double root = std::sqrt(huber_weight(r, threshold_m));
    const double share = motion_.any() ? turned(link, match) : 0;
    auto column = rows.col(filled++);
    column.head<kBentUnknowns>() = root * gradient(link, match, true, target, share);
    column.segment<kBentUnknowns>(kBentUnknowns) = root * gradient(link, match, false, source, share);
    column[kRows - 1] = root * r;
    if (filled == kColumns) add_rows();
  }
  add_rows();
  BentSums sums;
  sums.tt = products.topLeftCorner<kBentUnknowns, kBentUnknowns>();
  sums.ts = products.block<kBentUnknowns, kBentUnknowns>(0, kBentUnknowns);
  sums.ss = products.block<kBentUnknowns, kBentUnknowns>(kBentUnknowns, kBentUnknowns);
  sums.t = -products.col(kRows - 1).head<kBentUnknowns>();
  sums.s = -products.col(kRows - 1).segment<kBentUnknowns>(kBentUnknowns);
  return sums;
}

void ScanBending::estimate(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames,
                           const MatchNoise& noise, int num_threads) {
  std::vector<bool> swept, located;
  for (const auto& origin : origins_) {
    swept.push_back(origin.swept);
    located.push_back(origin.located);
  }
  harmonic_ =
      likeliest_prior<kHarmonicUnknowns>(links, frames, swept, noise, num_threads,
                                         [&](const JointLink& link, const Correspondence& match, bool is_target) {
                                           return harmonic_gradient(link, match, is_target);
                                         });
  // As if its neighbours moved as the scan does: they do, and held they would hide what all have in common.
  find_ways(links);
  motion_ = likeliest_prior<1>(links, frames, located, noise, num_threads,
                               [&](const JointLink& link, const Correspondence& match, bool is_target) {
                                 const Eigen::Vector3d& way = ways_[is_target ? link.target : link.source];
                                 return turned(link, match) * match.precision * match.normal.dot(way);
                               });
}

void ScanBending::add_prior(JointNormalEquations& equations) const {
  for (std::size_t i = 0; i < bends_m_.size(); ++i) {
    for (int j = 0; j < kBendUnknowns; ++j) {
      const BendPrior& prior = j < kHarmonicUnknowns ? harmonic_ : motion_;
      equations.add_prior(i, kPoseUnknowns + j, prior.weight, -bends_m_[i][j]);
    }
  }
}

void ScanBending::add_step(std::size_t scan, const Bend& step_m) { bends_m_[scan] += step_m; }

}  // namespace tcm_icp
