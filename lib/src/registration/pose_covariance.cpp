#include "tcm_icp/registration/pose_covariance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/decompositions.hpp"
#include "registration/link_scores.hpp"
#include "registration/score_sandwich.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// Median over the pairs of how far their own optima are from the joint one, squared, in units of their blocks' scatter:
// by what it would be if the blocks explained it. Loops of the graph leave 6 (links - scans + 1) of 6 links to see.
double disagreement(const std::vector<JointLink>& links, double threshold_m, double block_m) {
  constexpr double kMedianOfChiSquare6 = 5.348;
  constexpr std::size_t kFewestBlocks = 12;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const JointLink*>> pairs;
  std::map<std::size_t, int> scans;
  for (const auto& link : links) {
    pairs[std::minmax(link.target, link.source)].push_back(&link);
    scans[link.target] = scans[link.source] = 1;
  }
  const double loops = static_cast<double>(pairs.size()) - static_cast<double>(scans.size()) + 1;
  std::vector<double> squares;
  for (const auto& [pair, of_pair] : pairs) {
    std::vector<JointLink> both;  // copies of one pair at a time: all of a large set would be gigabytes
    for (const JointLink* link : of_pair) both.push_back(*link);
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
  const double largest = symmetric_eigen6(covariance_m2).values[5];
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
                                      const std::vector<JointLink>& links, const PoseCovarianceOptions& options,
                                      int num_threads) {
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
  const ScoreSandwich sandwich(frames, fixed, links, out.noise_m);
  std::vector<ScoreScatter> scatters{sandwich.scatter(options.smallest_block_m)};
  std::vector<double> edges_m{options.smallest_block_m};
  while (true) {
    const double edge_m = 2 * edges_m.back();
    ScoreScatter scatter = sandwich.scatter(edge_m);
    if (scatter.blocks_of_scan < static_cast<double>(options.min_blocks_of_scan)) break;
    scatters.push_back(std::move(scatter));
    edges_m.push_back(edge_m);
  }
  std::vector<double> ratios = sandwich.variance_ratios(scatters, num_threads);
  const double independent = ratios.front();
  std::size_t best = 0;
  for (std::size_t k = 1; k < ratios.size(); ++k) {
    const double blocks = scatters[k].blocks_of_scan;
    ratios[k] *= blocks / (blocks - 6);  // six unknowns went into the fit
    if (ratios[k] > ratios[best]) best = k;
  }
  out.block_m = edges_m[best];
  if (independent > 0) out.correlation_factor = std::sqrt(ratios[best] / independent);
  out.disagreement_factor = disagreement(links, kHuberFactor * out.noise_m, out.block_m);
  const double count = scatters[best].blocks_of_scan;
  const double scale = count > 6 ? count / (count - 6) * out.disagreement_factor * out.disagreement_factor
                                 : std::numeric_limits<double>::infinity();
  const std::vector<Matrix6> covariances = sandwich.covariances(scatters[best], num_threads);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i == fixed) {
      out.poses.push_back({frames[i].centre, Matrix6::Zero(), true});
    } else if (matched[i]) {
      out.poses.push_back(pose_of(scale * covariances[i], frames[i]));
    } else {
      out.poses.push_back({frames[i].centre, PoseUncertainty().covariance, false});
    }
  }
  if (options.keeps_joint) {
    Eigen::MatrixXd covariance = scale * sandwich.joint_covariance(scatters[best]);
    covariance.middleRows<6>(static_cast<Eigen::Index>(6 * fixed)).setZero();
    covariance.middleCols<6>(static_cast<Eigen::Index>(6 * fixed)).setZero();
    out.joint_covariance_m2 = std::move(covariance);
  }
  return out;
}

}  // namespace tcm_icp
