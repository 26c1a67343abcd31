// SPDX-License-Identifier: BSD-3-Clause
/// @file  Lateral creep and spin of an ellipse by CONTACT, of two half-spaces and of a wheel
/// (docs/validation.md, V40). CONTACT's numbers: examples/fastsim.inp and fastsim.ref_out, case 1,
/// which is its half-space solution on 40 elements over each axis; eve70a/CONTACT 424e4e6,
/// Apache-2.0. Its spin, right-handed about the normal, is minus the turn slip.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rondo/statics/steady/rolling_newton.hpp"
#include "support/half_space.hpp"
#include "support/kalker.hpp"
#include "support/solid_steady.hpp"

namespace rondo::test {

/// In mm and N.
struct ContactCase {
  static constexpr double load = 82000.0, friction = 0.3, creep = -6.25e-4, spin = 6.25e-4;
  static constexpr double shear_modulus = 82000.0, poissons_ratio = 0.28;
  static constexpr double lateral = -0.6074 * friction * load, moment = -48210.0, pressure = 1223.0;
  static constexpr double area = 32.0;  ///< product of the half axes
};

/// What the ellipse of the case bears, over μ F_n, its moment over μ F_n √(ab) as well.
struct SpinForces {
  double lateral = 0.0, moment = 0.0, pressure = 0.0;
};
inline constexpr SpinForces of_contact{
    ContactCase::lateral / (ContactCase::friction * ContactCase::load),
    ContactCase::moment / (ContactCase::friction * ContactCase::load * 5.656854),
    ContactCase::pressure};

inline HalfSpaces contact_spaces(int elements,
                                 double poissons_ratio = ContactCase::poissons_ratio) {
  const double softer = (1.0 - poissons_ratio) / (1.0 - ContactCase::poissons_ratio);
  return {.rolling = 8.0,
          .across = 4.0,
          .along_curve = 0.8464e-3 * softer,
          .side = 2.406e-3 * softer,
          .shear_modulus = ContactCase::shear_modulus,
          .poissons_ratio = poissons_ratio,
          .elements = elements};
}

/// A state of a problem of half-spaces under a load; expects that it is one.
inline statics::RollingState rolled(const statics::RollingProblem<3>& problem,
                                    const statics::RollingDrive& drive, double depth) {
  statics::RollingState s;
  s.point = {Eigen::VectorXd::Zero(problem.size()), -depth, drive.speed};
  solve_rolling(problem, drive, s);
  EXPECT_TRUE(s.solved()) << s.residual;
  return s;
}

/// Kalker's coefficients of the lateral force by creep and by spin, where all sticks.
struct SpinCreep {
  double c22 = 0.0, c23 = 0.0;
  double moment = 0.0;  ///< C23 once more, of the moment by creep
};
inline SpinCreep creep_of(const HalfSpaces& of, double load) {
  const double depth = of.along_curve * of.rolling * of.rolling;
  statics::RollingDrive d;
  d.speed = 2.0 * of.rolling / of.elements;
  d.friction = 1e4;
  d.load = load;
  const statics::RollingProblem<3> problem = half_spaces(of);
  statics::RollingState rolling = rolled(problem, d, depth);
  add_slopes(problem, d, rolling);
  const statics::RollingSlopes& s = rolling.slopes;
  const double area = of.rolling * of.across, unit = of.shear_modulus * area;
  return {-s.by_slip_angle.forces.lateral / unit,
          s.by_turn_slip.forces.lateral / (unit * std::sqrt(area)),
          -s.by_slip_angle.forces.aligning / (unit * std::sqrt(area))};
}

/// Finds the same coefficients for a freely rolling wheel, whose radii are equal and whose contact
/// is a circle of .08 of them.
inline SpinCreep creep_of_wheel(int around, statics::SlipDifference slip) {
  constexpr double nu = 0.45, modulus = 5e6 / (1.0 - nu * nu);
  constexpr double shear = 5e6 / (1.0 + nu);  // rigid ground: twice that of the body
  const SteadyWheel wheel(crowned_case(0.3, 8, 24, around, 1.5));
  statics::RollingWindow<3> window(wheel.harmonics, slip);
  statics::RollingDrive d;
  d.height = 0.298;
  d.speed = 0.3e-3;
  d.friction = 50.0;
  d.traction = 0.0;
  const statics::RollingSolution s = solved(window, d);
  const Ellipse e = hertz(s.forces.normal, modulus, 0.3, 0.3);
  const double area = e.rolling * e.across, unit = shear * area;
  return {-s.slopes.by_slip_angle.forces.lateral / unit,
          s.slopes.by_turn_slip.forces.lateral / (unit * std::sqrt(area)),
          -s.slopes.by_slip_angle.forces.aligning / (unit * std::sqrt(area))};
}

/// CONTACT's case on so many elements.
inline SpinForces spin_of_half_spaces(int elements) {
  const statics::RollingProblem<3> problem = half_spaces(contact_spaces(elements));
  statics::RollingDrive d;
  d.speed = 16.0 / elements;
  d.slip_angle = ContactCase::creep;
  d.turn_slip = -ContactCase::spin;
  d.friction = ContactCase::friction;
  d.load = ContactCase::load;
  const statics::RollingState s = rolled(problem, d, 0.05);
  const statics::RollingForces f = forces_of(problem, s.point);
  const double slides = d.friction * f.normal, element = d.speed * 8.0 / elements;
  double largest = 0.0;
  for (Eigen::Index j = 0; j < problem.n_pairs(); ++j)
    largest = std::max(largest, s.point.force[3 * j]);
  return {f.lateral / slides, -f.aligning / (slides * std::sqrt(ContactCase::area)),
          largest / element};
}

/// Finds the same figures for a wheel of radius .3 m and crown .1 m, whose ellipse has nearly
/// CONTACT's axes. Its creep and spin have CONTACT's ratios to those of full sliding in Kalker's
/// linear theory, for the Poisson's ratios of both.
/// @param across elements over the width. @param around columns
inline SpinForces spin_of_wheel(int across, int around, statics::SlipDifference slip) {
  constexpr double nu = 0.45, modulus = 5e6 / (1.0 - nu * nu), shear = 2.0 * 5e6 / (2.0 + 2.0 * nu);
  const SteadyWheel wheel(crowned_case(0.1, 8, across, around, 1.7));
  statics::RollingWindow<3> window(wheel.harmonics, slip);
  statics::RollingDrive d;
  d.height = 0.298;
  d.speed = 0.3e-3;
  d.friction = 0.3;
  d.traction = 0.0;
  const double load = solved(window, d).forces.normal;
  const Ellipse e = hertz(load, modulus, 0.3, 0.1);
  const double area = e.rolling * e.across;
  const SpinCreep steel = creep_of(contact_spaces(12), ContactCase::load),
                  rubber = creep_of(contact_spaces(12, nu), ContactCase::load);
  const double ratio = ContactCase::shear_modulus * ContactCase::area / ContactCase::load * load /
                       (shear * area) * d.friction / ContactCase::friction;
  d.slip_angle = ContactCase::creep * ratio * steel.c22 / rubber.c22;
  d.turn_slip =
      -ContactCase::spin * ratio * steel.c23 / rubber.c23 * std::sqrt(ContactCase::area / area);
  const statics::RollingForces f = solved(window, d).forces;
  const double slides = d.friction * f.normal;
  return {f.lateral / slides, -f.aligning / (slides * std::sqrt(area)), 0.0};
}

}  // namespace rondo::test
