#pragma once
// Decompositions of small matrices. Compiled once: Eigen's templates cost seconds in every file that has them.

#include <Eigen/Core>

namespace tcm_icp {

template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;   ///< ascending
  Eigen::Matrix<double, N, N> vectors;  ///< columns, orthonormal, in the same order
};

/// Of symmetric matrices, of which the lower triangle is read.
SymmetricEigen<3> symmetric_eigen3(const Eigen::Matrix3d& matrix);
SymmetricEigen<6> symmetric_eigen6(const Eigen::Matrix<double, 6, 6>& matrix);
SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix);

/// Of A v = lambda B v with a symmetric A and a positive definite B; the vectors fulfil V' B V = I.
SymmetricEigen<Eigen::Dynamic> generalized_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// matrix = U diag(values) V', values descend.
struct SingularValues3 {
  Eigen::Vector3d values;
  Eigen::Matrix3d U, V;
};
SingularValues3 singular_values3(const Eigen::Matrix3d& matrix);

/// The smallest rotation that turns one direction into another. Neither needs to have unit length.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace tcm_icp
