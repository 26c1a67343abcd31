// SPDX-License-Identifier: BSD-3-Clause
/// Friction over slip speed and pressure in steady rolling.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "rondo/statics/steady/law/rolling_friction.hpp"
#include "support/falling_friction.hpp"
#include "support/solid_steady.hpp"
#include "support/steady_body.hpp"

namespace rolling_friction_test {

using namespace rondo;
using namespace rondo::statics;
using contact::FrictionTable;
using contact::Status;
using test::difference;
using test::expect_near;

namespace {

/// Factors 1 at rest, .8 at 1 m/s and .5 at 10 m/s; less under pressure.
FrictionTable rubber() {
  return {.coefficient = 1.0,
          .slip = {{0.0, 1.0}, {1.0, 0.8}, {10.0, 0.5}},
          .pressure_exponent = -0.15,
          .pressure_reference = 1e5,
          .patches = {}};
}

test::DiskCase disk_case() {
  test::DiskCase c = test::rolling_disk(6, 90);
  c.motion.angular_velocity = dynamics::Table(10.0 / 0.3);
  return c;
}

std::vector<double> lengths(const test::SteadyBody& b) {
  std::vector<double> of_node(b.mesh.n_nodes()), lengths;
  for (std::size_t k = 0; k < b.mesh.boundary.size(); ++k)
    of_node[static_cast<std::size_t>(b.mesh.boundary[k])] = b.mesh.tributary[k];
  for (const int row : b.harmonics->body().candidates)
    lengths.push_back(of_node[b.sector.node(static_cast<std::size_t>(row), 0)]);
  return lengths;
}

/// The largest difference of a coefficient from that of the law at the state itself; the residual
/// of the law with these.
template <int D>
void expect_own_coefficients(const RollingWindow<D>& w, const RollingDrive& d,
                             const RollingSolution& s) {
  ASSERT_EQ(s.end, RollingEnd::solved) << s.residual;
  const auto own = frictions_at(w.problem(), d, {s.force, s.height, s.speed});
  ASSERT_EQ(own.size(), s.pairs.size());
  for (std::size_t j = 0; j < own.size(); ++j) {
    if (s.status[j].status == Status::open) continue;
    EXPECT_NEAR(d.friction * s.pairs[j].factor, d.friction * own[j].factor, coefficient_bound);
  }
  EXPECT_LT(rolling_residual(w, s, {d.friction, own}), 1e-9);
  EXPECT_LT(rolling_power(w, s, spectrum_of(w, s)).residual, 1e-10);
}

}  // namespace

/// Hertz's pressure with q = μ0 (p/p_ref)^k p: a ratio of two beta functions.
TEST(RollingFriction, APowerOfThePressureHasTheForceOfItsIntegral) {
  const test::LineContact line;
  const RollingProblem<2> problem = line.problem();
  const double k = -0.2, reference = 495.3 / 3.0;
  const RollingFriction law{{.coefficient = 1.0,
                             .slip = {},
                             .pressure_exponent = k,
                             .pressure_reference = reference,
                             .patches = {}},
                            {line.element * line.length}};
  RollingDrive drive = line.drive(-0.05, 0.3);
  drive.law = &law;
  const RollingForces f = forces_of(problem, line.solved(problem, drive).point);
  const double expected = std::pow(3.0, k) * std::beta(0.5, 1.5 + 0.5 * k) / std::beta(0.5, 1.5);
  EXPECT_NEAR(std::abs(f.heading) / (0.3 * f.normal), expected, 1e-3);
  EXPECT_LT(expected, 0.87);
}

TEST(RollingFriction, ALawThatIsConstantHasTheBitsOfTheConstant) {
  const test::SteadyBody b(disk_case(), 4, true);
  RollingWindow<2> w = b.window(SlipDifference::bdf2), other = w;
  const RollingFriction law{{.coefficient = 1.0, .slip = {{0.0, 1.0}, {1.0, 1.0}}, .patches = {}},
                            lengths(b)};
  RollingDrive d = test::at_height(0.4);
  const RollingSolution constant = solve_rolling(w, d);
  d.law = &law;
  const RollingSolution found = solve_rolling(other, d);
  ASSERT_EQ(found.end, RollingEnd::solved);
  EXPECT_EQ(constant.force, found.force);
  EXPECT_EQ(constant.slopes.by_speed.forces.heading, found.slopes.by_speed.forces.heading);
  EXPECT_EQ(found.friction.steps, 1);
  EXPECT_EQ(found.friction.restarts, 0);
}

TEST(RollingFriction, EachPairHasTheCoefficientOfItsOwnSlipAndPressure) {
  const test::SteadyBody b(disk_case(), 8, true);
  RollingWindow<2> w = b.window(SlipDifference::bdf2);
  const RollingFriction law{rubber(), lengths(b)};
  RollingDrive d = test::at_height(0.4);
  d.law = &law;
  const RollingSolution s = solve_rolling(w, d);
  expect_own_coefficients(w, d, s);
  for (std::size_t j = 0; j < s.pairs.size(); ++j) {
    if (s.status[j].status != Status::slip) continue;
    const auto row = static_cast<Eigen::Index>(2 * j);
    const double pressure = s.force[row] / law.extent[0];
    const double expected = (1.0 - 0.2 * std::abs(s.gap_and_slip[row + 1])) *
                            std::pow(std::clamp(pressure / 1e5, 0.1, 10.0), -0.15);
    EXPECT_NEAR(std::abs(s.force[row + 1]), 0.4 * expected * s.force[row], 1e-9 * s.forces.normal);
  }
  EXPECT_GE(s.friction.steps, 8);
  RecordProperty("problems", s.friction.problems);
}

/// A tread under much friction, which Newton's method does not end on: the complementary problem
/// has the coefficient of each pair.
TEST(RollingFriction, PivotingHasTheCoefficientOfEachPair) {
  test::DiskCase c = test::rolling_disk(3, 0);
  c.disk.tread = mesh::Tread{20, 0.02, 3, 1, 2};
  const test::SteadyBody b(c, 16, true);
  for (const double spread : {0.0, 0.1, 0.2, 0.3}) {
    RollingWindow<2> w = b.window(SlipDifference::bdf2);
    RollingDrive d = test::at_height(2.0);
    d.speed = 9.0;
    const RollingSolution constant = solve_rolling(w, d);
    ASSERT_EQ(constant.end, RollingEnd::solved);
    for (std::size_t j = 0; j < w.pairs().size(); ++j)
      d.pairs.push_back({.factor = 1.0 + spread * (j % 2 == 0 ? 1.0 : -1.0)});
    const RollingSolution s = solve_rolling(w, d);
    ASSERT_EQ(s.end, RollingEnd::solved) << spread << " " << s.residual;
    EXPECT_LT(rolling_residual(w, s, d.coefficients()), 1e-10);
    EXPECT_EQ(rolling_residual(w, s, d.friction) > 1e-6, spread > 0.0);
    EXPECT_GT(s.effort.pivots, 100) << spread;
  }
}

TEST(RollingFriction, SlopesInThePlaneAreThoseOfDifferences) {
  const test::SteadyBody b(disk_case(), 8, true);
  RollingWindow<2> w = b.window(SlipDifference::bdf2);
  const RollingFriction law{rubber(), lengths(b)};
  RollingDrive d = test::at_height(0.4);
  d.law = &law;
  const auto by = [&](const RollingSolution& near,
                      const std::function<void(RollingDrive&, double)>& change, double step) {
    RollingDrive more = d, less = d;
    change(more, step);
    change(less, -step);
    return difference(solve_rolling_from(w, more, near).forces,
                      solve_rolling_from(w, less, near).forces, 2.0 * step);
  };
  const RollingSolution s = solve_rolling(w, d);
  const double size = s.forces.normal;
  const auto speed = [](RollingDrive& of, double step) { of.speed += step; };
  const auto friction = [](RollingDrive& of, double step) { of.friction += step; };
  expect_near(s.slopes.by_speed.forces, by(s, speed, 1e-5), 1e-6 * size);
  expect_near(s.slopes.by_friction.forces, by(s, friction, 1e-6), 1e-5 * size);
  expect_near(s.slopes.by_height.forces,
              by(
                  s, [](RollingDrive& of, double step) { of.height += step; }, 1e-7),
              1e-3 * size);
  d.load = size;
  const RollingSolution loaded = solve_rolling(w, d);
  expect_near(loaded.slopes.by_height.forces,
              by(
                  loaded, [](RollingDrive& of, double step) { *of.load += step; }, 1.0),
              1e-6);
  expect_near(loaded.slopes.by_speed.forces, by(loaded, speed, 1e-5), 1e-6 * size);
  d.traction = 0.9 * s.forces.heading;
  const RollingSolution pulled = solve_rolling(w, d);
  ASSERT_EQ(pulled.end, RollingEnd::solved);
  const auto traction = [](RollingDrive& of, double step) { *of.traction += step; };
  expect_near(pulled.slopes.by_speed.forces, by(pulled, traction, 1.0), 1e-5);
}

TEST(RollingFriction, SlopesInSpaceAreThoseOfDifferences) {
  const test::SteadyWheel wheel(test::small_case());
  RollingWindow<3> w = test::cambered(wheel, 9.81);
  const RollingFriction law{rubber(), wheel.areas()};
  RollingDrive d = test::cornering_drive();
  d.law = &law;
  const RollingSolution s = solve_rolling(w, d);
  expect_own_coefficients(w, d, s);
  const auto by = [&](double RollingDrive::*what, double step) {
    RollingDrive more = d, less = d;
    more.*what += step;
    less.*what -= step;
    return difference(solve_rolling_from(w, more, s).forces, solve_rolling_from(w, less, s).forces,
                      2.0 * step);
  };
  const double size = s.forces.normal;
  expect_near(s.slopes.by_height.forces, by(&RollingDrive::height, 1e-8), 1e-3 * size);
  expect_near(s.slopes.by_speed.forces, by(&RollingDrive::speed, 1e-6), 1e-5 * size);
  expect_near(s.slopes.by_slip_angle.forces, by(&RollingDrive::slip_angle, 1e-6), 1e-4 * size);
  expect_near(s.slopes.by_turn_slip.forces, by(&RollingDrive::turn_slip, 1e-6), 1e-4 * size);
  expect_near(s.slopes.by_friction.forces, by(&RollingDrive::friction, 1e-6), 1e-5 * size);
}

/// As the pressure grows with the load, friction falls.
TEST(RollingFriction, ALateralForceGrowsLessThanTheLoad) {
  const test::SteadyWheel wheel(test::small_case());
  RollingWindow<3> w = test::cambered(wheel);
  FrictionTable table = rubber();
  table.slip.clear();
  table.pressure_reference = 3e5;
  const RollingFriction law{table, wheel.areas()};
  RollingDrive d = test::cornering_drive();
  d.slip_angle = 0.3;  // all slides
  d.law = &law;
  double before = 1.0;
  for (const double height : {0.295, 0.29, 0.285}) {
    d.height = height;
    const RollingForces f = solve_rolling(w, d).forces;
    const double share = std::hypot(f.lateral, f.heading) / f.normal;
    EXPECT_LT(share, 0.99 * before) << height;
    before = share;
  }
}

/// The branch that is reached from the constant coefficient depends neither on where a state is
/// near nor on the way of the iteration.
TEST(RollingFriction, NearAStateThatHasTheLawItIsTheSame) {
  const test::SteadyWheel wheel(test::small_case());
  RollingWindow<3> w = test::cambered(wheel);
  const RollingFriction law{rubber(), wheel.areas()};
  RollingDrive d = test::cornering_drive();
  d.law = &law;
  const RollingSolution first = solve_rolling(w, d);
  d.slip_angle = 0.04;
  const RollingSolution near = solve_rolling_from(w, d, first), whole = solve_rolling(w, d);
  ASSERT_EQ(near.end, RollingEnd::solved);
  EXPECT_EQ(near.friction.steps, 0);
  EXPECT_LT(near.friction.problems, whole.friction.problems);
  expect_near(near.forces, whole.forces, 1e-7 * whole.forces.normal);
}

/// Nine tenths of what the constant friction carries are too much for friction that falls to a
/// third: no state of the whole law is found, and the solution says how far it came.
TEST(RollingFriction, WhatDoesNotSettleIsNotASolution) {
  const test::SteadyBody b(disk_case(), 4, true);
  RollingWindow<2> w = b.window(SlipDifference::bdf2);
  const RollingFriction law{{.coefficient = 1.0, .slip = {{0.0, 1.0}, {0.1, 0.3}}, .patches = {}},
                            lengths(b)};
  RollingDrive d = test::at_height(0.4);
  d.load = 1e5;
  d.traction = -0.9 * d.friction * *d.load;
  ASSERT_EQ(solve_rolling(w, d).end, RollingEnd::solved);
  d.law = &law;
  const RollingSolution s = solve_rolling(w, d);
  EXPECT_EQ(s.end, RollingEnd::not_solved);
  EXPECT_FALSE(s.friction.solved);
  EXPECT_GT(s.friction.share, 0.01);
  EXPECT_LT(s.friction.share, 0.9);
  EXPECT_GT(s.friction.change, 1e-4);
  EXPECT_GT(s.friction.restarts, 2);
}

}  // namespace rolling_friction_test
