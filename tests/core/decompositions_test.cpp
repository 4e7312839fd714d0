#include "core/decompositions.hpp"

#include <gtest/gtest.h>

#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

template <int N>
Eigen::Matrix<double, N, N> random_matrix(int n) {
  Rng rng = make_stream(1, "decompositions");
  Eigen::Matrix<double, N, N> m(n, n);
  for (auto& value : m.reshaped()) value = standard_normal(rng);
  return m;
}

template <int N>
void expect_eigen(const Eigen::Matrix<double, N, N>& m, const SymmetricEigen<N>& eigen) {
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - m).norm(), 1e-12);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(m.rows(), m.rows());
  EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - unit).norm(), 1e-12);
  for (Eigen::Index k = 1; k < m.rows(); ++k) EXPECT_LE(eigen.values[k - 1], eigen.values[k]);
}

template <int N>
Eigen::Matrix<double, N, N> symmetric(const Eigen::Matrix<double, N, N>& m) {
  return m + m.transpose();
}

TEST(Decompositions, EigenvectorsGiveTheMatrix) {
  const Eigen::Matrix3d three = symmetric(random_matrix<3>(3));
  expect_eigen<3>(three, symmetric_eigen3(three));
  const Eigen::Matrix<double, 6, 6> six = symmetric(random_matrix<6>(6));
  expect_eigen<6>(six, symmetric_eigen6(six));
  const Eigen::MatrixXd nine = symmetric(random_matrix<Eigen::Dynamic>(9));
  expect_eigen<Eigen::Dynamic>(nine, symmetric_eigen(nine));
}

TEST(Decompositions, GeneralizedEigenvectorsFulfilTheirEquation) {
  const Eigen::MatrixXd half = random_matrix<Eigen::Dynamic>(4), A = symmetric(half);
  const Eigen::MatrixXd B = half * half.transpose() + Eigen::MatrixXd::Identity(4, 4);
  const auto eigen = generalized_eigen(A, B);
  EXPECT_LT((A * eigen.vectors - B * eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-10);
  EXPECT_LT((eigen.vectors.transpose() * B * eigen.vectors - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-12);
}

TEST(Decompositions, SingularValuesGiveTheMatrixAndDescend) {
  const Eigen::Matrix3d m = random_matrix<3>(3);
  const SingularValues3 svd = singular_values3(m);
  EXPECT_LT((svd.U * svd.values.asDiagonal() * svd.V.transpose() - m).norm(), 1e-12);
  EXPECT_GE(svd.values[0], svd.values[1]);
  EXPECT_GE(svd.values[1], svd.values[2]);
  EXPECT_GE(svd.values[2], 0);
}

TEST(Decompositions, RotationsTurnOneDirectionIntoAnother) {
  const Eigen::Vector3d from(1, 2, 3), to(-2, 0.5, 1), across = from.cross(to).normalized();
  const Eigen::Matrix3d R = rotation_between(from, to);
  EXPECT_LT((R * from.normalized() - to.normalized()).norm(), 1e-12);
  EXPECT_LT((R * across - across).norm(), 1e-12);  // the smallest one
  const Eigen::Matrix3d half_turn = rotation_between(from, -from);
  EXPECT_LT((half_turn * from + from).norm(), 1e-12);
  EXPECT_NEAR(half_turn.determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace tcm_icp
