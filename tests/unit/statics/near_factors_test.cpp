// SPDX-License-Identifier: BSD-3-Clause
/// Dense systems solved by the factors of one that is near.
#include "rondo/statics/steady/near_factors.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/solid_steady.hpp"

namespace near_factors_test {

using namespace rondo::statics;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Names = std::vector<Index>;

namespace {

/// Diagonally dominant, of no other structure.
MatrixXd system_of(Index n, double off = 0.3) {
  return MatrixXd::Identity(n, n) +
         off / std::sqrt(static_cast<double>(n)) * MatrixXd::Random(n, n);
}

Names names_of(Index n) {
  Names names(static_cast<std::size_t>(n));
  std::iota(names.begin(), names.end(), Index{0});
  return names;
}

/// Solves by steps, as Newton's method does, until one is exact. @return steps
int solve(NearFactors& near, const NamedSystem& system, const VectorXd& right, VectorXd& x) {
  int steps = 0;
  do {
    const auto next = near.solve(system, right, x);
    if (!next) return -1;
    x = *next;
  } while (++steps < 10 && !near.is_exact());
  return steps;
}

double error(const MatrixXd& a, const VectorXd& right, const VectorXd& x) {
  const VectorXd direct = a.partialPivLu().solve(right);
  return (x - direct).norm() / direct.norm();
}

}  // namespace

TEST(NearFactors, SolveANearSystemAsItsOwnFactorsDo) {
  constexpr Index n = 90;
  const MatrixXd first = system_of(n), second = first + 0.01 * system_of(n);
  const VectorXd right = VectorXd::Random(n), weights = VectorXd::Ones(n);
  const Names names = names_of(n);
  NearFactors near;
  VectorXd x = VectorXd::Zero(n);
  EXPECT_GT(solve(near, {first, names, weights}, right, x), 0);
  EXPECT_LT(error(first, right, x), 1e-12);
  EXPECT_GT(solve(near, {second, names, weights}, right, x), 0);
  EXPECT_LT(error(second, right, x), 1e-12);
  EXPECT_EQ(near.made(), 1);
}

/// Each step leaves a tenth or less, and its square at the end.
TEST(NearFactors, LeaveTheLessTheNearerTheyBegin) {
  constexpr Index n = 60;
  const MatrixXd a = system_of(n);
  const VectorXd right = VectorXd::Random(n), weights = VectorXd::Ones(n);
  const Names names = names_of(n);
  NearFactors near;
  VectorXd x = VectorXd::Zero(n);
  const auto left = [&] { return (right - a * x).norm() / right.norm(); };
  double before = left();
  for (int step = 0; step < 10 && !near.is_exact(); ++step) {
    x = *near.solve({a, names, weights}, right, x);
    EXPECT_LE(left(), std::max(1e-13, before * std::min(0.1, 10.0 * before)));
    EXPECT_EQ(near.is_exact(), left() <= 1e-13);
    before = left();
  }
  EXPECT_TRUE(near.is_exact());
}

/// Unknowns come, go and change places; rows have other units.
TEST(NearFactors, FindUnknownsByTheirNames) {
  constexpr Index n = 80, fewer = 74;
  const MatrixXd all = system_of(n);
  VectorXd weights = VectorXd::Ones(n);
  weights[0] = 1e-9;  // its row is larger by as much
  MatrixXd a = all;
  a.row(0) *= 1e9;
  NearFactors near;
  VectorXd x = VectorXd::Zero(n), right = VectorXd::Random(n);
  right[0] *= 1e9;
  EXPECT_GT(solve(near, {a, names_of(n), weights}, right, x), 0);
  EXPECT_LT(error(a, right, x), 1e-12);
  Names some = names_of(n);  // in the other order, without the last ones, and one that is new
  some.resize(fewer);
  std::ranges::reverse(some);
  MatrixXd b = all(some, some);
  some.front() = n + 5;
  const VectorXd ones = VectorXd::Ones(fewer), force = VectorXd::Random(fewer);
  VectorXd y = VectorXd::Zero(fewer);
  EXPECT_GT(solve(near, {b, some, ones}, force, y), 0);
  EXPECT_LT(error(b, force, y), 1e-12);
  EXPECT_EQ(near.made(), 1);
}

TEST(NearFactors, AreMadeAnewForAnotherSystemAndNotOfASingularOne) {
  constexpr Index n = 90;
  const VectorXd right = VectorXd::Random(n), weights = VectorXd::Ones(n);
  const Names names = names_of(n);
  NearFactors near;
  VectorXd x = VectorXd::Zero(n);
  const MatrixXd a = system_of(n), other = MatrixXd::Random(n, n);
  EXPECT_GT(solve(near, {a, names, weights}, right, x), 0);
  EXPECT_GT(solve(near, {other, names, weights}, right, x), 0);
  EXPECT_LT(error(other, right, x), 1e-10);  // its condition is some hundreds
  EXPECT_EQ(near.made(), 2);
  MatrixXd singular = a;
  singular.row(1) = singular.row(2);
  EXPECT_FALSE(near.solve({singular, names, weights}, right, x));
  const auto nothing = near.solve({a, names, weights}, VectorXd::Zero(n), x);
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->isZero(0.0));
}

/// A system of one unknown, and one whose solution the first vector has: nothing is left to search.
TEST(NearFactors, EndWhereTheVectorsHaveTheSolution) {
  for (const Index n : {1, 5}) {
    const MatrixXd a = 3.0 * MatrixXd::Identity(n, n);
    const VectorXd right = VectorXd::Constant(n, 6.0), weights = VectorXd::Ones(n);
    NearFactors near;
    const auto x = near.solve({a, names_of(n), weights}, right, VectorXd::Zero(n));
    ASSERT_TRUE(x);
    EXPECT_LT((x->array() - 2.0).abs().maxCoeff(), 1e-15);
    EXPECT_TRUE(near.is_exact());
  }
}

/// What is solved stays where it is by factors of its own, in double precision.
TEST(NearFactors, LeadToTheStateThatFactorsOfItsOwnKeep) {
  const rondo::test::SteadyWheel w(rondo::test::box_wheel_case());
  for (const bool is_loaded : {false, true}) {
    RollingDrive d = rondo::test::cornering_drive();
    if (is_loaded) {
      d.load = 18000.0;
      d.torque = 20.0;
    }
    RollingWindow<3> window(w.harmonics, SlipDifference::bdf2);
    const RollingSolution s = rondo::test::solved(window, d);
    const RollingPoint found{s.force, s.height, s.speed};
    const RollingPoint direct = RollingSystem<3>(window.problem(), d, s.status, found).solve();
    EXPECT_LT((direct.force - found.force).norm(), 1e-11 * found.force.norm());
    EXPECT_NEAR(direct.height, found.height, 1e-13);
    EXPECT_NEAR(direct.speed, found.speed, 1e-11 * found.speed);
  }
}

}  // namespace near_factors_test
