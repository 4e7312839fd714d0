#pragma once
// Which directions of the unknowns a system of rows says anything about.

#include <Eigen/Core>

#include "core/decompositions.hpp"

namespace tcm_icp {

/// Columns: an orthonormal basis of the directions of x that the rows determine; the identity where they determine all.
/// Directions weaker than `tolerance` times the strongest count as undetermined, so the columns must be in one unit.
inline Eigen::MatrixXd determined_directions(const Eigen::MatrixXd& A, double tolerance) {
  const Eigen::MatrixXd gram = A.transpose() * A;
  const SymmetricEigen<Eigen::Dynamic> eigen = symmetric_eigen(gram);
  const double threshold = tolerance * tolerance * eigen.values.maxCoeff();
  const Eigen::Index rank = (eigen.values.array() > threshold).count();
  if (rank == gram.cols()) return Eigen::MatrixXd::Identity(rank, rank);
  return eigen.vectors.rightCols(rank);  // eigenvalues ascend
}

}  // namespace tcm_icp
