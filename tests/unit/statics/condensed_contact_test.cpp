// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/condensed_contact.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "rondo/contact/residual.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/lemke.hpp"

namespace condensed_contact_test {

using namespace rondo;
using contact::Status;
using Eigen::Index;

namespace {

/// Symmetric, positive, of order 1, its candidates coupled as those of a body are.
Eigen::MatrixXd random_compliance(Index m, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd a(2 * m, 2 * m);
  for (double& x : a.reshaped()) x = 0.3 * uniform(random);
  return a * a.transpose() + Eigen::MatrixXd::Identity(2 * m, 2 * m);
}

Eigen::VectorXd random_free(Index m, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd free(2 * m);
  for (double& x : free) x = uniform(random);
  return free;
}

/// Forces of one choice of statuses, 0 open, 1 stick, 2 and 3 slip; a linear system written with a
/// row for every unknown.
Eigen::VectorXd of_choice(const statics::CondensedProblem& p, int choice) {
  const Index size = p.free.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  for (Index j = 0; j < size / 2; ++j, choice /= 4) {
    const Index n = 2 * j, t = n + 1;
    a(n, n) = a(t, t) = 1.0;
    const int status = choice % 4;
    if (status == 0) continue;
    a.row(n) = p.compliance.row(n);
    b[n] = -p.free[n];
    if (status == 1) {
      a.row(t) = p.compliance.row(t);
      b[t] = -p.free[t];
    } else {
      a(t, n) = (status == 2 ? -1.0 : 1.0) * p.friction[at(j)];
    }
  }
  return a.partialPivLu().solve(b);
}

/// From 0 to twice `mean`, other ones for each candidate.
statics::CandidateFriction mixed_friction(Index m, double mean, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 2.0 * mean);
  std::vector<double> each;
  for (Index j = 0; j < m; ++j) each.push_back(j == 0 ? 0.0 : uniform(random));
  return statics::CandidateFriction(std::move(each));
}

}  // namespace

TEST(SolveBlock, HoldsTheLawOnRandomBlocks) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::array<int, 3> seen{};
  for (int k = 0; k < 20000; ++k) {
    const double friction = k % 4 == 0 ? 0.0 : 1.5 * std::abs(uniform(random));
    const double normal = 0.1 + std::abs(uniform(random));
    const double shear = 0.1 + std::abs(uniform(random));
    const double most = std::min(std::sqrt(normal * shear), normal / std::max(friction, 1e-9));
    const statics::BlockProblem p{
        {uniform(random), uniform(random)}, normal, 0.99 * most * uniform(random), shear};
    const auto s = statics::solve_block(p, friction);
    const Vec2 w = {p.free.x + p.normal * s.impulse.x + p.mixed * s.impulse.y,
                    p.free.y + p.mixed * s.impulse.x + p.shear * s.impulse.y};
    // Forces are of order |free|/block; near the bound on `mixed` a block is nearly singular.
    const double scale = 1.0 + norm(s.impulse);
    EXPECT_LT(contact::law_residual(s.impulse, w, 0.0, friction, 1.0 / normal), 1e-11 * scale);
    ++seen[static_cast<std::size_t>(s.status)];
    EXPECT_EQ(s.status == Status::stick, norm(w) < 1e-12 * scale && s.impulse.x > 0.0);
  }
  for (const int n : seen) EXPECT_GT(n, 1000);
}

TEST(SolveCondensed, FindsWhatEnumerationFinds) {
  std::mt19937_64 random(2);
  int slipping = 0, sticking = 0;
  for (int k = 0; k < 300; ++k) {
    constexpr Index m = 4;
    const Eigen::MatrixXd g = random_compliance(m, random);
    const statics::CondensedProblem p{g, random_free(m, random), k % 3 == 0 ? 0.0 : 0.4};
    statics::CondensedSolution s{Eigen::VectorXd::Zero(2 * m), {}};
    const auto report = statics::solve_condensed(p, {}, s);
    ASSERT_TRUE(report.converged) << k;
    EXPECT_LT(statics::condensed_residual(p, s.force, p.free + g * s.force), 1e-12);
    int solutions = 0, the_same = 0;
    for (int choice = 0; choice < 256; ++choice) {
      const Eigen::VectorXd r = of_choice(p, choice);
      if (statics::condensed_residual(p, r, p.free + g * r) > 1e-10) continue;
      ++solutions;
      the_same += (r - s.force).norm() < 1e-9 ? 1 : 0;  // residual 1e-10 times a condition of 10
    }
    EXPECT_GE(solutions, 1) << k;
    EXPECT_EQ(the_same, solutions) << k;
    for (const Status status : s.status) {
      slipping += status == Status::slip ? 1 : 0;
      sticking += status == Status::stick ? 1 : 0;
    }
  }
  EXPECT_GT(slipping, 100);
  EXPECT_GT(sticking, 50);
}

/// Each candidate has a coefficient of its own, and by the others' the forces are no solution.
TEST(SolveCondensed, HasTheCoefficientOfEachCandidate) {
  std::mt19937_64 random(21);
  int by_others = 0;
  for (int k = 0; k < 100; ++k) {
    constexpr Index m = 4;
    const Eigen::MatrixXd g = random_compliance(m, random);
    statics::CondensedProblem p{g, random_free(m, random), mixed_friction(m, 0.4, random)};
    statics::CondensedSolution s{Eigen::VectorXd::Zero(2 * m), {}};
    ASSERT_TRUE(statics::solve_condensed(p, {}, s).converged) << k;
    int solutions = 0;
    for (int choice = 0; choice < 256; ++choice) {
      const Eigen::VectorXd r = of_choice(p, choice);
      if (statics::condensed_residual(p, r, p.free + g * r) > 1e-10) continue;
      ++solutions;
      EXPECT_LT((r - s.force).norm(), 1e-9) << k;  // residual 1e-10 times a condition of 10
    }
    EXPECT_GE(solutions, 1) << k;
    p.friction = 0.4;
    by_others += statics::condensed_residual(p, s.force, p.free + g * s.force) > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(by_others, 50);
}

TEST(SolveCondensed, EqualCoefficientsGiveTheBitsOfAConstant) {
  std::mt19937_64 random(22);
  const Eigen::MatrixXd g = random_compliance(30, random);
  const Eigen::VectorXd free = random_free(30, random);
  const statics::CondensedProblem one{g, free, 0.4},
      each{g, free, statics::CandidateFriction(std::vector<double>(30, 0.4))};
  for (const int before_pivoting : {300, 1}) {
    const statics::CondensedLimits limits{.tolerance = 1e-12,
                                          .sweeps_before_pivoting = before_pivoting};
    statics::CondensedSolution a{Eigen::VectorXd::Zero(60), {}}, b = a;
    const auto report = statics::solve_condensed(one, limits, a);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.pivots > 0, before_pivoting == 1);
    EXPECT_TRUE(statics::solve_condensed(each, limits, b).converged);
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.status, b.status);
  }
}

TEST(SolveCondensed, StartsFromTheSolutionInOneLook) {
  std::mt19937_64 random(3);
  const Eigen::MatrixXd g = random_compliance(30, random);
  const statics::CondensedProblem p{g, random_free(30, random), 0.4};
  statics::CondensedSolution s{Eigen::VectorXd::Zero(60), {}};
  ASSERT_TRUE(statics::solve_condensed(p, {}, s).converged);
  const Eigen::VectorXd before = s.force;
  const auto again = statics::solve_condensed(p, {}, s);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.direct_solves, 1);
  EXPECT_LT((s.force - before).norm(), 1e-12 * before.norm());
}

TEST(SolveCondensed, AResidualThatIsNoNumberIsNotForgotten) {
  std::mt19937_64 random(5);
  const Eigen::MatrixXd g = random_compliance(3, random);
  const statics::CondensedProblem p{g, random_free(3, random), 0.4};
  for (const Index bad : {0, 2, 5}) {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(6);
    r[bad] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(statics::condensed_residual(p, r, p.free) <= 1e300) << bad;
  }
}

TEST(SolveCondensed, SaysThatItDidNotConverge) {
  std::mt19937_64 random(4);
  const Eigen::MatrixXd g = random_compliance(40, random);
  const statics::CondensedProblem p{g, random_free(40, random), 0.4};
  statics::CondensedSolution s{Eigen::VectorXd::Zero(80), {}};
  const auto report = statics::solve_condensed(p, {.tolerance = 1e-12, .sweeps = 1}, s);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.sweeps, 1);
  EXPECT_GT(report.residual, 1e-12);
  EXPECT_EQ(report.residual, statics::condensed_residual(p, s.force, p.free + g * s.force));
}

TEST(SolveCondensed, NoForceWhereAllIsOpen) {
  const Eigen::MatrixXd g = Eigen::MatrixXd::Identity(4, 4);
  const statics::CondensedProblem p{g, Eigen::VectorXd::Constant(4, 1.0), 0.4};
  statics::CondensedSolution s{Eigen::VectorXd::Constant(4, 7.0), {}};
  EXPECT_TRUE(statics::solve_condensed(p, {}, s).converged);
  EXPECT_EQ(s.force.norm(), 0.0);
  EXPECT_EQ(s.status[1], Status::open);
}

namespace {

/// Forces of all choices of statuses that hold the law.
std::vector<Eigen::VectorXd> enumerate(const statics::CondensedProblem& p) {
  std::vector<Eigen::VectorXd> found;
  const int choices = 1 << p.free.size();  // 4 to the power of the candidates
  for (int choice = 0; choice < choices; ++choice) {
    const Eigen::VectorXd r = of_choice(p, choice);
    if (statics::condensed_residual(p, r, p.free + p.compliance * r) < 1e-10) found.push_back(r);
  }
  return found;
}

constexpr statics::CondensedLimits sweeps_alone{1e-12, 0, 5000};

}  // namespace

/// Little friction: there is one solution, and the complementary form has it, unpolished.
TEST(Pivoting, FindsWhatEnumerationFinds) {
  std::mt19937_64 random(5);
  int slipping = 0, sticking = 0;
  for (int k = 0; k < 300; ++k) {
    constexpr Index m = 4;
    const Eigen::MatrixXd g = random_compliance(m, random);
    const statics::CondensedProblem p{g, random_free(m, random), k % 3 == 0 ? 0.0 : 0.4};
    const statics::ComplementaryForm form = statics::make_complementary(p);
    statics::LcpSolution lcp;
    ASSERT_EQ(statics::solve_lemke(form.lcp, 1000, lcp).end, statics::LemkeEnd::solved);
    Eigen::VectorXd r(2 * m);
    for (Index j = 0; j < m; ++j) {
      r[2 * j] = form.force * lcp.z[j];
      r[2 * j + 1] = form.force * lcp.z[m + j] - p.friction[at(j)] * r[2 * j];
      const double edge = p.friction[at(j)] * r[2 * j] - std::abs(r[2 * j + 1]);
      slipping += r[2 * j] > 0.0 && edge < 1e-9 ? 1 : 0;
      sticking += edge > 1e-9 ? 1 : 0;
    }
    const auto all = enumerate(p);
    ASSERT_FALSE(all.empty()) << k;
    for (const auto& other : all) EXPECT_LT((other - r).norm(), 1e-9) << k;  // as above
  }
  EXPECT_GT(slipping, 100);
  EXPECT_GT(sticking, 50);
}

/// The pivoting alone, with a coefficient of each candidate, small and large: a solution of the
/// complementary form is one of the law.
TEST(Pivoting, HasTheCoefficientOfEachCandidate) {
  std::mt19937_64 random(23);
  for (int k = 0; k < 60; ++k) {
    constexpr Index m = 20;
    const Eigen::MatrixXd g =
        random_compliance(m, random) - 0.9 * Eigen::MatrixXd::Identity(2 * m, 2 * m);
    const statics::CondensedProblem p{g, random_free(m, random),
                                      mixed_friction(m, k % 2 == 0 ? 0.4 : 5.0, random)};
    const statics::ComplementaryForm form = statics::make_complementary(p);
    statics::LcpSolution lcp;
    ASSERT_EQ(statics::solve_lemke(form.lcp, 5000, lcp).end, statics::LemkeEnd::solved) << k;
    Eigen::VectorXd r(2 * m);
    for (Index j = 0; j < m; ++j) {
      r[2 * j] = form.force * lcp.z[j];
      r[2 * j + 1] = form.force * lcp.z[m + j] - p.friction[at(j)] * r[2 * j];
    }
    EXPECT_LT(statics::condensed_residual(p, r, p.free + g * r), 1e-8) << k;
    statics::CondensedSolution s{Eigen::VectorXd::Zero(2 * m), {}};
    EXPECT_TRUE(
        statics::solve_condensed(p, {.tolerance = 1e-10, .sweeps_before_pivoting = 1}, s).converged)
        << k;
  }
}

/// Much friction: the sweeps may cycle, and there may be several solutions, but there always is one
/// (docs/theory.md, 6.4), and the default limits find it.
TEST(Pivoting, SolvesWhatSweepsDoNot) {
  std::mt19937_64 random(6);
  int several = 0, mended = 0;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::MatrixXd g =
        random_compliance(3, random) - 0.98 * Eigen::MatrixXd::Identity(6, 6);  // positive still
    const statics::CondensedProblem p{g, random_free(3, random), 4.0};
    statics::CondensedSolution swept{Eigen::VectorXd::Zero(6), {}}, solved = swept;
    const bool by_sweeps = statics::solve_condensed(p, sweeps_alone, swept).converged;
    const auto report = statics::solve_condensed(p, {}, solved);
    ASSERT_TRUE(report.converged) << k;
    mended += by_sweeps ? 0 : 1;
    EXPECT_EQ(report.pivoting == statics::Pivoting::none, report.sweeps < 300) << k;
    EXPECT_EQ(report.pivots == 0, report.sweeps < 300) << k;
    const auto all = enumerate(p);
    double nearest = 1.0;
    for (const auto& r : all)
      nearest = std::min(nearest, (r - solved.force).norm() / std::max(1.0, r.norm()));
    EXPECT_LT(nearest, 1e-7) << k;  // residual 1e-10, condition up to 1e3
    for (const auto& r : all)
      if ((r - all.front()).norm() > 1e-3 * r.norm()) {
        ++several;
        break;
      }
  }
  EXPECT_GT(mended, 5);
  EXPECT_GT(several, 5);
}

/// Large problems far from little friction: the covering vector excludes a ray.
TEST(Pivoting, EndsOnASolutionForAnyFriction) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 60; ++k) {
    const double friction = std::array{0.5, 1.5, 5.0, 100.0}[static_cast<std::size_t>(k % 4)];
    const Eigen::MatrixXd g =
        random_compliance(30, random) - 0.9 * Eigen::MatrixXd::Identity(60, 60);
    const statics::CondensedProblem p{g, random_free(30, random), friction};
    const statics::ComplementaryForm form = statics::make_complementary(p);
    statics::LcpSolution s;
    ASSERT_EQ(statics::solve_lemke(form.lcp, 5000, s).end, statics::LemkeEnd::solved) << k;
    const Eigen::VectorXd y = form.lcp.q + form.lcp.matrix * s.z;
    EXPECT_LT(s.z.cwiseMin(y).cwiseAbs().maxCoeff(), 1e-9 * (1.0 + s.z.maxCoeff())) << k;
  }
}

/// One candidate with q > s and μ q > p: with a covering vector of ones there is a ray, for some of
/// these gaps and slips the end of the path.
TEST(Pivoting, CoveringVectorExcludesTheRay) {
  const Eigen::MatrixXd g = (Eigen::MatrixXd(2, 2) << 4.0, 1.5, 1.5, 1.0).finished();
  int rays = 0;
  for (int k = 0; k < 360; ++k) {
    const double angle = 0.0174 * k;
    const statics::CondensedProblem p{
        g, (Eigen::VectorXd(2) << std::cos(angle), std::sin(angle)).finished(), 10.0};
    statics::ComplementaryForm form = statics::make_complementary(p);
    statics::LcpSolution s;
    EXPECT_EQ(statics::solve_lemke(form.lcp, 100, s).end, statics::LemkeEnd::solved) << k;
    form.lcp.cover.setOnes();
    rays += statics::solve_lemke(form.lcp, 100, s).end == statics::LemkeEnd::ray ? 1 : 0;
  }
  EXPECT_GT(rays, 0);
}

}  // namespace condensed_contact_test
