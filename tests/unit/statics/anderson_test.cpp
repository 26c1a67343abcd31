// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "rondo/statics/anderson.hpp"

namespace anderson_test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// x -> A x + b, of which plain iteration diverges along the last two unknowns.
struct Affine {
  Eigen::MatrixXd a = Eigen::Vector4d(0.5, -0.3, -2.0, 3.0).asDiagonal();
  VectorXd b = Eigen::Vector4d(1.0, 2.0, 3.0, 4.0);
  [[nodiscard]] VectorXd operator()(const VectorXd& x) const { return a * x + b; }
};

}  // namespace

TEST(Anderson, SolvesAnAffineIterationInAsManyStepsAsItHasUnknowns) {
  Affine g;
  g.a(0, 2) = 0.7;
  g.a(3, 1) = -0.2;
  const VectorXd solution = (Eigen::MatrixXd::Identity(4, 4) - g.a).lu().solve(g.b);
  rondo::statics::Anderson acceleration(4);
  VectorXd x = VectorXd::Zero(4);
  EXPECT_EQ(acceleration.next(x, g(x)), g(x));  // there is nothing to combine yet
  acceleration.restart();
  for (int n = 0; n < 6; ++n) x = acceleration.next(x, g(x));
  EXPECT_LT((x - solution).norm(), 1e-9 * solution.norm());
}

TEST(Anderson, StaysAtAFixedPoint) {
  const Affine g;
  const VectorXd solution = (Eigen::MatrixXd::Identity(4, 4) - g.a).lu().solve(g.b);
  rondo::statics::Anderson acceleration(2);
  VectorXd x = solution;
  for (int n = 0; n < 4; ++n) x = acceleration.next(x, x);
  EXPECT_EQ(x, solution);
}

}  // namespace anderson_test
