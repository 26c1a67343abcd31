// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/cone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rondo/contact/cone_pair.hpp"
#include "rondo/contact/pair.hpp"

namespace rondo::contact::cone_test {
namespace {

using Rows = std::array<Vec3, 3>;

/// Q [e^{iδ}/a ⊕ 1/A] Qᵀ of a ground that leans by γ, its frame turned about the third axis by β.
Rows delassus_of(double turn, double camber, double slope, Complex a, double axial) {
  const Complex plane = rotation(turn) / a;
  const double c = std::cos(camber), s = std::sin(camber);
  const auto axis = [&](Vec2 along) { return Vec3{along.x, c * along.y, s * along.y}; };
  const Vec2 n = direction_at(0.5 * 3.141592653589793 + slope);
  const Vec3 rows[3] = {axis(n), axis(turn90(n)), {0.0, -s, c}};
  Rows w;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto product = [&](const Vec3& q) { return Vec3{plane * q.plane(), axial * q.z}; };
    w[i] = {dot(rows[i], product(rows[0])), dot(rows[i], product(rows[1])),
            dot(rows[i], product(rows[2]))};
  }
  return w;
}

Vec3 times(const Rows& w, Vec3 r) {
  return {dot(w[0], r), dot(w[1], r), dot(w[2], r)};
}

constexpr Rows unit_rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

TEST(Cone, FourteenThousandRandomProblemsMeetTheLaw) {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> one(-1.0, 1.0), positive(0.0, 1.0);
  int of[3] = {};
  int most_turns = 0;
  for (int k = 0; k < 14000; ++k) {
    const double turn = (k % 2 == 0 ? 0.3 : 1e-3) * one(random), mass = 0.1 + positive(random);
    const double damping = 1.0 + 0.05 * positive(random);
    const Rows unit =
        delassus_of(turn, 0.2 * one(random), 0.5 * one(random), {damping, -turn}, 1.0 / damping);
    Rows w;
    for (std::size_t i = 0; i < 3; ++i) w[i] = unit[i] / mass;
    const double friction = 1.5 * positive(random), bounce = 0.3 * one(random);
    const Vec3 free{one(random), one(random), one(random)};
    const SpatialSolution s = solve_spatial({free, w, bounce}, friction);
    EXPECT_TRUE(s.converged);
    const Vec3 after = free + times(w, s.impulse);
    EXPECT_LE(law_residual(s.impulse, after, bounce, friction, mass), 2e-15) << k;
    ++of[static_cast<int>(s.status)];
    most_turns = std::max(most_turns, s.turns);
  }
  EXPECT_GT(std::min({of[0], of[1], of[2]}), 1000);
  EXPECT_LE(most_turns, 40);
}

TEST(Cone, WithoutRotationTheFirstTurnIsTheLast) {
  const SpatialSolution s = solve_spatial({{-1.0, 3.0, 4.0}, unit_rows, 0.0}, 0.5);
  EXPECT_EQ(s.status, Status::slip);
  EXPECT_LE(s.turns, 2);
  EXPECT_NEAR(s.impulse.x, 1.0, 1e-15);
  EXPECT_NEAR(s.impulse.y, -0.3, 1e-15);
  EXPECT_NEAR(s.impulse.z, -0.4, 1e-15);
}

TEST(Cone, InThePlaneItIsTheLawOfThePlane) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    const Complex w = rotation(0.3 * one(random));
    const Rows rows{Vec3{w.re, -w.im, 0}, Vec3{w.im, w.re, 0}, Vec3{0, 0, 1}};
    const double friction = std::abs(one(random)), bounce = 0.2 * one(random);
    const Vec2 free{one(random), one(random)};
    const LocalSolution plane = solve_local({free, w, bounce}, friction);
    const SpatialSolution s = solve_spatial({{free, 0.0}, rows, bounce}, friction);
    EXPECT_EQ(s.status, plane.status);
    EXPECT_NEAR(s.impulse.x, plane.impulse.x, 4e-16);
    EXPECT_NEAR(s.impulse.y, plane.impulse.y, 4e-16);
    EXPECT_EQ(s.impulse.z, 0.0);
  }
}

TEST(Cone, WithoutFrictionOrSlidingNothingIsLost) {
  const SpatialSolution smooth = solve_spatial({{-1.0, 3.0, 4.0}, unit_rows, 0.0}, 0.0);
  EXPECT_EQ(smooth.impulse.x, 1.0);
  EXPECT_EQ(std::hypot(smooth.impulse.y, smooth.impulse.z), 0.0);
  const SpatialSolution still = solve_spatial({{-1.0, 0.0, 0.0}, unit_rows, 0.0}, 0.0);
  EXPECT_EQ(still.impulse.x, 1.0);
  EXPECT_EQ(still.impulse.y, 0.0);
}

TEST(Cone, TheResidualSeesEveryWayOfBreakingTheLaw) {
  const auto residual = [](Vec3 r, Vec3 w) { return law_residual(r, w, 0.0, 0.5, 2.0); };
  EXPECT_EQ(residual({1.0, 0.3, -0.4}, {0.0, 0.0, 0.0}), 0.0);
  EXPECT_NEAR(residual({1.0, 0.3, -0.4}, {0.0, -0.6, 0.8}), 0.0, 1e-15);
  EXPECT_GT(residual({1.0, 0.3, 0.4}, {0.0, -0.6, 0.8}), 0.1);   // not against the sliding
  EXPECT_GT(residual({1.0, 0.4, -0.4}, {0.0, 0.0, 0.0}), 0.04);  // outside the cone
  EXPECT_GT(residual({1.0, 0.0, 0.0}, {0.1, 0.0, 0.0}), 0.1);    // pressed and leaving
  EXPECT_GT(residual({0.0, 0.0, 0.0}, {-0.1, 0.0, 0.0}), 0.1);   // into the ground
  EXPECT_GT(residual({1.0, 0.1, 0.0}, {0.0, -0.5, 0.0}), 0.1);   // slides with less than μ r_n
}

/// Of a corner at half the turn of its facets, hit from any side.
TEST(Cone, TwoFacetsMeetTheLawAtAnyAngle) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> one(-1.0, 1.0), positive(0.0, 1.0);
  int both_stick = 0, both_slide = 0;
  for (int k = 0; k < 20000; ++k) {
    const double damping = 1.0 + 0.05 * positive(random), turn = 0.02 * one(random);
    SpatialPair p;
    p.delassus =
        delassus_of(turn, 0.2 * one(random), 0.3 * one(random), {damping, -turn}, 1.0 / damping);
    const double corner = k % 4 == 0 ? 1e-3 : k % 4 == 1 ? 0.02 : 1.5 * positive(random) + 0.01;
    p.turn = rotation(corner);
    p.free = {-positive(random), one(random), one(random)};
    if (k % 2 == 0) p.free.y *= corner;  // into the corner
    if (k % 3 == 0) p.bounce = {0.3 * positive(random), 0.0};
    if (k % 3 == 0) p.bounce[1] = p.bounce[0] * std::cos(corner) + 0.2 * corner * one(random);
    const double friction = k % 5 == 0 ? 0.0 : 1.2 * positive(random);
    const SpatialPairSolution s = solve_spatial_pair(p, friction);
    EXPECT_TRUE(s.converged) << k << " at " << corner << ": " << s.residual;
    const auto are = [&](Status status) {
      return s.contact[0].status == status && s.contact[1].status == status;
    };
    both_stick += are(Status::stick) ? 1 : 0;
    both_slide += are(Status::slip) ? 1 : 0;
  }
  EXPECT_GT(both_stick, 100);
  EXPECT_GT(both_slide, 300);
}

/// Nothing along the corner: the law of the plane.
TEST(Cone, TwoFacetsInThePlaneAreThoseOfThePlane) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    const Complex w = rotation(0.02 * one(random)), turn = rotation(0.3 + 0.2 * one(random));
    const Vec2 free{-0.5 + 0.4 * one(random), 0.3 * one(random)};
    const double friction = 0.5 + 0.4 * one(random);
    const PairSolution plane =
        solve_pair({{free, conj(turn) * free}, {}, w, turn, {friction, friction}});
    const SpatialPairSolution s = solve_spatial_pair(
        {{free, 0.0}, {Vec3{w.re, -w.im, 0}, Vec3{w.im, w.re, 0}, Vec3{0, 0, 1}}, {}, turn},
        friction);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(s.contact[i].status, plane.contact[i].status);
      EXPECT_NEAR(s.contact[i].impulse.x, plane.contact[i].impulse.x, 1e-14);
      EXPECT_NEAR(s.contact[i].impulse.y, plane.contact[i].impulse.y, 1e-14);
      EXPECT_EQ(s.contact[i].impulse.z, 0.0);
    }
  }
}

TEST(Cone, ProjectsOnTheNearestPoint) {
  EXPECT_EQ(project_on_cone({-1.0, 0.5, 0.5}, 0.5), Vec3{});
  const Vec3 r = project_on_cone({1.0, 3.0, 4.0}, 0.5);
  EXPECT_NEAR(std::hypot(r.y, r.z), 0.5 * r.x, 1e-15);
  EXPECT_NEAR(dot(r - Vec3{1.0, 3.0, 4.0}, r), 0.0, 1e-14);
}

}  // namespace
}  // namespace rondo::contact::cone_test
