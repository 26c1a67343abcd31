// SPDX-License-Identifier: BSD-3-Clause
/// @file  Two equal spheres that stand under a force along the ground, and then roll under it
/// (docs/validation.md, V42). Source: J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling
/// Contact, 1990, 5.2.2.5; numbers and elements are those of CONTACT: examples/catt_to_cart;
/// eve70a/CONTACT, Apache-2.0.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "rondo/statics/steady/rolling_transient.hpp"
#include "support/half_space.hpp"
#include "support/turn_slip.hpp"

namespace rondo::test {

/// In mm and N. Elements are squares, one of them in the middle of the contact.
struct StartOfRollingCase {
  static constexpr double load = 0.4705, friction = 0.4013, share = 0.657;  ///< F_x over μ F_n
  static constexpr double element = 0.25, depth = 0.036;
  static constexpr int elements = 29;  ///< of the diameter, 7, and one more
};

/// Creep is in thousandths.
struct StartOfRolling {
  double shift = 0.0;           ///< of the spheres while they stand [mm]
  double pressure = 0.0;        ///< largest                         [N/mm²]
  std::vector<double> creep{};  ///< after each step of an element
  double steady = 0.0;          ///< creep of steady rolling
};

inline StartOfRolling start_of_rolling(int steps) {
  using Case = StartOfRollingCase;
  constexpr double half = 0.5 * Case::elements * Case::element;
  const HalfSpaces spaces{.rolling = half,
                          .across = half,
                          .along_curve = 0.002963,
                          .side = 0.002963,
                          .shear_modulus = 1.0,
                          .poissons_ratio = 0.28,
                          .elements = Case::elements,
                          .slip = {1.0, -1.0}};
  statics::RollingDrive d;
  d.friction = Case::friction;
  d.load = Case::load;
  d.traction = -Case::share * Case::friction * Case::load;

  statics::RollingProblem<3> p = rolling_half_spaces(spaces);
  const Eigen::VectorXd rolls = p.base;
  for (Eigen::Index j = 0; j < p.size(); j += 3) p.base[j + 1] = 0.0;
  statics::RollingState s = rolled(p, d, Case::depth);  // from a speed of 0, at which all sticks
  StartOfRolling found;
  found.shift = s.point.speed;
  for (Eigen::Index j = 0; j < p.size(); j += 3)
    found.pressure = std::max(found.pressure, s.point.force[j] / std::pow(Case::element, 2));

  p.base = rolls;
  s.point.speed = d.speed = Case::element;
  const auto creep = [&] { return 1e3 * (s.point.speed / Case::element - 1.0); };
  for (int n = 0; n < steps; ++n) {
    statics::roll_on_from(p, s.point.force);
    s.effort = {};
    solve_rolling(p, d, s);
    EXPECT_TRUE(s.solved()) << n;
    found.creep.push_back(creep());
  }
  s = rolled(half_spaces(spaces), d, Case::depth);
  found.steady = creep();
  return found;
}

/// What CONTACT has after a step.
struct CreepOfContact {
  std::size_t step;
  double creep;
};
inline constexpr CreepOfContact creeps_of_contact[] = {
    {1, 1.824},  {5, 2.140},  {10, 2.676}, {13, 3.184}, {14, 3.403},
    {15, 3.402}, {20, 3.112}, {24, 3.062}, {32, 3.111}, {41, 3.099}};

/// All that is printed of CONTACT's numbers: half a unit of the last digit.
inline void expect_creeps_of_contact(const StartOfRolling& found) {
  EXPECT_NEAR(found.shift, 0.01774, 5e-6);
  EXPECT_NEAR(found.pressure, 0.01834, 5e-6);
  for (const CreepOfContact& c : creeps_of_contact)
    if (c.step <= found.creep.size()) {
      EXPECT_NEAR(found.creep[c.step - 1], c.creep, 5.01e-4) << c.step;
    }
  EXPECT_NEAR(found.steady, 3.101, 5.01e-4);
}

}  // namespace rondo::test
