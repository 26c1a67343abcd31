// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dense_test {

using namespace rondo::pod;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Not symmetric, well conditioned.
MatrixXd matrix(Index n) {
  MatrixXd a(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      a(i, j) = std::sin(1.0 + static_cast<double>(3 * i + 7 * j)) + (i == j ? 10.0 : 0.0);
  return a;
}

TEST(Dense, MultipliesAsItIsWritten) {
  const MatrixXd a = matrix(5).leftCols(3);
  const VectorXd x = VectorXd::LinSpaced(3, -1.0, 2.0);
  VectorXd y = VectorXd::Constant(5, std::nan(""));  // what was there does not count
  multiply(a, x, y);
  for (Index i = 0; i < 5; ++i)
    EXPECT_NEAR(y[i], a(i, 0) * x[0] + a(i, 1) * x[1] + a(i, 2) * x[2], 1e-14 * a.norm());
}

TEST(Dense, InverseTakesTheMatrixBack) {
  const MatrixXd a = matrix(40);
  EXPECT_LT((a * inverse(a) - MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-13);
  MatrixXd singular = a;
  singular.col(7).setZero();
  EXPECT_TRUE(std::isnan(inverse(singular)(0, 0)));
}

}  // namespace

}  // namespace dense_test
