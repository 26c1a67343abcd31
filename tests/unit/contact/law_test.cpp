// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "rondo/contact/pair.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/core/complex.hpp"

namespace law_test {

using namespace rondo;
using namespace rondo::contact;

TEST(Law, OpenStickAndSlipByHand) {
  const Complex w{1.0 / 2.0, 0.0};  // a mass of 2
  const auto open = solve_local({{0.1, 3.0}, w, 0.0}, 0.5);
  EXPECT_EQ(open.status, Status::open);
  EXPECT_EQ(open.impulse, Vec2{});
  const auto stick = solve_local({{-1.0, 0.4}, w, 0.0}, 0.5);
  EXPECT_EQ(stick.status, Status::stick);
  EXPECT_NEAR(stick.impulse.x, 2.0, 1e-15);
  EXPECT_NEAR(stick.impulse.y, -0.8, 1e-15);
  const auto slip = solve_local({{-1.0, 3.0}, w, 0.0}, 0.5);
  EXPECT_EQ(slip.status, Status::slip);
  EXPECT_NEAR(slip.impulse.x, 2.0, 1e-15);
  EXPECT_NEAR(slip.impulse.y, -1.0, 1e-15);  // against the slip
  const auto bounce = solve_local({{-1.0, 0.0}, w, -0.5}, 0.0);
  EXPECT_NEAR(-1.0 + bounce.impulse.x / 2.0, 0.5, 1e-15);  // leaves at half the speed
}

/// A node that leaves while it is still inside goes on with -e w⁻ as well, or back as fast.
TEST(Law, ShiftsByHand) {
  const Law moreau{0.0, 0.25}, safe{0.0, 0.25, Impact::energy_safe};
  EXPECT_EQ(restitution_shift(moreau, -2.0, -2.0), -0.5);
  EXPECT_EQ(restitution_shift(moreau, 2.0, 2.0), 0.5);
  EXPECT_EQ(restitution_shift(safe, -2.0, -2.0), -0.5);
  EXPECT_EQ(restitution_shift(safe, 2.0, 2.0), 2.0);
  // The gap closes faster than w_n by 3 m/s: only a node that is sent back by 1 m/s takes no work.
  EXPECT_EQ(restitution_shift(safe, -2.0, 1.0), 1.0);
  EXPECT_EQ(restitution_shift(moreau, -2.0, 1.0), -0.5);
  EXPECT_EQ(restitution_shift({}, 2.0, 2.0), 0.0);
}

/// Both laws on random impacts, by the residual, which knows nothing of either: r_n > 0 means
/// w_n = -e w⁻, or w̄_n <= 0.
TEST(Law, EnergySafeImpactsDoNoWorkOnTheBody) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> velocity(-1.0, 1.0), unit(0.0, 1.0);
  int leaving = 0, work = 0;
  for (int i = 0; i < 100000; ++i) {
    const double mu = unit(random), e = i % 4 == 0 ? 0.0 : unit(random);
    const double before = velocity(random), m = 0.1 + unit(random);
    const Vec2 free{velocity(random), velocity(random)};
    const Complex delassus{1.0 / m, 0.1 / m * velocity(random)};
    for (const Impact impact : {Impact::moreau, Impact::energy_safe}) {
      const double shift = restitution_shift({mu, e, impact}, before, before);
      const Vec2 r = solve_local({free, delassus, shift}, mu).impulse;
      const Vec2 w = free + delassus * r;
      ASSERT_LT(law_residual(r, w, shift, mu, m), 1e-14 * m);
      if (r.x <= 0.0) continue;
      leaving += before > 0.0 ? 1 : 0;
      if (impact == Impact::energy_safe) {
        ASSERT_LE(before + w.x, 2e-15) << before << ' ' << e;
        continue;
      }
      ASSERT_NEAR(w.x, -e * before, 2e-15);
      work += before + w.x > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(leaving, 10000);
  EXPECT_GT(work, 1000) << "Moreau's law allows it";
}

/// The law itself, row by row, on random problems with a gyroscopic part in W.
TEST(Law, HoldsOnRandomProblems) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> velocity(-1.0, 1.0), unit(0.0, 1.0);
  for (int i = 0; i < 100000; ++i) {
    const double mu = unit(random);
    const double scale = std::pow(10.0, 4.0 * velocity(random));
    const LocalProblem p{{velocity(random), velocity(random)},
                         {scale, 0.2 * scale * velocity(random)},
                         0.5 * velocity(random)};
    const LocalSolution s = solve_local(p, mu);
    const Vec2 w = p.free + p.delassus * s.impulse;
    const double m = 1.0 / norm(p.delassus);
    ASSERT_GE(s.impulse.x, 0.0);
    ASSERT_GE(w.x + p.bounce, -1e-14);
    ASSERT_NEAR(s.impulse.x * (w.x + p.bounce), 0.0, 1e-13 * m);
    ASSERT_LE(std::abs(s.impulse.y), mu * s.impulse.x * (1 + 1e-15) + 1e-300);
    if (s.status == Status::stick) {
      ASSERT_NEAR(w.y, 0.0, 1e-14);
    }
    if (s.status == Status::slip) {
      ASSERT_LE(s.impulse.y * w.y, 1e-15 * m);
    }
    ASSERT_LT(law_residual(s.impulse, w, p.bounce, mu, m), 1e-14 * m);
  }
}

TEST(Residual, SeesEachBrokenRow) {
  const double m = 3.0, mu = 0.3;
  const auto residual = [&](Vec2 r, Vec2 w) { return law_residual(r, w, 0.0, mu, m) / m; };
  EXPECT_EQ(residual({0.0, 0.0}, {1.0, 5.0}), 0.0);            // open
  EXPECT_EQ(residual({2.0, 0.6}, {0.0, 0.0}), 0.0);            // stick on the cone's edge
  EXPECT_NEAR(residual({2.0, -0.6}, {0.0, 0.7}), 0.0, 1e-16);  // slip
  EXPECT_GT(residual({0.0, 0.0}, {-0.1, 0.0}), 0.05);          // penetrates
  EXPECT_GT(residual({1.0, 0.0}, {0.1, 0.0}), 0.05);           // pulls while it separates
  EXPECT_GT(residual({2.0, 0.6}, {0.0, 0.7}), 0.1);            // slips along its friction
  EXPECT_GT(residual({2.0, 0.3}, {0.0, -0.7}), 0.05);          // slips inside the cone
  EXPECT_GT(residual({2.0, 0.9}, {0.0, 0.0}), 0.05);           // outside the cone
  EXPECT_GT(residual({-1.0, 0.0}, {0.0, 0.0}), 0.2);           // adhesion
}

TEST(Residual, ProjectionIsTheNearestPointOfTheCone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const double mu = std::abs(x(random));
    const Vec2 r{x(random), x(random)}, p = project_on_cone(r, mu);
    ASSERT_LE(std::abs(p.y), mu * p.x + 1e-15);
    for (int j = 0; j < 50; ++j) {
      const double n = 2.0 * std::abs(x(random));
      const Vec2 q{n, mu * n * x(random)};
      ASSERT_LE(norm(r - p), norm(r - q) + 1e-12);
    }
  }
}

TEST(Residual, WithoutFrictionNothingPullsEither) {
  for (const double y : {0.0, -0.0, 1e-9}) {
    EXPECT_EQ(project_on_cone({-0.15, y}, 0.0), Vec2{});
    EXPECT_EQ(project_on_cone({0.15, y}, 0.0), (Vec2{0.15, 0.0}));
  }
  EXPECT_GT(law_residual({-1.0, 0.0}, {0.0, 0.0}, 0.0, 0.0, 1.0), 0.2);  // adhesion
}

TEST(Pair, CornerOfARightAngleWithoutFriction) {
  // Floor (normal up) and wall (normal left): each stops its own component.
  PairProblem p;
  p.delassus = {0.5, 0.0};
  const Vec2 v{2.0, -3.0}, floor{0.0, 1.0}, wall{-1.0, 0.0};
  p.free = {to_frame(floor, v), to_frame(wall, v)};
  p.turn = rotation_between(floor, wall);
  const PairSolution s = solve_pair(p);
  ASSERT_TRUE(s.converged);
  EXPECT_NEAR(s.contact[0].impulse.x, 6.0, 1e-14);
  EXPECT_NEAR(s.contact[1].impulse.x, 4.0, 1e-14);
}

/// Every angle from nearly flat to nearly closed, every friction, with restitution in half of them.
TEST(Pair, RandomCornersAreSolvedAndJudgedIndependently) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-1.0, 1.0), unit(0.0, 1.0);
  std::array<int, 3> pressing{};
  int unsolved = 0;
  for (int i = 0; i < 200000; ++i) {
    PairProblem p;
    p.delassus = {1.0, 1e-3 * x(random)};
    // A concave corner: the normals turn by 1e-3 … π - 1e-3.
    const double turn = 3.14 * std::pow(unit(random), 3.0) + 1e-3;
    p.turn = rotation(i % 3 == 0 ? -turn : turn);
    const Vec2 v{x(random), x(random)};
    p.free = {v, conj(p.turn) * v};
    const double e = i % 2 == 0 ? 0.0 : unit(random);
    const Vec2 before{x(random), x(random)};
    const Law law{0.0, e, i % 7 == 0 ? Impact::energy_safe : Impact::moreau};
    const double beside = (conj(p.turn) * before).x;
    p.bounce = {restitution_shift(law, before.x, before.x), restitution_shift(law, beside, beside)};
    const double mu = i % 5 == 0 ? 0.0 : unit(random);
    p.friction = {mu, i % 4 == 0 ? 0.5 * mu : mu};
    const PairSolution s = solve_pair(p);
    if (e == 0.0 || mu == 0.0) {
      // Nearly closed, shares and velocities carry round-off over the sine of 1e-3 at the least.
      ASSERT_TRUE(s.converged || s.residual < 1e-10)
          << s.residual << " μ " << mu << " turn " << turn << " e " << e;
    }
    // With restitution and friction at once a closed corner may have no solution
    // (docs/theory.md, 4.4).
    unsolved += s.converged ? 0 : 1;
    const std::array<Vec2, 2> r{s.contact[0].impulse, s.contact[1].impulse};
    const auto w = pair_velocities(p, r);
    for (std::size_t k = 0; k < 2 && s.converged; ++k)
      ASSERT_LT(law_residual(r[k], w[k], p.bounce[k], p.friction[k], 1.0), 2e-12 * norm(v));
    ++pressing[(r[0].x > 0.0 ? 1 : 0) + (r[1].x > 0.0 ? 1 : 0)];
  }
  for (const int n : pressing) EXPECT_GT(n, 10000);
  EXPECT_LT(unsolved, 8000);
}

TEST(Pair, SaysWhenNoCaseMeetsTheLaw) {
  PairProblem p;
  p.delassus = {1.0, 0.0};
  p.turn = rotation(2.5);
  const Vec2 v{-1.0, -2.0};
  p.free = {v, conj(p.turn) * v};
  p.friction = {0.3, 0.3};
  const PairSolution s = solve_pair(p, -1.0);  // a tolerance that nothing meets
  EXPECT_FALSE(s.converged);
  EXPECT_LT(s.residual, 1e-14);  // the best case is returned all the same
}

}  // namespace law_test
