// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/lemke.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <Eigen/LU>
#include <random>

namespace lemke_test {

using namespace rondo;
using Eigen::Index;
using statics::LemkeEnd;

namespace {

Eigen::MatrixXd random_matrix(Index n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd a(n, n);
  for (double& x : a.reshaped()) x = uniform(random);
  return a;
}

statics::LemkeReport solve(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                           statics::LcpSolution& s, int max_pivots = 1000) {
  return statics::solve_lemke({m, q, Eigen::VectorXd::Ones(q.size())}, max_pivots, s);
}

/// Largest violation of 0 <= z, y and z y = 0.
double violation(const Eigen::MatrixXd& m, const Eigen::VectorXd& q, const Eigen::VectorXd& z) {
  return z.cwiseMin(q + m * z).cwiseAbs().maxCoeff();
}

/// Any solution, by all choices of the z_i that may be positive.
bool has_solution(const Eigen::MatrixXd& m, const Eigen::VectorXd& q) {
  const Index n = q.size();
  for (int choice = 0; choice < 1 << n; ++choice) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i) {
      if ((choice >> i & 1) == 0) continue;
      a.row(i) = m.row(i);
      b[i] = -q[i];
    }
    const Eigen::VectorXd z = a.partialPivLu().solve(b);
    if (z.allFinite() && violation(m, q, z) < 1e-10) return true;
  }
  return false;
}

}  // namespace

/// A positive matrix (x M x > 0, not symmetric) has exactly one solution, for every q.
TEST(Lemke, SolvesPositiveMatrices) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200; ++k) {
    const Index n = 1 + k % 40;
    const Eigen::MatrixXd a = random_matrix(n, random), b = random_matrix(n, random);
    const Eigen::MatrixXd m =
        a * a.transpose() + b - b.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd q = random_matrix(n, random).col(0);
    statics::LcpSolution s;
    const auto report = solve(m, q, s);
    ASSERT_EQ(report.end, LemkeEnd::solved) << k;
    EXPECT_LT(violation(m, q, s.z), 1e-10) << k;  // some 1e2 pivots of condition up to 1e3
    for (Index i = 0; i < n; ++i)
      EXPECT_TRUE(s.basic[static_cast<std::size_t>(i)] || s.z[i] == 0.0);
  }
}

/// Any matrix: what is called a solution is one, and a problem without any ends on a ray.
TEST(Lemke, AgreesWithEnumeration) {
  std::mt19937_64 random(2);
  int solved = 0, none = 0;
  for (int k = 0; k < 500; ++k) {
    const Eigen::MatrixXd m = random_matrix(4, random);
    const Eigen::VectorXd q = random_matrix(4, random).col(0);
    statics::LcpSolution s;
    const auto report = solve(m, q, s);
    ASSERT_NE(report.end, LemkeEnd::limit) << k;
    if (report.end == LemkeEnd::solved) {
      EXPECT_LT(violation(m, q, s.z), 1e-10) << k;
      ++solved;
    }
    if (!has_solution(m, q)) {
      EXPECT_EQ(report.end, LemkeEnd::ray) << k;
      ++none;
    }
  }
  EXPECT_GT(solved, 100);
  EXPECT_GT(none, 20);
}

TEST(Lemke, EndsOnARayWhereThereIsNoSolution) {
  // y = -1 - z < 0 for all z >= 0.
  statics::LcpSolution s;
  const auto one = solve(-Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Constant(1, -1.0), s);
  EXPECT_EQ(one.end, LemkeEnd::ray);
  EXPECT_EQ(s.z.norm(), 0.0);
  // y_1 = -1 - z_2 < 0, though y_2 can be met.
  const Eigen::MatrixXd m = (Eigen::MatrixXd(2, 2) << 0.0, -1.0, 1.0, 1.0).finished();
  EXPECT_EQ(solve(m, Eigen::VectorXd::Constant(2, -1.0), s).end, LemkeEnd::ray);
}

/// Small whole numbers: rows tie at most pivots. Without a rule for ties it may go round for ever.
TEST(Lemke, TiesDoNotCycle) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> small(-1, 1);
  for (int k = 0; k < 300; ++k) {
    const Index n = 2 + k % 30;
    Eigen::MatrixXd a(n, n);
    for (double& x : a.reshaped()) x = small(random);
    Eigen::VectorXd q(n);
    for (double& x : q) x = std::min(0, small(random));
    const Eigen::MatrixXd m = a * a.transpose() + Eigen::MatrixXd::Identity(n, n);
    statics::LcpSolution s;
    ASSERT_EQ(solve(m, q, s).end, LemkeEnd::solved) << k;
    EXPECT_LT(violation(m, q, s.z), 1e-11) << k;  // condition up to 1e3
  }
}

/// Goes round for ever where ties are left to chance (Kostreva, Math. Program. 16 (1979) 127).
TEST(Lemke, KostrevasExampleDoesNotCycle) {
  const Eigen::MatrixXd m =
      (Eigen::MatrixXd(3, 3) << 1.0, 2.0, 0.0, 0.0, 1.0, 2.0, 2.0, 0.0, 1.0).finished();
  for (const double scale : {1.0, 3.0}) {  // in thirds the ties are not exact
    statics::LcpSolution s;
    const auto report = solve(m / scale, Eigen::VectorXd::Constant(3, -1.0 / scale), s);
    ASSERT_EQ(report.end, LemkeEnd::solved);
    EXPECT_LT((s.z.array() - 1.0 / 3.0).abs().maxCoeff(), 1e-14);
  }
}

TEST(Lemke, NothingToDoAndTooFewPivots) {
  std::mt19937_64 random(3);
  const Eigen::MatrixXd a = random_matrix(10, random);
  const Eigen::MatrixXd m = a * a.transpose();
  statics::LcpSolution s;
  const auto none = solve(m, Eigen::VectorXd::Constant(10, 1.0), s);
  EXPECT_EQ(none.end, LemkeEnd::solved);
  EXPECT_EQ(none.pivots, 0);
  EXPECT_EQ(s.z.norm(), 0.0);
  const auto few = solve(m, Eigen::VectorXd::Constant(10, -1.0), s, 2);
  EXPECT_EQ(few.end, LemkeEnd::limit);
  EXPECT_EQ(few.pivots, 2);
}

}  // namespace lemke_test
