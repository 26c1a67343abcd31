// SPDX-License-Identifier: BSD-3-Clause
/// Hertz' ellipses and Kalker's coefficients on finer meshes (docs/validation.md, V37).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/kalker.hpp"
#include "support/solid_steady.hpp"

namespace v37_wheel_steady_long {

using namespace rondo;
using namespace rondo::statics;
using test::solved;

namespace {

constexpr double modulus = 5e6 / (1.0 - 0.45 * 0.45);
constexpr double shear_modulus = 2.0 * 5e6 / (2.0 * 1.45);

RollingDrive slow(double friction) {
  RollingDrive d;
  d.height = 0.298;
  d.speed = 0.3e-3;
  d.friction = friction;
  return d;
}

test::Ellipse footprint(const test::SteadyWheel& wheel, const RollingWindow<3>& window,
                        const RollingSolution& s) {
  const std::vector<double> areas = wheel.areas();
  test::Ellipse e;
  double along = 0.0, across = 0.0;
  for (std::size_t j = 0; j < window.pairs().size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    along += s.force[3 * at] * std::pow(s.place[2 * at], 2);
    across += s.force[3 * at] * std::pow(s.place[2 * at + 1], 2);
    e.pressure = std::max(e.pressure, s.force[3 * at] / areas[window.pairs()[j].candidate]);
  }
  e.rolling = std::sqrt(5.0 * along / s.forces.normal);
  e.across = std::sqrt(5.0 * across / s.forces.normal);
  return e;
}

}  // namespace

TEST(SteadyWheelLong, PressesAsHertzHasItWhateverTheCrown) {
  struct Row {
    double crown, grading, force, bound;
  };
  // The short axis of a crown of .1 m is few elements.
  for (const Row& row :
       {Row{0.3, 1.5, 401.8, 0.013}, Row{0.1, 1.7, 313.0, 0.038}, Row{0.9, 1.2, 535.5, 0.013}}) {
    const test::SteadyWheel wheel(test::crowned_case(row.crown, 10, 32, 720, row.grading));
    RollingWindow<3> window(wheel.harmonics, SlipDifference::bdf2);
    const RollingSolution s = solved(window, slow(0.0));
    EXPECT_NEAR(s.forces.normal, row.force, 0.01 * row.force) << row.crown;
    const test::Ellipse e = test::hertz(s.forces.normal, modulus, 0.3, row.crown);
    const test::Ellipse found = footprint(wheel, window, s);
    EXPECT_NEAR(found.rolling, e.rolling, row.bound * e.rolling) << row.crown;
    EXPECT_NEAR(found.across, e.across, row.bound * e.across) << row.crown;
    EXPECT_NEAR(found.pressure, e.pressure, 0.02 * e.pressure) << row.crown;
  }
}

TEST(SteadyWheelLong, CreepsAsKalkersLinearTheory) {
  const test::SteadyWheel wheel(test::crowned_case(0.3, 8, 24, 720, 1.5));
  RollingWindow<3> window(wheel.harmonics, SlipDifference::upwind);
  RollingDrive d = slow(50.0);  // all sticks
  d.traction = 0.0;
  const RollingSolution rolling = solved(window, d);
  const test::Ellipse e = test::hertz(rolling.forces.normal, modulus, 0.3, 0.3);
  const double area = e.rolling * e.across;
  const double c22 = test::at_poisson(0.45, 3.40, 3.67, 3.98);
  const double c23 = test::at_poisson(0.45, 1.33, 1.47, 1.63);
  const RollingForces& by_angle = rolling.slopes.by_slip_angle.forces;
  EXPECT_NEAR(-by_angle.lateral / (shear_modulus * area), c22, 0.06 * c22);
  EXPECT_NEAR(-by_angle.aligning / (shear_modulus * std::pow(area, 1.5)), c23, 0.06 * c23);
  d.traction.reset();
  d.speed = rolling.speed;
  const double by_speed = solved(window, d).slopes.by_speed.forces.heading;
  const double c11 = test::at_poisson(0.45, 3.40, 4.12, 5.20);
  EXPECT_NEAR(-by_speed * d.speed / (shear_modulus * area), c11, 0.06 * c11);
}

}  // namespace v37_wheel_steady_long
