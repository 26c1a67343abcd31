// SPDX-License-Identifier: BSD-3-Clause
/// Steady rolling solved directly, against the numbers of an independent program, differences and
/// the power identity (docs/validation.md, V30).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/steady_body.hpp"

namespace v30_steady_rolling {

using namespace rondo;
using namespace rondo::statics;

namespace {

using test::at_height;
using test::solved;

struct Body : test::SteadyBody {
  Body(int radial, int columns, int samples, bool massless, double spin = -33.333333)
      : SteadyBody(disk(radial, columns, spin), samples, massless) {}

  static test::DiskCase disk(int radial, int columns, double spin) {
    test::DiskCase c = test::rolling_disk(radial, columns);
    c.motion.angular_velocity = dynamics::Table(-spin);
    return c;
  }
};

RollingDrive at_load(double friction) {
  RollingDrive d = at_height(friction);
  d.load = 1.9e5;
  return d;
}

}  // namespace

TEST(SteadyRolling, OneSampleAPassByUpwindSlip) {
  const Body b(12, 180, 1, false);
  RollingWindow<2> w = b.window(SlipDifference::upwind);
  RollingSolution s = solved(w, at_height(0.0));
  EXPECT_NEAR(s.forces.normal, 190046.0, 0.5);
  s = solved(w, at_height(0.2));
  EXPECT_NEAR(s.forces.heading, -17168.3740, 1e-4);
  EXPECT_NEAR(s.forces.normal, 190225.6134, 1e-4);
  EXPECT_NEAR(s.forces.torque, -4945.3519, 1e-4);
  const RollingPower power = rolling_power(w, s, spectrum_of(w, s));
  EXPECT_NEAR(power.mass, 1686.0940, 1e-4);
  EXPECT_NEAR(power.stiffness, 1241.4889, 1e-4);
  s = solved(w, at_height(0.4));
  EXPECT_NEAR(s.forces.heading, -20679.3489, 1e-4);
  EXPECT_NEAR(s.forces.normal, 190341.4171, 1e-4);
  EXPECT_NEAR(s.forces.torque, -5987.5264, 1e-4);
  s = solved(w, at_height(0.6));
  EXPECT_NEAR(s.forces.heading, -21788.0, 0.5);
  EXPECT_NEAR(s.forces.normal, 190428.0, 0.5);
}

TEST(SteadyRolling, ManySamplesWithoutMassOnTheContactNodes) {
  const Body b(12, 180, 32, true);
  RollingWindow<2> w = b.window(SlipDifference::bdf2);
  const double expected[][3] = {{0.0, 0.0, 189676.0},
                                {0.2, -18294.0, 189915.0},
                                {0.4, -22044.0, 190098.0},
                                {0.6, -23293.0, 190234.0}};
  for (const auto& [friction, x, y] : expected) {
    const RollingSolution s = solved(w, at_height(friction));
    EXPECT_NEAR(s.forces.heading, x, 0.6) << friction;
    EXPECT_NEAR(s.forces.normal, y, 0.6) << friction;
  }
}

TEST(SteadyRolling, TheSlipOfEightSamplesMissesLittleOfThePowerOfFriction) {
  const Body b(12, 180, 8, true);
  RollingWindow<2> w = b.window(SlipDifference::bdf2);
  for (const auto& [friction, share] : {std::pair{0.2, 0.0015}, {0.4, 0.0013}, {0.6, 0.0026}}) {
    const RollingSolution s = solved(w, at_height(friction));
    const RollingPower power = rolling_power(w, s, spectrum_of(w, s));
    EXPECT_LT(std::abs(power.scheme), share * power.friction) << friction;
  }
}

TEST(SteadyRolling, LoadTractionAndTorqueAreGivenBack) {
  const Body b(12, 180, 1, false);
  RollingWindow<2> w = b.window(SlipDifference::upwind);
  RollingDrive d = at_load(0.4);
  RollingSolution s = solved(w, d);
  EXPECT_NEAR(s.forces.normal, 1.9e5, 1e-10 * 1.9e5);
  EXPECT_NEAR(s.forces.heading, -20648.231, 1e-3);
  EXPECT_NEAR(s.forces.torque, -5977.9448, 1e-4);
  EXPECT_NEAR(s.height, 0.290013761, 1e-9);
  const RollingSolution back = solved(w, {.height = s.height,
                                          .speed = 10.0,
                                          .friction = 0.4,
                                          .load = {},
                                          .traction = {},
                                          .torque = {}});
  EXPECT_NEAR(back.forces.normal, 1.9e5, 1e-6);
  d.torque = 0.0;
  s = solved(w, d);
  EXPECT_NEAR(s.forces.torque, 0.0, 1e-6);
  EXPECT_NEAR(s.forces.heading, -296.0, 0.5);  // rolling resistance
  d.torque.reset();
  d.traction = -5000.0;
  s = solved(w, d);
  EXPECT_NEAR(s.forces.heading, -5000.0, 1e-6);
}

namespace {

/// Largest difference of the slopes from central differences, relative to the largest of a kind.
void expect_slopes(RollingWindow<2>& w, const RollingDrive& base, RollingSlope slope,
                   const std::function<void(RollingDrive&, double)>& change, double by,
                   double bound) {
  RollingDrive more = base, less = base;
  change(more, by);
  change(less, -by);
  const RollingSolution a = solve_rolling(w, more), c = solve_rolling(w, less);
  const auto near = [&](double value, double x, double y, double size) {
    const double difference = (x - y) / (2.0 * by);
    EXPECT_NEAR(value, difference, bound * std::max(std::abs(value), size / by));
  };
  near(slope.forces.heading, a.forces.heading, c.forces.heading, 1e-3);  // 5e-15 of the forces
  near(slope.forces.normal, a.forces.normal, c.forces.normal, 1e-3);
  near(slope.forces.torque, a.forces.torque, c.forces.torque, 1e-3);
  near(slope.height, a.height, c.height, 1e-10);
  near(slope.speed, a.speed, c.speed, 1e-8);
}

}  // namespace

/// With eight samples the forces themselves are known to 1e-11, over differences of 1e-5 of them.
TEST(SteadyRolling, SlopesAreThoseOfDifferences) {
  for (const auto& [samples, allowed] : {std::pair{1, 1e-6}, {8, 1e-4}}) {
    SCOPED_TRACE(samples);
    const double bound = allowed;  // clang takes no names of a pair into a lambda
    const Body b(12, 180, samples, samples > 1);
    RollingWindow<2> w = b.window(samples > 1 ? SlipDifference::bdf2 : SlipDifference::upwind);
    RollingDrive torque = at_load(0.4), traction = at_load(0.4), both = at_height(0.4);
    torque.torque = both.torque = -1000.0;
    traction.traction = -5000.0;
    for (const RollingDrive& d : {at_height(0.4), at_load(0.4), torque, traction, both}) {
      const RollingSolution s = solve_rolling(w, d);
      const auto expect = [&](const RollingSlope& slope, auto change, double by) {
        expect_slopes(w, d, slope, change, by, bound);
      };
      expect(
          s.slopes.by_friction, [](RollingDrive& e, double x) { e.friction += x; }, 1e-5);
      if (d.load)
        expect(
            s.slopes.by_height, [](RollingDrive& e, double x) { *e.load += x; }, 1.0);
      else
        expect(
            s.slopes.by_height, [](RollingDrive& e, double x) { e.height += x; }, 1e-7);
      if (d.torque)
        expect(
            s.slopes.by_speed, [](RollingDrive& e, double x) { *e.torque += x; }, 1.0);
      else if (d.traction)
        expect(
            s.slopes.by_speed, [](RollingDrive& e, double x) { *e.traction += x; }, 1.0);
      else
        expect(
            s.slopes.by_speed, [](RollingDrive& e, double x) { e.speed += x; }, 1e-5);
    }
  }
}

/// The weight of what the contact has moved beside the center has a torque, too.
TEST(SteadyRolling, SlopesCountTheTorqueOfTheWeight) {
  test::DiskCase c = Body::disk(12, 180, -33.333333);
  c.motion.gravity = dynamics::Table(100.0);
  const test::SteadyBody b(c, 1, false);
  RollingWindow<2> w = b.window(SlipDifference::upwind);
  RollingDrive d = at_load(0.4);
  d.torque = -3000.0;
  const RollingSolution s = solved(w, d);
  EXPECT_NEAR(s.forces.torque, -3000.0, 1e-6);
  expect_slopes(
      w, d, s.slopes.by_friction, [](RollingDrive& e, double x) { e.friction += x; }, 1e-5, 1e-6);
  expect_slopes(
      w, d, s.slopes.by_height, [](RollingDrive& e, double x) { *e.load += x; }, 1.0, 1e-6);
  expect_slopes(
      w, d, s.slopes.by_speed, [](RollingDrive& e, double x) { *e.torque += x; }, 1.0, 1e-6);
}

namespace {

/// Meshes, spins of both signs, slips of ±1, friction 0 to 2. @return how many were pivoted
int solve_random_cases(int samples, int bodies, int drives) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int pivoted = 0;
  for (int n = 0; n < bodies; ++n) {
    const int radial = 2 + static_cast<int>(8 * unit(random));
    const int columns = 12 * radial + static_cast<int>(30 * unit(random));
    const double spin = (unit(random) < 0.5 ? -1.0 : 1.0) * (5.0 + 55.0 * unit(random));
    const Body b(radial, columns, samples, samples > 1, spin);
    RollingWindow<2> w = b.window(samples > 1 ? SlipDifference::bdf2 : SlipDifference::upwind);
    for (int k = 0; k < drives; ++k) {
      const double slip = 2.0 * unit(random) - 1.0;
      RollingDrive d = at_height(2.0 * unit(random));
      d.height = 0.3 - 0.015 * (0.1 + 0.9 * unit(random));
      d.speed = -spin * 0.3 * (1.0 - slip);
      const RollingSolution s = solve_rolling(w, d);
      EXPECT_EQ(s.end, RollingEnd::solved) << n << ' ' << k << " residual " << s.residual;
      EXPECT_LT(s.residual, 1e-10);
      pivoted += s.effort.pivots > 0 ? 1 : 0;
    }
  }
  return pivoted;
}

}  // namespace

TEST(SteadyRolling, RandomCasesMeetTheLaw) {
  EXPECT_LT(solve_random_cases(1, 60, 20), 60);  // of 1,200: Newton finds nearly all
}

TEST(SteadyRolling, RandomCasesMeetTheLawWithManySamples) {
  for (const int samples : {2, 4, 8, 16}) {
    SCOPED_TRACE(samples);
    EXPECT_LT(solve_random_cases(samples, 20, 5), 10);
  }
}

}  // namespace v30_steady_rolling
