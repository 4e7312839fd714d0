#include "tcm_icp/registration/pose_covariance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "registration/link_scores.hpp"
#include "registration/score_sandwich.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// Blocks the typical scan has matches in.
double blocks_of_scan(const std::vector<BlockScore>& scores) {
  std::map<std::size_t, double> counts;
  for (const auto& score : scores) {
    for (const auto& [scan, part] : score) ++counts[scan];
  }
  std::vector<double> values;
  for (const auto& [scan, count] : counts) values.push_back(count);
  return values.empty() ? 0 : median(values);
}

// Median over the pairs of how far their own optima are from the joint one, squared, in units of their blocks' scatter:
// by what it would be if the blocks explained it. Loops of the graph leave 6 (links - scans + 1) of 6 links to see.
double disagreement(const std::vector<JointLink>& links, double threshold_m, double block_m) {
  constexpr double kMedianOfChiSquare6 = 5.348;
  constexpr std::size_t kFewestBlocks = 12;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<JointLink>> pairs;
  std::map<std::size_t, int> scans;
  for (const auto& link : links) {
    pairs[std::minmax(link.target, link.source)].push_back(link);
    scans[link.target] = scans[link.source] = 1;
  }
  const double loops = static_cast<double>(pairs.size()) - static_cast<double>(scans.size()) + 1;
  std::vector<double> squares;
  for (const auto& [pair, both] : pairs) {
    const LinkScores scores = link_scores(both, threshold_m, block_m);
    if (scores.blocks.size() < kFewestBlocks) continue;
    const auto count = static_cast<double>(scores.blocks.size());
    const Twist total = scores.total();
    const double square = total.dot(scores.covariance_of_total().ldlt().solve(total));
    squares.push_back(square * (count - 6) / count);  // Hotelling: the scatter is estimated, too
  }
  if (loops < 1 || squares.empty()) return 1;
  const double expected = kMedianOfChiSquare6 * loops / static_cast<double>(pairs.size());
  return std::max(1.0, std::sqrt(median(squares) / expected));
}

PoseUncertainty pose_of(const Matrix6& covariance_m2, const TwistFrame& frame) {
  PoseUncertainty pose;
  pose.centre = frame.centre;
  const double largest = Eigen::SelfAdjointEigenSolver<Matrix6>(covariance_m2).eigenvalues()[5];
  pose.determined = largest < frame.radius_m * frame.radius_m;  // written so that NaN fails
  if (!pose.determined) return pose;
  Twist units;
  units << Eigen::Vector3d::Constant(1 / frame.radius_m), Eigen::Vector3d::Ones();
  pose.covariance = units.asDiagonal() * covariance_m2 * units.asDiagonal();
  return pose;
}

}  // namespace

void PoseCovarianceOptions::validate() const {
  if (!(smallest_block_m > 0)) {
    throw InvalidOptions("PoseCovarianceOptions: smallest_block_m is " + std::to_string(smallest_block_m) +
                         ", must be > 0");
  }
  if (min_blocks_of_scan < 7) {
    throw InvalidOptions("PoseCovarianceOptions: min_blocks_of_scan is " + std::to_string(min_blocks_of_scan) +
                         ", must be >= 7");
  }
}

JointUncertainty estimate_uncertainty(const std::vector<TwistFrame>& frames, std::size_t fixed,
                                      const std::vector<JointLink>& links, const PoseCovarianceOptions& options) {
  options.validate();
  if (fixed >= frames.size()) throw InvalidInput("pose covariance: the fixed scan is not among the scans");
  std::vector<bool> matched(frames.size(), false);
  for (const auto& link : links) {
    if (link.target >= frames.size() || link.source >= frames.size() || link.target == link.source) {
      throw InvalidInput("pose covariance: a link names a scan there is none of, or one scan twice");
    }
    if (!link.matches.empty()) matched[link.target] = matched[link.source] = true;
  }
  JointUncertainty out;
  out.noise_m = robust_noise_m(links);
  out.block_m = options.smallest_block_m;
  const ScoreSandwich sandwich(frames, fixed, links, out.noise_m);
  std::vector<BlockScore> best = sandwich.scores(out.block_m);
  const double independent = sandwich.variance_ratio(best);
  double largest = independent;
  for (double edge_m = 2 * options.smallest_block_m;; edge_m *= 2) {
    std::vector<BlockScore> scores = sandwich.scores(edge_m);
    const double count = blocks_of_scan(scores);
    if (count < static_cast<double>(options.min_blocks_of_scan)) break;
    const double ratio = count / (count - 6) * sandwich.variance_ratio(scores);  // six unknowns went into the fit
    if (ratio <= largest) continue;
    largest = ratio;
    out.block_m = edge_m;
    best = std::move(scores);
  }
  if (independent > 0) out.correlation_factor = std::sqrt(largest / independent);
  out.disagreement_factor = disagreement(links, kHuberFactor * out.noise_m, out.block_m);
  const double count = blocks_of_scan(best);
  const double scale = count > 6 ? count / (count - 6) * out.disagreement_factor * out.disagreement_factor
                                 : std::numeric_limits<double>::infinity();
  Eigen::MatrixXd covariance = scale * sandwich.covariance(best);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i == fixed) {
      out.poses.push_back({frames[i].centre, Matrix6::Zero(), true});
    } else if (matched[i]) {
      out.poses.push_back(pose_of(scan_block(covariance, i, i), frames[i]));
    } else {
      out.poses.push_back({frames[i].centre, PoseUncertainty().covariance, false});
    }
  }
  if (options.keeps_joint) {
    covariance.middleRows<6>(static_cast<Eigen::Index>(6 * fixed)).setZero();
    covariance.middleCols<6>(static_cast<Eigen::Index>(6 * fixed)).setZero();
    out.joint_covariance_m2 = std::move(covariance);
  }
  return out;
}

}  // namespace tcm_icp
