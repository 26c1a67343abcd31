// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/coupled.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>
#include <random>

#include "rondo/contact/coupled/coupled_residual.hpp"
#include "rondo/contact/pair.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/core/complex.hpp"
#include "support/contact_oracles.hpp"
#include "support/contact_problems.hpp"

namespace coupled_test {

using namespace rondo;
using namespace rondo::contact;
using test::chain;
using test::ChainShape;
using test::largest_difference;
using test::problem_of;
using test::Solved;
using test::solved;

namespace {

/// Two decimals more than the tolerance of the residual, which is in impulses over the largest
/// m|free|; velocities follow by the spread of the masses, up to 20 here.
constexpr double same_velocity = 1e-10;

}  // namespace

TEST(SolveBlock, IsSolveLocalOnAComplexNumber) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    const Complex w{1.0 + 0.5 * u(random), 0.3 * u(random)};
    const Vec2 free{u(random), u(random)};
    const double mu = 0.75 + 0.75 * u(random), bounce = -0.2 - 0.2 * u(random);
    const LocalSolution a = solve_block({w.re, -w.im, w.im, w.re}, free, bounce, mu);
    const LocalSolution b = solve_local({free, w, bounce}, mu);
    ASSERT_EQ(a.status, b.status);
    ASSERT_LT(norm(a.impulse - b.impulse), 1e-14);  // a few roundings of numbers of order 1
  }
}

TEST(SolveBlock, ObeysTheLawOnGeneralBlocks) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int counted[3] = {0, 0, 0};
  for (int i = 0; i < 100000; ++i) {
    const double mu = 0.75 + 0.75 * u(random);
    const double nt = 0.3 * u(random);  // W_nn = 1 > μ|W_nt| up to μ = 1.5
    const Block w{1.0, nt, nt + 0.05 * u(random), 1.2 + 0.6 * u(random)};
    const Vec2 free{u(random), u(random)};
    const double bounce = std::min(0.0, 0.3 * u(random));
    const LocalSolution s = solve_block(w, free, bounce, mu);
    const Vec2 after = free + apply(w, s.impulse);
    // Divisions by W_nn - μ|W_nt| >= 0.55 and det W >= 0.48.
    ASSERT_LT(law_residual(s.impulse, after, bounce, mu, 1.0), 1e-14) << i;
    ++counted[static_cast<int>(s.status)];
  }
  for (const int n : counted) EXPECT_GT(n, 1000);
}

/// With much friction there can be several solutions; one is always found.
TEST(SolveBlock, ObeysTheLawWithMuchFriction) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int several = 0;
  for (int i = 0; i < 100000; ++i) {
    const double mu = 5.0 + 5.0 * u(random), nt = 0.8 * u(random);
    const Block w{1.0, nt, nt, 1.0 + 0.3 * u(random)};  // det W >= 0.06
    const Vec2 free{u(random), u(random)};
    const LocalSolution s = solve_block(w, free, 0.0, mu);
    several += mu * std::abs(nt) > 1.0 ? 1 : 0;
    ASSERT_LT(law_residual(s.impulse, free + apply(w, s.impulse), 0.0, mu, 1.0), 1e-12) << i;
  }
  EXPECT_GT(several, 10000);
}

TEST(CoupledResidual, SeesAnyChangeOfASolution) {
  const CoupledProblem p = problem_of(chain({.upper = 12, .lower = 9, .seed = 3}));
  const Solved s = solved(p);
  ASSERT_TRUE(s.result.converged);
  double scale = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) scale = std::max(scale, p.mass[j] * norm(p.free[j]));
  for (std::size_t j = 0; j < p.size(); ++j)
    for (const Vec2 direction : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}, Vec2{-1.0, 0.0}}) {
      std::vector<Vec2> off = s.impulse;
      off[j] += 1e-6 * scale * direction;
      EXPECT_GT(coupled_residual(p, off), 1e-9) << j;
    }
}

TEST(Coupled, OneContactIsSolveLocal) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    test::Scene scene;
    const int node = scene.add_node(2.0, {u(random), u(random)}, 1e-3);
    scene.add(ground_rows(node, {0.0, 1.0}), 0.4, -0.1);
    const CoupledProblem p = problem_of(scene);
    const Solved s = solved(p);
    const LocalSolution local = solve_local({p.free[0], scene.response[0], -0.1}, 0.4);
    ASSERT_TRUE(s.result.converged);
    ASSERT_EQ(s.status[0], local.status);
    ASSERT_LT(norm(s.impulse[0] - local.impulse), 1e-14);  // roundings of impulses of order 2
  }
}

TEST(Coupled, TwoFacetsAreSolvePair) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (const double turn : {1.5, 0.5, 1e-2, 1e-4}) {
    for (int i = 0; i < 300; ++i) {
      test::Scene scene;
      const double mu = 0.6 + 0.6 * u(random);
      const int node = scene.add_node(1.0, {u(random), u(random)});
      const Vec2 n0 = direction_at(1.6), n1 = direction_at(1.6 - turn);
      scene.add(ground_rows(node, n0), mu);
      scene.add(ground_rows(node, n1), mu);
      const CoupledProblem p = problem_of(scene);
      const Solved s = solved(p);
      const PairProblem pair{
          {p.free[0], p.free[1]}, {}, scene.response[0], rotation_between(n0, n1), {mu, mu}};
      const PairSolution expected = solve_pair(pair);
      ASSERT_TRUE(expected.converged && s.result.converged) << turn << " " << i;
      const auto w =
          pair_velocities(pair, {expected.contact[0].impulse, expected.contact[1].impulse});
      // Between facets almost in line w follows from the law to 1e-12 only over their turn.
      ASSERT_LT(norm(w[0] - s.velocity[0]), 1e-11 / std::min(turn, 0.1)) << turn << " " << i;
    }
  }
}

/// Of all statuses that obey the law, the velocities are those that the solver finds.
TEST(Coupled, MatchesTheEnumerationOfAllStatuses) {
  int tried = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const ChainShape shape{.upper = 3,
                           .lower = 3,
                           .offset = 0.1 + 0.013 * seed,
                           .mass_ratio = seed % 2 == 0 ? 0.3 : 2.0,
                           .both_ways = true,
                           .friction = 0.2 * (seed % 4),
                           .restitution = seed % 5 == 0 ? 0.5 : 0.0,
                           .shear = 0.3 * (seed % 3),
                           .noise = 0.8,
                           .turn = seed % 2 == 0 ? 1e-3 : 0.0,
                           .seed = seed};
    const CoupledProblem p = problem_of(chain(shape));
    const auto all = test::enumerate(p, 1e-12);
    const Solved s = solved(p);
    ASSERT_FALSE(all.empty()) << seed;
    ASSERT_TRUE(s.result.converged) << seed;
    double nearest = 1.0;
    for (const auto& w : all) nearest = std::min(nearest, largest_difference(w, s.velocity));
    EXPECT_LT(nearest, same_velocity) << seed << " of " << all.size();
    ++tried;
  }
  EXPECT_EQ(tried, 60);
}

TEST(Coupled, TheOrderOfContactsDoesNotMatter) {
  std::mt19937 random(6);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const test::Scene scene = chain(
        {.upper = 15, .lower = 11, .both_ways = seed % 2 == 0, .friction = 0.4, .seed = seed});
    const Solved first = solved(problem_of(scene));
    std::vector<std::size_t> order(scene.contacts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int i = 0; i < 10; ++i) {
      std::shuffle(order.begin(), order.end(), random);
      const Solved other = solved(problem_of(test::permuted(scene, order)));
      ASSERT_TRUE(other.result.converged);
      std::vector<Vec2> back(order.size());
      for (std::size_t j = 0; j < order.size(); ++j) back[order[j]] = other.velocity[j];
      ASSERT_LT(largest_difference(back, first.velocity), same_velocity) << seed;
    }
  }
}

/// A heavy body under light nodes: what they share is 1e-5 of what each has to itself.
TEST(Coupled, SweepsAloneAreEnoughWhereLittleIsShared) {
  const CoupledProblem p =
      problem_of(chain({.upper = 30, .lower = 20, .mass_ratio = 1e5, .friction = 0.3}));
  const Solved s = solved(p);
  EXPECT_TRUE(s.result.converged);
  EXPECT_LE(s.result.iterations, 3);  // each takes 1e-5 off the error, or more
}

/// 700 nodes on one heavy segment: no band, and a matrix too large to be worth it.
TEST(Coupled, SweepsGoOnWhereTheMatrixIsTooLarge) {
  test::Scene scene;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const int a = scene.add_node(1e4, {}), b = scene.add_node(1e4, {});
  for (int i = 0; i < 700; ++i) {
    const int p = scene.add_node(1.0, {u(random), -1.0 + 0.5 * u(random)});
    const SegmentTouch touch{.gap = -1e-3, .at = i / 700.0, .normal = {0.0, 1.0}};
    scene.add(node_rows(touch, 1.0, p, a, b), 0.4);
  }
  const Solved s = solved(problem_of(scene));
  EXPECT_TRUE(s.result.converged);
  EXPECT_LT(s.result.iterations, 100);
}

TEST(Coupled, ChainsOf200ContactsConverge) {
  for (const bool both_ways : {false, true})
    for (const double friction : {0.0, 0.3, 1.5})
      for (const int lower : {67, 150, 200, 400})
        for (const double mass_ratio : {1.0, 0.05}) {
          const CoupledProblem p = problem_of(chain({.upper = 200,
                                                     .lower = lower,
                                                     .mass_ratio = mass_ratio,
                                                     .both_ways = both_ways,
                                                     .friction = friction}));
          const Solved s = solved(p);
          EXPECT_TRUE(s.result.converged) << both_ways << friction << lower << mass_ratio;
          EXPECT_LE(coupled_residual(p, s.impulse), 1e-12);
          EXPECT_LT(s.result.iterations, 400) << both_ways << friction << lower << mass_ratio;
        }
}

TEST(Coupled, MeshesThatMatchConverge) {
  int iterations = 0;
  for (const double offset : {0.0, 1e-3})
    for (const double friction : {0.0, 0.3, 1.0})
      for (unsigned seed = 1; seed <= 10; ++seed) {
        const CoupledProblem p = problem_of(chain({.upper = 20,
                                                   .lower = 20,
                                                   .offset = offset,
                                                   .both_ways = true,
                                                   .friction = friction,
                                                   .seed = seed}));
        const Solved s = solved(p);
        EXPECT_TRUE(s.result.converged) << offset << " " << friction << " " << seed;
        EXPECT_LE(coupled_residual(p, s.impulse), 1e-12);
        iterations += s.result.iterations;
      }
  EXPECT_LT(iterations, 1800);  // 1433; without sweeps by pairs 5751, without slip in them 2213
}

TEST(Coupled, RedundantContactsMoveAsOne) {
  const test::Scene scene = chain({.upper = 20, .lower = 15, .seed = 7});
  const Solved once = solved(problem_of(scene));
  const Solved thrice = solved(problem_of(test::repeated(scene, 3)));
  ASSERT_TRUE(once.result.converged && thrice.result.converged);
  const std::vector<Vec2> first(thrice.velocity.begin(),
                                thrice.velocity.begin() + static_cast<long>(once.velocity.size()));
  EXPECT_LT(largest_difference(first, once.velocity), same_velocity);
}

TEST(Coupled, AWarmStartSavesIterations) {
  const CoupledProblem p = problem_of(chain({.upper = 60, .lower = 45, .both_ways = true}));
  const Solved cold = solved(p);
  EXPECT_EQ(solved(p, cold.impulse).result.iterations, 0);
  CoupledProblem next = p;
  for (Vec2& w : next.free) w = 1.001 * w;
  EXPECT_LT(solved(next, cold.impulse).result.iterations, cold.result.iterations);
  // A bad one does no harm, nor does one outside the cones.
  const Solved bad = solved(p, std::vector<Vec2>(p.size(), Vec2{-1e6, 1e9}));
  EXPECT_TRUE(bad.result.converged);
  EXPECT_LT(largest_difference(bad.velocity, cold.velocity), same_velocity);
}

TEST(Coupled, SaysWhenItHasNotConverged) {
  const CoupledProblem p = problem_of(chain({.upper = 200, .lower = 150}));
  std::vector<Vec2> r(p.size());
  std::vector<Status> status(p.size());
  CoupledWorkspace work;
  const CoupledResult one = solve_coupled(p, {.most_iterations = 1}, r, status, work);
  EXPECT_FALSE(one.converged);
  EXPECT_EQ(one.iterations, 1);
  EXPECT_GT(one.residual, 1e-12);
  EXPECT_EQ(one.residual, coupled_residual(p, r));
}

TEST(Coupled, AnImpulseThatIsNoNumberIsSeenWhereverItIs) {
  const CoupledProblem p = problem_of(chain({.upper = 20, .lower = 15}));
  for (std::size_t j = 0; j < p.size(); ++j) {
    std::vector<Vec2> r(p.size());
    r[j].x = std::nan("");
    EXPECT_TRUE(std::isnan(coupled_residual(p, r))) << j;
  }
}

/// Restitution with friction in an acute corner: there are velocities for which no impulses obey
/// the law (docs/theory.md, 4.4).
TEST(Coupled, AProblemWithoutASolutionIsReported) {
  test::Scene scene;
  const int node = scene.add_node(1.0, {0.1, -1.0});
  scene.add(ground_rows(node, direction_at(0.4)), 0.9, -0.4);
  scene.add(ground_rows(node, direction_at(2.9)), 0.9, 0.0);
  const CoupledProblem p = problem_of(scene);
  const PairProblem pair{
      {p.free[0], p.free[1]}, {-0.4, 0.0}, {1.0, 0.0}, rotation(2.5), {0.9, 0.9}};
  const bool solvable = solve_pair(pair).converged;
  ASSERT_TRUE(test::enumerate(p, 1e-9).empty() && !solvable);
  std::vector<Vec2> r(2);
  std::vector<Status> status(2);
  CoupledWorkspace work;
  const CoupledResult result = solve_coupled(p, {.most_iterations = 500}, r, status, work);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 500);
  EXPECT_EQ(result.residual, coupled_residual(p, r));
}

/// Modes that let a point move along the ground only, or not at all.
TEST(Coupled, APointThatCannotBePushedIsReported) {
  for (const Block& w : {Block{0.0, 0.0, 0.0, 1.0}, Block{}, Block{0.01, 0.1, 0.1, 1.0}}) {
    const CoupledProblem p{.free = {{-1.0, 0.5}},
                           .bounce = {0.0},
                           .friction = {0.4},
                           .row_start = {0, 1},
                           .column = {0},
                           .blocks = {w},
                           .mass = {1.0 / std::max({w[0], w[3]})}};
    EXPECT_EQ(solve_block(w, p.free[0], 0.0, 0.4).status, Status::open);
    std::vector<Vec2> r(1);
    std::vector<Status> status(1);
    CoupledWorkspace work;
    const CoupledResult result = solve_coupled(p, {.most_iterations = 50}, r, status, work);
    EXPECT_FALSE(result.converged);
    EXPECT_TRUE(std::isfinite(r[0].x) && std::isfinite(r[0].y));
  }
}

TEST(Coupled, NothingToDoTakesNoIteration) {
  CoupledProblem still = problem_of(chain({.upper = 10, .lower = 10}));
  for (Vec2& w : still.free) w = {};
  still.bounce.assign(still.size(), 0.0);
  const Solved s = solved(still);
  EXPECT_TRUE(s.result.converged);
  EXPECT_EQ(s.result.iterations, 0);
  EXPECT_EQ(s.result.residual, 0.0);
  CoupledProblem none;
  none.row_start = {0};
  EXPECT_TRUE(solved(none).result.converged);
}

}  // namespace coupled_test
