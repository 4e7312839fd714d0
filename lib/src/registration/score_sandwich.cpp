#include "registration/score_sandwich.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "registration/link_scores.hpp"
#include "registration/match_blocks.hpp"
#include "tcm_icp/core/parallel.hpp"
#include "tcm_icp/core/statistics.hpp"

namespace tcm_icp {
namespace {

// A symmetric matrix by sums of 6 x 6 blocks, of which one of two that mirror one another is kept.
class BlockSums {
 public:
  /// Row at most column.
  Matrix6& at(std::size_t row, std::size_t column) {
    return blocks_.try_emplace({row, column}, Matrix6::Zero()).first->second;
  }

  Eigen::SparseMatrix<double> matrix(Eigen::Index size, double diagonal) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(72 * blocks_.size() + static_cast<std::size_t>(size));
    for (const auto& [place, block] : blocks_) {
      const auto [row, column] = place;
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
          const int a = static_cast<int>(6 * row) + i, b = static_cast<int>(6 * column) + j;
          entries.emplace_back(a, b, block(i, j));
          if (row != column) entries.emplace_back(b, a, block(i, j));
        }
      }
    }
    for (int i = 0; i < size; ++i) entries.emplace_back(i, i, diagonal);
    Eigen::SparseMatrix<double> out(size, size);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  double trace() const {
    double sum = 0;
    for (const auto& [place, block] : blocks_) sum += place.first == place.second ? block.trace() : 0;
    return sum;
  }

 private:
  std::map<std::pair<std::size_t, std::size_t>, Matrix6> blocks_;
};

double typical(const std::map<std::size_t, double>& counts) {
  std::vector<double> values;
  for (const auto& [scan, count] : counts) values.push_back(count);
  return values.empty() ? 0 : median(values);
}

}  // namespace

ScoreSandwich::ScoreSandwich(const std::vector<TwistFrame>& frames, std::size_t fixed,
                             const std::vector<JointLink>& links, double noise_m)
    : frames_(frames), fixed_(fixed), links_(links), noise_m_(noise_m) {
  BlockSums information;
  for (const auto& link : links) {
    Matrix6 ss = Matrix6::Zero(), tt = Matrix6::Zero(), st = Matrix6::Zero();
    for (const auto& match : link.matches) {
      if (std::abs(residual_m(match)) > kHuberFactor * noise_m_) continue;
      const Twist s = residual_gradient(match, frames_[link.source]),
                  t = -residual_gradient(match, frames_[link.target]);
      ss += s * s.transpose();
      tt += t * t.transpose();
      st += s * t.transpose();
    }
    if (link.source != fixed_) information.at(link.source, link.source) += ss;
    if (link.target != fixed_) information.at(link.target, link.target) += tt;
    if (link.source == fixed_ || link.target == fixed_) continue;
    if (link.source < link.target) {
      information.at(link.source, link.target) += st;
    } else {
      information.at(link.target, link.source) += st.transpose();
    }
  }
  // Of the mean curvature: what matches do not determine comes out as very uncertain, not as an error. The ends of a
  // chain of a thousand scans move against some 3e-10 of it.
  const double trace = information.trace();
  damping_ = 1e-12 * (trace > 0 ? trace / static_cast<double>(size()) : 1);
  factors_.compute(information.matrix(size(), damping_));
}

ScoreScatter ScoreSandwich::scatter(double block_m) const {
  BlockSums sums;
  std::map<std::size_t, double> counts;
  std::vector<Twist> score(frames_.size(), Twist::Zero());
  std::vector<std::size_t> scans;  // of the block
  std::vector<bool> is_in_block(frames_.size(), false);
  const auto add = [&](std::size_t scan, const Twist& part) {
    if (scan == fixed_) return;
    if (!is_in_block[scan]) scans.push_back(scan);
    is_in_block[scan] = true;
    score[scan] += part;
  };
  for (const auto& block : blocks_of(links_, block_m)) {
    for (const auto& [l, m] : block) {
      const JointLink& link = links_[l];
      const Correspondence& match = link.matches[m];
      const double r = std::clamp(residual_m(match), -kHuberFactor * noise_m_, kHuberFactor * noise_m_);
      add(link.source, r * residual_gradient(match, frames_[link.source]));
      add(link.target, -r * residual_gradient(match, frames_[link.target]));
    }
    for (const std::size_t a : scans) {
      ++counts[a];
      for (const std::size_t b : scans) {
        if (a <= b) sums.at(a, b) += score[a] * score[b].transpose();
      }
    }
    for (const std::size_t scan : scans) {
      score[scan].setZero();
      is_in_block[scan] = false;
    }
    scans.clear();
  }
  return {sums.matrix(size(), 0), typical(counts)};
}

// The trace of the inverse times each scatter.
std::vector<double> ScoreSandwich::variance_ratios(const std::vector<ScoreScatter>& scatters, int num_threads) const {
  Eigen::MatrixXd traces(static_cast<Eigen::Index>(scatters.size()), static_cast<Eigen::Index>(frames_.size()));
  parallel_for(num_threads, frames_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t scan = begin; scan < end; ++scan) {
      const Eigen::MatrixXd columns = inverse_columns(scan);
      for (std::size_t k = 0; k < scatters.size(); ++k) {
        double sum = 0;
        for (int j = 0; j < 6; ++j) {
          const auto column = static_cast<Eigen::Index>(6 * scan) + j;
          for (Eigen::SparseMatrix<double>::InnerIterator entry(scatters[k].matrix, column); entry; ++entry) {
            sum += entry.value() * columns(entry.row(), j);
          }
        }
        traces(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(scan)) = sum;
      }
    }
  });
  const Eigen::VectorXd sums = traces.rowwise().sum();
  return {sums.begin(), sums.end()};
}

std::vector<Matrix6> ScoreSandwich::covariances(const ScoreScatter& scatter, int num_threads) const {
  std::vector<Matrix6> out(frames_.size());
  const double floor_m2 = noise_m_ * noise_m_ * damping_;
  parallel_for(num_threads, frames_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t scan = begin; scan < end; ++scan) {
      const Eigen::MatrixXd columns = inverse_columns(scan);
      out[scan] = columns.transpose() * (scatter.matrix * columns) + floor_m2 * columns.transpose() * columns;
    }
  });
  return out;
}

Eigen::MatrixXd ScoreSandwich::joint_covariance(const ScoreScatter& scatter) const {
  const Eigen::MatrixXd inverse = factors_.solve(Eigen::MatrixXd::Identity(size(), size()));
  return inverse.transpose() * (scatter.matrix * inverse) +
         noise_m_ * noise_m_ * damping_ * inverse.transpose() * inverse;
}

Eigen::MatrixXd ScoreSandwich::inverse_columns(std::size_t scan) const {
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(size(), 6);
  unit.middleRows<6>(static_cast<Eigen::Index>(6 * scan)).setIdentity();
  return factors_.solve(unit);
}

}  // namespace tcm_icp
