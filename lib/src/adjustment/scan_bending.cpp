#include "adjustment/scan_bending.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "registration/link_scores.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/registration/pose_covariance.hpp"

namespace tcm_icp {
namespace {

using BendMatrix = Eigen::Matrix<double, kBendUnknowns, kBendUnknowns>;
using BentMatrix = Eigen::Matrix<double, kBentUnknowns, kBentUnknowns>;

constexpr int kMaxRounds = 200;
constexpr double kSettled = 1e-3;  // relative change of the variance: a tenth of a per cent of what it weighs
constexpr int kAxisBits = 21;      // of a cube's number along an axis: three axes in 64 bits

/// What one match says of D, and in which cube it lies: cubes of twice the edge are those without the last three bits.
struct PlacedScore {
  std::uint64_t cube = 0;
  Eigen::Matrix<double, kBendUnknowns, 1> score;
};

std::uint64_t cube_of(const Eigen::Vector3d& point, const Eigen::Vector3d& centre, double edge_m) {
  constexpr double kMiddle = 1 << (kAxisBits - 1);
  std::uint64_t cube = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor((point[axis] - centre[axis]) / edge_m) + kMiddle;
    const auto number = static_cast<std::uint64_t>(std::clamp(place, 0.0, 2 * kMiddle - 1));
    for (int bit = 0; bit < kAxisBits; ++bit) cube |= (number >> bit & 1U) << (3 * bit + axis);
  }
  return cube;
}

/// Squares of the sums over the scores of each cube: of the edge, among the smallest and its doubles, that gives most.
double squares_of_places(std::vector<PlacedScore>& scores) {
  // As for the covariance of poses: the scatter of fewer says little.
  const std::size_t least_places = PoseCovarianceOptions().min_blocks_of_scan;
  std::sort(scores.begin(), scores.end(), [](const auto& a, const auto& b) { return a.cube < b.cube; });
  double most = 0;
  for (int doublings = 0; doublings < kAxisBits; ++doublings) {
    double squares = 0;
    std::size_t places = 0;
    for (std::size_t begin = 0; begin < scores.size(); ++places) {
      const std::uint64_t cube = scores[begin].cube >> 3 * doublings;
      Eigen::Matrix<double, kBendUnknowns, 1> sum = Eigen::Matrix<double, kBendUnknowns, 1>::Zero();
      for (; begin < scores.size() && scores[begin].cube >> 3 * doublings == cube; ++begin) sum += scores[begin].score;
      squares += sum.squaredNorm();
    }
    if (places < least_places) break;
    most = std::max(most, squares);
  }
  return most;
}

}  // namespace

ScanBending::ScanBending(Points places_in_scan, std::vector<bool> swept)
    : places_in_scan_(std::move(places_in_scan)),
      places_(places_in_scan_),
      swept_(std::move(swept)),
      bends_m_(swept_.size(), Bend::Zero()) {}

void ScanBending::set_poses(const std::vector<Eigen::Isometry3d>& T_reference_scan) {
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = T_reference_scan[i] * places_in_scan_[i];
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

void ScanBending::straighten(JointLink& link) const {
  if (!any()) return;
  for (auto& match : link.matches) {
    match.source += offset_of(link.source, match.source);
    match.target += offset_of(link.target, match.target);
  }
}

// Of the residual by a step of this scan as the source; as the target it has the opposite sign.
ScanBending::Gradient ScanBending::gradient(const Correspondence& match, std::size_t scan, const TwistFrame& frame,
                                            const Eigen::Vector3d& point) const {
  Gradient out = Gradient::Zero();
  out.head<kPoseUnknowns>() = residual_gradient(match, frame);
  if (!swept_[scan]) return out;
  const Eigen::Vector3d u = direction(scan, point), n = match.precision * match.normal;
  out.tail<kBendUnknowns>() << n.x() * u, n.y() * u, n.z() * u;
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
    auto column = rows.col(filled++);
    column.head<kBentUnknowns>() = -root * gradient(match, link.target, target, match.target);
    column.segment<kBentUnknowns>(kBentUnknowns) = root * gradient(match, link.source, source, match.source);
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

ScanBending::Evidence ScanBending::evidence_of(std::size_t scan, const std::vector<const JointLink*>& links,
                                               const TwistFrame& frame, double threshold_m, double block_m) const {
  // The scan's equations, its neighbours held, and its pose eliminated from them.
  BentMatrix curvature = BentMatrix::Zero();
  const auto each_match = [&](auto&& take) {
    for (const JointLink* link : links) {
      const bool is_target = link->target == scan;
      for (const auto& match : link->matches) {
        const Eigen::Vector3d& point = is_target ? match.target : match.source;
        take(*link, point, (is_target ? -1 : 1) * gradient(match, scan, frame, point), residual_m(match));
      }
    }
  };
  each_match([&](const JointLink&, const Eigen::Vector3d&, const Gradient& g, double r) {
    curvature.noalias() += huber_weight(r, threshold_m) * g * g.transpose();
  });
  Matrix6 of_pose = curvature.topLeftCorner<kPoseUnknowns, kPoseUnknowns>();
  of_pose.diagonal().array() += 1e-6 * of_pose.trace() / kPoseUnknowns + 1e-300;
  const Eigen::Matrix<double, kPoseUnknowns, kBendUnknowns> by_pose =
      of_pose.ldlt().solve(curvature.topRightCorner<kPoseUnknowns, kBendUnknowns>());
  const BendMatrix own = curvature.bottomRightCorner<kBendUnknowns, kBendUnknowns>() -
                         curvature.bottomLeftCorner<kBendUnknowns, kPoseUnknowns>() * by_pose;

  Evidence evidence;
  std::map<std::size_t, Bend> of_pairs;
  std::vector<PlacedScore> of_places;
  each_match([&](const JointLink& link, const Eigen::Vector3d& point, const Gradient& g, double r) {
    const Bend score = -std::clamp(r, -threshold_m, threshold_m) *
                       (g.tail<kBendUnknowns>() - by_pose.transpose() * g.head<kPoseUnknowns>());
    evidence.squares_m2 += score.squaredNorm();
    of_pairs.try_emplace(link.target + link.source - scan, Bend::Zero()).first->second += score;
    of_places.push_back({cube_of(point, frame.centre, block_m), score});
  });
  Bend total = Bend::Zero();
  double pair_squares_m2 = 0;
  for (const auto& [neighbor, score] : of_pairs) {
    pair_squares_m2 += score.squaredNorm();
    total += score;
  }
  evidence.alike_squares_m2 = std::max(pair_squares_m2, squares_of_places(of_places));
  const Eigen::SelfAdjointEigenSolver<BendMatrix> parts(own);
  evidence.curvatures = parts.eigenvalues().cwiseMax(0);
  evidence.scores = parts.eigenvectors().transpose() * total;
  return evidence;
}

void ScanBending::estimate(const std::vector<JointLink>& links, const std::vector<TwistFrame>& frames, double noise_m,
                           double block_m, int num_threads) {
  deviation_m_ = 0;
  std::vector<std::vector<const JointLink*>> links_of(swept_.size());
  for (const auto& link : links) {
    if (swept_[link.target]) links_of[link.target].push_back(&link);
    if (swept_[link.source]) links_of[link.source].push_back(&link);
  }
  std::vector<Evidence> evidence(swept_.size());
  parallel_for(num_threads, swept_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!links_of[i].empty()) evidence[i] = evidence_of(i, links_of[i], frames[i], kHuberFactor * noise_m, block_m);
    }
  });
  double squares_m2 = 0, alike_squares_m2 = 0, curvature = 0;
  for (const auto& e : evidence) {
    squares_m2 += e.squares_m2;
    alike_squares_m2 += e.alike_squares_m2;
    curvature += e.curvatures.sum();
  }
  if (!(squares_m2 > 0 && curvature > 0)) return;
  // A sum over all matches varies by this factor more than one of independent matches would.
  const double variance_m2 = noise_m * noise_m * std::max(1.0, alike_squares_m2 / squares_m2);
  double deviation_m2 = noise_m * noise_m, determined = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const double weight = variance_m2 / deviation_m2, before_m2 = deviation_m2;
    double bends_m2 = 0;
    determined = 0;
    for (const auto& e : evidence) {
      const Bend sums = e.curvatures.array() + weight;
      bends_m2 += e.scores.cwiseQuotient(sums).squaredNorm();
      determined += e.curvatures.cwiseQuotient(sums).sum();
    }
    deviation_m2 = bends_m2 / determined;
    // Where the matches determine less than one number of all, there is nothing to be told.
    if (determined < 1) return;
    if (std::abs(deviation_m2 - before_m2) < kSettled * before_m2) break;
  }
  deviation_m_ = std::sqrt(deviation_m2);
  weight_ = variance_m2 / deviation_m2;
}

double ScanBending::offset_m() const {
  return std::sqrt(3.0) * deviation_m_;
}  // of three coordinates, u being of unit length

void ScanBending::add_prior(JointNormalEquations& equations) const {
  for (std::size_t i = 0; i < bends_m_.size(); ++i) {
    for (int j = 0; j < kBendUnknowns; ++j) equations.add_prior(i, kPoseUnknowns + j, weight_, -bends_m_[i][j]);
  }
}

void ScanBending::add_step(std::size_t scan, const Bend& step_m) { bends_m_[scan] += step_m; }

}  // namespace tcm_icp
