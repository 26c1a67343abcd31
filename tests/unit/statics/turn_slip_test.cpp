// SPDX-License-Identifier: BSD-3-Clause
/// Steady rolling in three dimensions along a path that turns.
#include <gtest/gtest.h>

#include <cmath>

#include "support/solid_steady.hpp"

namespace turn_slip_test {

using namespace rondo;
using namespace rondo::statics;
using test::cambered;
using test::difference;
using test::expect_near;
using test::small_case;
using test::solved;

namespace {

/// A path of radius 4 m to the left.
RollingDrive turning() {
  RollingDrive d = test::cornering_drive();
  d.turn_slip = 0.25;
  return d;
}

}  // namespace

/// Any places: n × x is what a turn to the left, from t1 to -t2, moves them by.
TEST(TurnSlipProblem, YawsToTheLeft) {
  Eigen::VectorXd places(4);
  places << 1.0, 2.0, -3.0, 4.0;
  Eigen::VectorXd moved(6);
  moved << 0.0, 2.0, -1.0, 0.0, 4.0, 3.0;
  EXPECT_EQ(yawed<3>(places).reshaped(), moved);
  EXPECT_EQ(yawed<2>(Eigen::VectorXd::Ones(2)).reshaped(), Eigen::VectorXd::Zero(4));
}

/// The ways of a point of any forces, written out; all that is linear in one factor at a time.
TEST(TurnSlipProblem, WaysOfAPathThatTurnsAreThoseOfDisplacedPlaces) {
  constexpr Eigen::Index n = 2;
  RollingProblem<3> problem;
  problem.time = 1e-3;
  problem.base = Eigen::VectorXd::Random(3 * n);
  problem.matrix = Eigen::MatrixXd::Random(3 * n, 3 * n);
  problem.base_place = Eigen::VectorXd::Random(2 * n);
  problem.matrix_place = Eigen::MatrixXd::Random(2 * n, 3 * n);
  const RollingPoint p{Eigen::VectorXd::Random(3 * n), 0.3, 10.0};
  const RollingPath path{0.1, 0.25};
  const Eigen::VectorXd straight = gaps_and_ways(problem, p, {0.1, 0.0}),
                        turns = gaps_and_ways(problem, p, path), x = places(problem, p.force);
  const double turn = 0.25 * p.speed * problem.time;
  for (Eigen::Index j = 0; j < n; ++j) {
    EXPECT_EQ(turns[3 * j], straight[3 * j]);
    EXPECT_NEAR(turns[3 * j + 1] - straight[3 * j + 1], turn * x[2 * j + 1], 1e-15);
    EXPECT_NEAR(turns[3 * j + 2] - straight[3 * j + 2], -turn * x[2 * j], 1e-15);
  }
  const Eigen::VectorXd base = gaps_and_ways(problem, {0.0 * p.force, 0.3, 10.0}, path);
  EXPECT_LT((base + yawing_matrix(problem, turn) * p.force - turns).norm(), 1e-14);
}

/// With and without a camber and a slip angle, by each of the ways to give height and speed.
TEST(SteadyTurnSlip, APathThatTurnsIsBalancedAndMeetsTheLaw) {
  const test::SteadyWheel w(small_case());
  for (const double camber : {0.0, 0.05}) {
    RollingWindow<3> window(w.harmonics, SlipDifference::bdf2, camber, 9.81);
    const RollingDrive given = turning();
    const RollingSolution s = solved(window, given);
    EXPECT_EQ(s.path.turn_slip, given.turn_slip);
    const RollingPower power = rolling_power(window, s, spectrum_of(window, s));
    EXPECT_LE(power.residual, 1e-12);
    EXPECT_GT(std::abs(given.turn_slip * s.speed * s.forces.aligning), 0.01 * power.friction);
    RollingDrive d = given;
    d.load = s.forces.normal;
    d.traction = s.forces.heading;
    d.speed = 10.2;
    d.height = 0.0;
    RollingSolution by = solved(window, d);
    EXPECT_NEAR(by.speed, given.speed, 1e-8);
    expect_near(by.forces, s.forces, 1e-7 * s.forces.normal);
    d.traction.reset();
    d.torque = s.forces.torque;
    by = solved(window, d);
    EXPECT_NEAR(by.height, given.height, 1e-11);
    EXPECT_NEAR(by.speed, given.speed, 1e-8);
    expect_near(by.forces, s.forces, 1e-7 * s.forces.normal);
  }
}

TEST(SteadyTurnSlip, ATurnToTheRightMirrorsOneToTheLeft) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window(w.harmonics, SlipDifference::upwind);
  RollingDrive d = turning();
  d.slip_angle = 0.0;
  const RollingSolution left = solved(window, d);
  d.turn_slip = -0.25;
  const RollingSolution right = solved(window, d);
  const double round_off = 1e-9 * left.forces.normal;
  EXPECT_NEAR(left.forces.normal, right.forces.normal, round_off);
  EXPECT_NEAR(left.forces.heading, right.forces.heading, round_off);
  EXPECT_NEAR(left.forces.lateral, -right.forces.lateral, round_off);
  EXPECT_NEAR(left.forces.aligning, -right.forces.aligning, round_off);
  EXPECT_NEAR(left.forces.overturning, -right.forces.overturning, round_off);
  EXPECT_GT(left.forces.lateral, 0.01 * left.forces.normal);  // outwards
  EXPECT_LT(left.forces.aligning, -1.0);                      // against the turn
}

TEST(SteadyTurnSlip, SlopesOfAPathThatTurnsAreThoseOfDifferences) {
  const test::SteadyWheel w(small_case());
  RollingWindow<3> window = cambered(w, 9.81);
  for (const bool is_loaded : {false, true}) {
    RollingDrive d = turning();
    if (is_loaded) {
      d.load = 18000.0;
      d.torque = 20.0;
    }
    const RollingSolution s = solved(window, d);
    const double size = s.forces.normal;
    const auto by = [&](double RollingDrive::*what, double step) {
      RollingDrive more = d, less = d;
      more.*what += step;
      less.*what -= step;
      return difference(solved(window, more).forces, solved(window, less).forces, 2.0 * step);
    };
    expect_near(s.slopes.by_turn_slip.forces, by(&RollingDrive::turn_slip, 1e-6), 1e-5 * size);
    expect_near(s.slopes.by_slip_angle.forces, by(&RollingDrive::slip_angle, 1e-7), 1e-5 * size);
    expect_near(s.slopes.by_friction.forces, by(&RollingDrive::friction, 1e-6), 1e-5 * size);
    if (is_loaded) continue;
    expect_near(s.slopes.by_height.forces, by(&RollingDrive::height, 1e-8), 1e-3 * size);
    expect_near(s.slopes.by_speed.forces, by(&RollingDrive::speed, 1e-6), 1e-6 * size);
  }
}

}  // namespace turn_slip_test
