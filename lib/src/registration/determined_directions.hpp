#pragma once
// Which directions of the unknowns a system of rows says anything about.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace tcm_icp {

/// Columns: an orthonormal basis of the directions of x that the rows determine; the identity where they determine all.
/// Directions weaker than `tolerance` times the strongest count as undetermined, so the columns must be in one unit.
inline Eigen::MatrixXd determined_directions(const Eigen::MatrixXd& A, double tolerance) {
  const Eigen::MatrixXd gram = A.transpose() * A;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  const double threshold = tolerance * tolerance * eigen.eigenvalues().maxCoeff();
  const Eigen::Index rank = (eigen.eigenvalues().array() > threshold).count();
  if (rank == gram.cols()) return Eigen::MatrixXd::Identity(rank, rank);
  return eigen.eigenvectors().rightCols(rank);  // eigenvalues ascend
}

}  // namespace tcm_icp
