// SPDX-License-Identifier: BSD-3-Clause
/// A wheel in three dimensions that rolls steadily, against Hertz, Kalker, CONTACT, the same wheel
/// in steps of time, and its own mirror images (docs/validation.md, V37).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "support/kalker.hpp"
#include "support/solid_steady.hpp"

namespace v37_wheel_steady {

using namespace rondo;
using namespace rondo::statics;
using test::solved;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The wheel of docs/wheel3d.md; its harmonics are made once.
const test::SteadyWheel& box() {
  static const test::SteadyWheel wheel(test::box_wheel_case());
  return wheel;
}

RollingDrive cornering(double slip_angle, double friction = 0.3) {
  RollingDrive d;
  d.height = 0.29;
  d.speed = 10.0;
  d.slip_angle = slip_angle;
  d.friction = friction;
  return d;
}

RollingSolution cornered(double slip_angle, double camber = 0.0, double friction = 0.3) {
  RollingWindow<3> window(box().harmonics, SlipDifference::bdf2, camber);
  return solved(window, cornering(slip_angle, friction));
}

RollingDrive slow(double friction) {
  RollingDrive d;
  d.height = 0.298;
  d.speed = 0.3e-3;
  d.friction = friction;
  return d;
}

const test::SteadyWheel& sphere() {
  static const test::SteadyWheel wheel(test::crowned_case(0.3, 8, 24, 360, 1.5));
  return wheel;
}

constexpr double modulus = 5e6 / (1.0 - 0.45 * 0.45);
constexpr double shear_modulus =
    2.0 * 5e6 / (2.0 * 1.45);  // on rigid ground twice that of the body

/// Half axes by the second moments of the pressure, and its largest value.
test::Ellipse footprint(const test::SteadyWheel& wheel, const RollingWindow<3>& window,
                        const RollingSolution& s) {
  const std::vector<double> areas = wheel.areas();
  test::Ellipse e;
  double along = 0.0, across = 0.0, force = 0.0;
  for (std::size_t j = 0; j < window.pairs().size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double r = s.force[3 * at], x = s.place[2 * at], z = s.place[2 * at + 1];
    force += r;
    along += r * x * x;
    across += r * z * z;
    e.pressure = std::max(e.pressure, r / areas[window.pairs()[j].candidate]);
  }
  e.rolling = std::sqrt(5.0 * along / force);
  e.across = std::sqrt(5.0 * across / force);
  return e;
}

}  // namespace

// Against steps in time: design numbers of an explicit run, whose nodes enter by up to a step's
// travel.
TEST(SteadyWheel, CornersAsItDoesInTime) {
  const double transient[][4] = {{1.0, 17819.0, -1579.0, -29.9},
                                 {2.0, 17909.0, -3041.0, -44.4},
                                 {4.0, 18226.0, -5183.0, -23.7},
                                 {12.0, 18273.0, -5463.0, -0.46}};
  for (const auto& [angle, load, lateral, moment] : transient) {
    const RollingSolution s = cornered(angle * degree);
    EXPECT_NEAR(s.forces.normal, load, 0.006 * load) << angle;
    EXPECT_NEAR(s.forces.lateral, lateral, 0.035 * 1579.0) << angle;
    EXPECT_NEAR(s.forces.aligning, moment, 0.05 * 29.9) << angle;
  }
}

// On three layers the mass of the contact nodes, which goes to those below, counts; on six hardly.
TEST(SteadyWheel, CornersAsItDoesInTimeOnAFinerMesh) {
  test::SteadyWheelCase c = test::box_wheel_case();
  c.wheel = test::box_wheel(6, 8, 180);
  const test::SteadyWheel wheel(c);
  RollingWindow<3> window(wheel.harmonics, SlipDifference::bdf2);
  const double transient[][4] = {{1.0, 17573.0, -1513.0, -24.0}, {4.0, 17971.0, -5080.0, -21.0}};
  for (const auto& [angle, load, lateral, moment] : transient) {
    const RollingSolution s = solved(window, cornering(angle * degree));
    EXPECT_NEAR(s.forces.normal, load, 0.001 * load) << angle;
    EXPECT_NEAR(s.forces.lateral, lateral, 0.006 * 1513.0) << angle;
    EXPECT_NEAR(s.forces.aligning, moment, 0.02 * 24.0) << angle;
    if (angle == 1.0) {
      EXPECT_NEAR(s.forces.heading, -635.0, 0.006 * 1513.0 + 1.0);
    }
  }
}

TEST(SteadyWheel, IsItsOwnMirrorImage) {
  for (const double angle : {0.25, 2.0, 12.0}) {
    const RollingSolution right = cornered(angle * degree, 3.0 * degree);
    const RollingSolution left = cornered(-angle * degree, -3.0 * degree);
    const double force = 1e-10 * right.forces.normal;
    EXPECT_NEAR(right.forces.normal, left.forces.normal, force);
    EXPECT_NEAR(right.forces.heading, left.forces.heading, force);
    EXPECT_NEAR(right.forces.lateral, -left.forces.lateral, force);
    EXPECT_NEAR(right.forces.aligning, -left.forces.aligning, force);
    EXPECT_NEAR(right.forces.overturning, -left.forces.overturning, force);
    EXPECT_GT(std::abs(right.forces.lateral), 100.0);
  }
}

TEST(SteadyWheel, WithoutFrictionHasNoShear) {
  const RollingSolution s = cornered(2.0 * degree, 4.0 * degree, 0.0);
  EXPECT_EQ(s.forces.heading, 0.0);
  EXPECT_EQ(s.forces.lateral, 0.0);
  EXPECT_NEAR(s.forces.aligning, 0.0, 1e-12 * s.forces.normal);
  EXPECT_GT(s.forces.normal, 1e4);
}

TEST(SteadyWheel, IsLinearBelowHalfADegree) {
  const RollingSolution none = cornered(0.0);
  const double stiffness = -none.slopes.by_slip_angle.forces.lateral;
  EXPECT_NEAR(stiffness, 92e3, 0.05 * 92e3);
  for (const double angle : {0.25, 0.5})
    EXPECT_NEAR(-cornered(angle * degree).forces.lateral / (angle * degree), stiffness,
                0.06 * stiffness);
}

TEST(SteadyWheel, TractionTakesFromTheLateralForce) {
  RollingWindow<3> window(box().harmonics, SlipDifference::bdf2);
  RollingDrive d = cornering(3.0 * degree);
  d.speed = 10.0 / 1.06;
  const RollingSolution s = solved(window, d);
  const double all = std::hypot(s.forces.heading, s.forces.lateral);
  EXPECT_NEAR(s.forces.heading, 4029.0, 0.03 * 4029.0);
  EXPECT_NEAR(s.forces.lateral, -3417.0, 0.04 * 3417.0);
  EXPECT_NEAR(all / (0.3 * s.forces.normal), 0.984, 0.01);
  EXPECT_GT(s.forces.aligning, 0.0);
}

TEST(SteadyWheel, CamberOfAFlatTreadPushesAwayFromTheLean) {
  const RollingSolution s = cornered(0.0, 4.0 * degree);
  EXPECT_NEAR(s.forces.normal, 16879.0, 0.01 * 16879.0);
  EXPECT_NEAR(s.forces.lateral, 1465.0, 0.06 * 1465.0);
}

TEST(SteadyWheel, PressesAsHertzHasIt) {
  RollingWindow<3> window(sphere().harmonics, SlipDifference::bdf2);
  const RollingSolution s = solved(window, slow(0.0));
  EXPECT_NEAR(s.forces.normal, 401.8, 0.002 * 401.8);
  const test::Ellipse theory = test::hertz(s.forces.normal, modulus, 0.3, 0.3);
  EXPECT_NEAR(theory.rolling, 24.34e-3, 0.01e-3);
  EXPECT_NEAR(theory.pressure, 323.8e3, 0.1e3);
  const test::Ellipse found = footprint(sphere(), window, s);
  EXPECT_NEAR(found.rolling, theory.rolling, 0.01 * theory.rolling);
  EXPECT_NEAR(found.across, theory.across, 0.01 * theory.across);
  EXPECT_NEAR(found.pressure, theory.pressure, 0.02 * theory.pressure);
}

TEST(SteadyWheel, CreepsAsKalkersLinearTheory) {
  RollingWindow<3> window(sphere().harmonics, SlipDifference::upwind);
  RollingDrive d = slow(50.0);  // all sticks
  d.traction = 0.0;
  const RollingSolution rolling = solved(window, d);
  const test::Ellipse e = test::hertz(rolling.forces.normal, modulus, 0.3, 0.3);
  const double area = e.rolling * e.across;
  const double c22 = test::at_poisson(0.45, 3.40, 3.67, 3.98);
  const double c23 = test::at_poisson(0.45, 1.33, 1.47, 1.63);
  EXPECT_NEAR(-rolling.slopes.by_slip_angle.forces.lateral / (shear_modulus * area), c22,
              0.06 * c22);
  d.traction.reset();
  d.speed = rolling.speed;
  const RollingSolution held = solved(window, d);
  const double c11 = test::at_poisson(0.45, 3.40, 4.12, 5.20);
  EXPECT_NEAR(-held.slopes.by_speed.forces.heading * d.speed / (shear_modulus * area), c11,
              0.06 * c11);
  // Of the moment by lateral creep, which is that of the lateral force by spin. 16 nodes across
  // the contact are few for it.
  EXPECT_NEAR(-rolling.slopes.by_slip_angle.forces.aligning / (shear_modulus * std::pow(area, 1.5)),
              c23, 0.15 * c23);
}

// CONTACT's creep-force curve of an ellipse of a/b = 1/2 (tractcurv, cases 2 to 8): half-spaces,
// 106.7 kN, G 82 GPa, ν 0.28, μ 0.33. Creep over that of full sliding in Kalker's linear theory.
TEST(SteadyWheel, PullsOverCreepAsContactHasIt) {
  const test::SteadyWheel wheel(test::crowned_case(0.865, 8, 24, 360, 1.2));
  RollingWindow<3> window(wheel.harmonics, SlipDifference::bdf2);
  RollingDrive d = slow(0.6);
  d.traction = 0.0;
  const RollingSolution rolling = solved(window, d);
  const test::Ellipse e = test::hertz(rolling.forces.normal, modulus, 0.3, 0.865);
  EXPECT_NEAR(e.rolling / e.across, 0.5, 0.01);
  const double area = e.rolling * e.across, c11 = test::at_poisson(0.45, 2.88, 3.62, 4.83);
  const double scale = 0.6 * rolling.forces.normal / (c11 * shear_modulus * area);
  const double theirs =
      test::at_poisson(0.28, 2.88, 3.62, 4.83) * 82e9 * 79.5e-6 / (0.33 * 106.7e3);
  d.traction.reset();
  const double curve[][2] = {{4.0, 0.2588},  {8.0, 0.4742},  {12.0, 0.6482}, {16.0, 0.7831},
                             {20.0, 0.8816}, {24.0, 0.9467}, {28.0, 0.9832}};
  for (const auto& [creep, pull] : curve) {
    double both = 0.0;  // driving and braking: rolling radii differ across a crowned tread
    for (const double sense : {1.0, -1.0}) {
      d.speed = rolling.speed * (1.0 + sense * 1e-4 * creep * theirs * scale);
      const RollingSolution s = solved(window, d);
      both -= 0.5 * sense * s.forces.heading / (0.6 * s.forces.normal);
    }
    EXPECT_NEAR(both, pull, 0.02) << creep;
  }
}

// Frictionless against the statics of its harmonics; what sticks as it does in time.
TEST(SteadyWheel, IsAsStiffAsAFlatTreadInTime) {
  test::SteadyWheelCase c;
  c.wheel = test::box_wheel(4, 6, 120);
  c.material = test::box_rubber();
  c.spin = -1e-3 / 0.3;
  const test::SteadyWheel wheel(c);
  RollingWindow<3> window(wheel.harmonics, SlipDifference::bdf2);
  RollingDrive d = slow(0.0);
  d.height = 0.292;
  d.speed = 1e-3;
  EXPECT_NEAR(solved(window, d).forces.normal, 12781.0, 0.5);
  d.friction = 5.0;
  d.traction = 0.0;
  EXPECT_NEAR(-solved(window, d).slopes.by_slip_angle.forces.lateral, 90.4e3, 0.03 * 90.4e3);
}

}  // namespace v37_wheel_steady
