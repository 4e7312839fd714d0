#include "adjustment.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/statistics.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"
#include "tcm_icp/registration/correspondences.hpp"
#include "tcm_icp/registration/refinement.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kSharesOfSample = 3;  // each neighbour sees a third of a scan's points, not the same third
constexpr double kGateInVoxels = 2;
constexpr double kNormalAngle = std::numbers::pi / 6;
constexpr double kHuberFactor = 1.345;  // 95 % efficient for normal errors (Huber, 1981)

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Matches of the points of `source` in `target`, moved into the reference frame.
struct DirectedLink {
  std::size_t target, source;
  std::vector<Correspondence> matches;
};

Cloud share_of(const Cloud& cloud, std::size_t which) {
  Cloud out;
  for (std::size_t i = which % kSharesOfSample; i < cloud.size(); i += kSharesOfSample) {
    out.points.push_back(cloud.points[i]);
    out.normals.push_back(cloud.normals[i]);
  }
  return out;
}

void find_matches(const std::vector<PreparedScan>& scans, const std::vector<Eigen::Isometry3d>& T_reference_scan,
                  const CorrespondenceGate& gate, int num_threads, std::vector<DirectedLink>& links) {
  parallel_for(num_threads, links.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      DirectedLink& link = links[k];
      const Eigen::Isometry3d& T = T_reference_scan[link.target];
      link.matches = find_correspondences(share_of(scans[link.source].fine_sample, scans[link.target].share),
                                          T.inverse() * T_reference_scan[link.source], scans[link.target].fine, gate);
      for (auto& m : link.matches) {
        m.source = T * m.source;
        m.target = T * m.target;
        m.normal = T.linear() * m.normal;
      }
    }
  });
}

double huber_threshold(const std::vector<DirectedLink>& links) {
  std::vector<double> residuals;
  for (const auto& link : links) {
    for (const auto& m : link.matches) residuals.push_back(std::abs(m.normal.dot(m.source - m.target)));
  }
  return residuals.empty() ? 0 : kHuberFactor * kMadToSigma * median(residuals);
}

struct LinkSums {
  Matrix6 tt = Matrix6::Zero(), ts = Matrix6::Zero(), ss = Matrix6::Zero();  // target and source blocks of J'WJ
  Twist t = Twist::Zero(), s = Twist::Zero();                                // and of -J'Wr
};

LinkSums sums_of(const DirectedLink& link, const TwistFrame& target, const TwistFrame& source, double threshold_m) {
  LinkSums sums;
  for (const auto& m : link.matches) {
    const double r = m.normal.dot(m.source - m.target);
    const double weight = std::abs(r) <= threshold_m ? 1 : threshold_m / std::abs(r);
    Twist js, jt;
    js << (m.source - source.centre).cross(m.normal) / source.radius_m, m.normal;
    jt << (m.source - target.centre).cross(m.normal) / target.radius_m, m.normal;
    jt = -jt;
    sums.tt += weight * jt * jt.transpose();
    sums.ts += weight * jt * js.transpose();
    sums.ss += weight * js * js.transpose();
    sums.t -= weight * r * jt;
    sums.s -= weight * r * js;
  }
  return sums;
}

class NormalEquations {
 public:
  NormalEquations(std::size_t num_scans, std::size_t reference)
      : reference_(reference), rhs_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * num_scans))) {}

  void add_block(std::size_t row, std::size_t column, const Matrix6& block) {
    if (row == reference_ || column == reference_) return;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        entries_.emplace_back(static_cast<int>(6 * row) + i, static_cast<int>(6 * column) + j, block(i, j));
      }
    }
  }
  void add_rhs(std::size_t row, const Twist& part) {
    if (row != reference_) rhs_.segment<6>(static_cast<Eigen::Index>(6 * row)) += part;
  }

  /// Zero for the reference and for scans without links; empty where the matrix cannot be factorised. `damping` is
  /// added to the diagonal.
  Eigen::VectorXd solve(double damping) {
    for (int i = 0; i < rhs_.size(); ++i) entries_.emplace_back(i, i, damping);
    Eigen::SparseMatrix<double> matrix(rhs_.size(), rhs_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::VectorXd x = factors.solve(rhs_);
    return factors.info() == Eigen::Success && x.allFinite() ? x : Eigen::VectorXd();
  }

 private:
  std::size_t reference_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd rhs_;
};

}  // namespace

ScanPairs overlapping_pairs(const std::vector<PreparedScan>& scans,
                            const std::vector<Eigen::Isometry3d>& T_reference_scan, const std::vector<bool>& placed,
                            double min_overlap, int num_threads) {
  ScanPairs candidates;
  for (std::size_t a = 0; a < scans.size(); ++a) {
    for (std::size_t b = a + 1; b < scans.size(); ++b) {
      if (placed[a] && placed[b]) candidates.emplace_back(a, b);
    }
  }
  std::vector<char> keep(candidates.size(), 0);
  parallel_for(num_threads, candidates.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = candidates[i];
      const PyramidLevel& level_a = scans[a].pyramid.level(1);
      const PyramidLevel& level_b = scans[b].pyramid.level(1);
      const double share = overlap({level_a.cloud.points, level_a.index}, {level_b.cloud.points, level_b.index},
                                   T_reference_scan[a].inverse() * T_reference_scan[b], level_a.voxel_size_m);
      keep[i] = share >= min_overlap ? 1 : 0;
    }
  });
  ScanPairs pairs;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (keep[i] != 0) pairs.push_back(candidates[i]);
  }
  return pairs;
}

double adjust_poses(const std::vector<PreparedScan>& scans, const ScanPairs& pairs, std::size_t reference,
                    const Resolutions& resolutions, const PlacementOptions& options, const RunContext& context,
                    std::vector<Eigen::Isometry3d>& T_reference_scan) {
  std::vector<DirectedLink> links;
  for (const auto& [a, b] : pairs) {
    links.push_back({a, b, {}});
    links.push_back({b, a, {}});
  }
  const int steps = options.adjustment_steps;
  const double first_m = kGateInVoxels * resolutions.coarse_m, last_m = kGateInVoxels * resolutions.fine_m;
  double moved_m = 0;
  for (int step = 0; step < steps; ++step) {
    context.report("adjusting", static_cast<std::size_t>(step), static_cast<std::size_t>(steps));
    // The gate reaches its last size half-way, so that the second half settles.
    const double share = std::min(1.0, 2.0 * step / std::max(1, steps - 1));
    find_matches(scans, T_reference_scan, {first_m * std::pow(last_m / first_m, share), kNormalAngle},
                 context.num_threads, links);
    const double threshold_m = huber_threshold(links);
    if (!(threshold_m > 0)) return 0;  // nothing to match, or nothing left to improve
    std::vector<TwistFrame> frames;    // rotations are taken about each scan's middle, by the arc at its radius
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const Points& points = scans[i].fine_sample.points;
      frames.push_back(points.empty() ? TwistFrame() : twist_frame(points, T_reference_scan[i]));
    }
    std::vector<LinkSums> sums(links.size());
    parallel_for(context.num_threads, links.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        sums[k] = sums_of(links[k], frames[links[k].target], frames[links[k].source], threshold_m);
      }
    });
    NormalEquations equations(scans.size(), reference);
    double trace = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      const auto& [target, source, matches] = links[k];
      equations.add_block(target, target, sums[k].tt);
      equations.add_block(target, source, sums[k].ts);
      equations.add_block(source, target, sums[k].ts.transpose());
      equations.add_block(source, source, sums[k].ss);
      equations.add_rhs(target, sums[k].t);
      equations.add_rhs(source, sums[k].s);
      trace += sums[k].ss.trace();
    }
    // A millionth of the mean curvature: holds still what the points do not determine, and nothing else.
    const Eigen::VectorXd x = equations.solve(1e-6 * trace / static_cast<double>(6 * scans.size()) + 1e-300);
    if (x.size() == 0) {
      context.warn("the joint adjustment's equations could not be solved; poses stay as they were merged");
      return 0;
    }
    moved_m = std::sqrt(x.squaredNorm() / static_cast<double>(scans.size()));
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const Twist twist = x.segment<6>(static_cast<Eigen::Index>(6 * i));
      if (i == reference || twist.isZero()) continue;
      T_reference_scan[i] = frames[i].moved(T_reference_scan[i], twist);
    }
  }
  return moved_m;
}

}  // namespace tcm_icp
