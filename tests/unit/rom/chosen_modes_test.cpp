// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/chosen_modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "rondo/pod/decompose.hpp"

namespace chosen_modes_test {

using namespace rondo::rom;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using rondo::pod::Decomposition;
using rondo::pod::Index;

namespace {

constexpr Index rows = 60, columns = 25;

MatrixXd random_matrix(Index n, Index m, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  MatrixXd a(n, m);
  for (double& x : a.reshaped()) x = normal(engine);
  return a;
}

/// All of the matrix by its decomposition, and rows that the norm adds.
struct Problem {
  MatrixXd a = random_matrix(rows, columns, 1), e = 3.0 * random_matrix(4, rows, 2);
  Decomposition found;

  Problem() {
    for (Index j = 0; j < columns; ++j) a.col(j) *= std::pow(0.7, static_cast<double>(j));
    const Eigen::BDCSVD<MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
    found.sigma = svd.singularValues();
    found.modes = svd.matrixU();
    found.temporal = svd.matrixV();
    found.energy = a.squaredNorm();
  }
};

TEST(ChosenModes, AreTheDecompositionsWithoutAnotherNorm) {
  const Problem p;
  const ChosenModes chosen = choose_modes(p.found, MatrixXd(), 6);
  ASSERT_EQ(chosen.modes.cols(), 6);
  for (Index j = 0; j < 6; ++j) {
    EXPECT_NEAR(std::abs(chosen.modes.col(j).dot(p.found.modes.col(j))), 1.0, 1e-12);
    const double tail = p.found.sigma.tail(columns - j - 1).squaredNorm();
    EXPECT_NEAR(chosen.left[j + 1], tail, 1e-13 * p.found.energy);
  }
}

/// The best of all subspaces in the norm: its error is the tail of the singular values there.
TEST(ChosenModes, AreTheBestInTheNorm) {
  const Problem p;
  const ChosenModes chosen = choose_modes(p.found, p.e * p.found.modes, 5);
  MatrixXd metric = MatrixXd::Identity(rows, rows) + p.e.transpose() * p.e;
  const MatrixXd root = metric.llt().matrixL().transpose();  // ‖root a‖ is the norm of a
  const Eigen::BDCSVD<MatrixXd> svd(root * p.a);
  const MatrixXd weighted = root * chosen.modes;
  const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(weighted).householderQ() *
                     MatrixXd::Identity(rows, chosen.modes.cols());
  const MatrixXd left = root * p.a - q * (q.transpose() * (root * p.a));
  const VectorXd sigma = svd.singularValues();
  EXPECT_NEAR(left.squaredNorm(), sigma.tail(columns - 5).squaredNorm(),
              1e-12 * sigma.squaredNorm());
  for (Index j = 0; j < 5; ++j) EXPECT_NEAR(chosen.sigma[j], sigma[j], 1e-12 * sigma[0]);
  const MatrixXd gram = chosen.modes.transpose() * chosen.modes;
  EXPECT_LT((gram - MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-13);
  const MatrixXd out = p.a - chosen.modes * (chosen.modes.transpose() * p.a);
  EXPECT_NEAR(chosen.left[5], out.squaredNorm(), 1e-12 * p.found.energy);
}

TEST(ChosenModes, AreNoMoreThanTheRank) {
  Problem p;
  p.found.sigma.tail(columns - 3).setZero();
  EXPECT_EQ(choose_modes(p.found, p.e * p.found.modes, 10).modes.cols(), 3);
}

}  // namespace

}  // namespace chosen_modes_test
