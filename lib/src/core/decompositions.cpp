#include "core/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace tcm_icp {
namespace {

template <int N>
SymmetricEigen<N> eigen_of(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

SymmetricEigen<3> symmetric_eigen3(const Eigen::Matrix3d& matrix) { return eigen_of<3>(matrix); }
SymmetricEigen<6> symmetric_eigen6(const Eigen::Matrix<double, 6, 6>& matrix) { return eigen_of<6>(matrix); }
SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix) {
  return eigen_of<Eigen::Dynamic>(matrix);
}

SymmetricEigen<Eigen::Dynamic> generalized_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, B);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SingularValues3 singular_values3(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

}  // namespace tcm_icp
