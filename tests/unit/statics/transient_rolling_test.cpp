// SPDX-License-Identifier: BSD-3-Clause
/// Wheels that roll on from a steady state, step by step.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/statics/steady/rolling_transient.hpp"
#include "support/solid_steady.hpp"

namespace transient_rolling_test {

using namespace rondo;
using namespace rondo::statics;
using test::expect_near;
using test::small_case;
using test::solved;

namespace {

/// A window of a transient with the pairs of a steady one.
RollingWindow<3> transient_of(const test::SteadyWheel& w, const RollingWindow<3>& steady,
                              double camber = 0.0) {
  RollingWindow<3> window(w.harmonics, SlipDifference::transient, camber);
  window.include(steady.pairs());
  return window;
}

}  // namespace

/// Any matrices, written out.
TEST(TransientRolling, WaysAreCountedFromTheForcesOfTheStepBefore) {
  RollingProblem<3> p;
  p.time = 1.0;
  p.base = Eigen::VectorXd::Random(6);
  p.matrix = Eigen::MatrixXd::Random(6, 6);
  p.upstream = Eigen::MatrixXd::Random(6, 6);
  p.before = Eigen::VectorXd::Zero(6);
  const Eigen::VectorXd base = p.base, once = Eigen::VectorXd::Random(6),
                        then = Eigen::VectorXd::Random(6);
  roll_on_from(p, once);
  roll_on_from(p, then);
  EXPECT_LT((p.base - (base - p.upstream * then)).norm(), 1e-14);
  EXPECT_EQ(p.before, then);
}

/// The law of a transient is that of steady rolling where the forces are those of the step before;
/// with and without a camber, at a held height and speed or under a held load and traction.
TEST(TransientRolling, ASteadyStateStays) {
  const test::SteadyWheel w(small_case());
  for (const double camber : {0.0, 0.05}) {
    RollingWindow<3> steady(w.harmonics, SlipDifference::upwind, camber);
    RollingDrive d = test::cornering_drive();
    d.turn_slip = 0.1;
    const RollingSolution s = solved(steady, d);
    RollingWindow<3> window = transient_of(w, steady, camber);
    RollingSolution next = roll_on(window, d, s);
    ASSERT_EQ(next.end, RollingEnd::solved);
    expect_near(next.forces, s.forces, 1e-9 * s.forces.normal);
    d.load = s.forces.normal;
    d.traction = s.forces.heading;
    next = roll_on(window, d, next);
    ASSERT_EQ(next.end, RollingEnd::solved);
    EXPECT_NEAR(next.speed, s.speed, 1e-8 * s.speed);
    EXPECT_NEAR(next.height, s.height, 1e-9 * s.height);
  }
}

/// After a change of the slip angle; the window grows on the way, and steps of the load held and a
/// free rim lead to the state that is solved for at once.
TEST(TransientRolling, RollsFromOneSteadyStateToTheNext) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> steady(w.harmonics, SlipDifference::upwind);
  RollingDrive d;
  d.load = 2000.0;
  d.torque = 0.0;
  d.speed = 10.0;
  d.friction = 0.4;
  const RollingSolution straight = solved(steady, d);
  RollingWindow<3> window = transient_of(w, steady);
  const auto pairs = window.pairs().size();
  d.slip_angle = 0.03;
  d.load = 9000.0;
  const RollingSolution corners = solved(steady, d);
  RollingSolution s = straight;
  double before = 0.0;
  for (int n = 0; n < 150; ++n) {
    s = roll_on(window, d, s);
    ASSERT_EQ(s.end, RollingEnd::solved) << n;
    EXPECT_LE(s.residual, 1e-10);
    if (n == 0) {
      EXPECT_LT(std::abs(s.forces.lateral), 0.2 * std::abs(corners.forces.lateral));
    }
    if (n < 10) {
      EXPECT_GT(std::abs(s.forces.lateral), before) << n;
    }
    before = std::abs(s.forces.lateral);
  }
  EXPECT_GT(window.pairs().size(), pairs);
  expect_near(s.forces, corners.forces, 1e-6 * corners.forces.normal);
  EXPECT_NEAR(s.speed, corners.speed, 1e-6 * s.speed);
}

/// So that the steps of wheels that differ by a part of a sector do not feel each other.
TEST(TransientRolling, SlowRollingCouplesNothingButNodesOfOneWheel) {
  const test::SteadyWheel w(small_case(3));
  RollingBody<3> body = w.harmonics.body();
  body.inertia = RollingInertia::none;
  body.mass_damping = body.stiffness_damping = 0.0;
  const RollingHarmonics<3> slow(body);
  const double own = slow.compliance(0, 0, 0).norm();
  for (int ahead = 1; ahead < slow.turn(); ++ahead) {
    const double moved = slow.compliance(1, 0, ahead).norm();
    if (ahead % 3 == 0)
      EXPECT_GT(moved, 1e-5 * own) << ahead;
    else
      EXPECT_LT(moved, 1e-12 * own) << ahead;
  }
}

}  // namespace transient_rolling_test
