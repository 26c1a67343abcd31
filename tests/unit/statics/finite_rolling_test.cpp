// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <vector>

#include "rondo/statics/anderson.hpp"
#include "rondo/statics/tangent_factors.hpp"

namespace finite_rolling_test {
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

/// Three nodes in a row on springs, the first of which is held.
TEST(LocalStiffness, MovesWhatIsNotHeld) {
  const std::vector<char> moves{0, 1, 1};
  rondo::statics::LocalStiffness k(moves);
  Eigen::Matrix3d spring;
  spring << 3.0, 1.0, 0.0, 1.0, 2.0, 0.5, 0.0, 0.5, 4.0;
  for (std::size_t a = 0; a + 1 < 3; ++a) {
    k.take(a, a, spring);
    k.take(a + 1, a + 1, spring);
    k.take(a, a + 1, -spring);
    k.take(a + 1, a, -spring);
  }
  ASSERT_TRUE(k.factor());
  const std::vector<rondo::Vec3> force{{9.0, 9.0, 9.0}, {1.0, 0.0, 2.0}, {0.0, 3.0, 1.0}};
  std::vector<rondo::Vec3> u(3);
  k.correct(force, u);
  EXPECT_EQ(u[0].x, 0.0);
  const auto vec = [](rondo::Vec3 v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  const Eigen::Vector3d first = spring * (2.0 * vec(u[1]) - vec(u[2])),
                        second = spring * (vec(u[2]) - vec(u[1]));
  EXPECT_LT((first + vec(force[1])).norm(), 1e-14);
  EXPECT_LT((second + vec(force[2])).norm(), 1e-14);
}

TEST(LocalStiffness, TellsWhatIsNotPositiveDefinite) {
  const std::vector<char> moves{1};
  rondo::statics::LocalStiffness k(moves);
  k.take(0, 0, Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal());
  EXPECT_FALSE(k.factor());
}

}  // namespace finite_rolling_test
