// SPDX-License-Identifier: BSD-3-Clause
/// Turn slip of steady rolling against CONTACT, Kalker, and the spin of a camber
/// (docs/validation.md, V40).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/turn_slip.hpp"

namespace v40_turn_slip {

using namespace rondo;
using namespace rondo::statics;
using test::solved;

namespace {

void record(const std::string& name, const test::SpinForces& f) {
  testing::Test::RecordProperty(name, fmt::format("{:.4f} {:.4f}", f.lateral, f.moment));
}

/// To no size of elements, of an error that is proportional to it.
double extrapolated(double coarse, double fine, double ratio) {
  return (ratio * fine - coarse) / (ratio - 1.0);
}

}  // namespace

/// CONTACT's numbers are those of 40 elements over each axis, and have an error of their own.
TEST(TurnSlip, TwoHalfSpacesBearWhatContactHas) {
  const test::SpinForces coarse = test::spin_of_half_spaces(20),
                         fine = test::spin_of_half_spaces(28);
  record("20", coarse);
  record("28", fine);
  const double lateral = extrapolated(coarse.lateral, fine.lateral, 1.4),
               moment = extrapolated(coarse.moment, fine.moment, 1.4);
  EXPECT_NEAR(lateral, test::of_contact.lateral, 0.03 * 0.6074);
  EXPECT_NEAR(moment, test::of_contact.moment, 0.03 * 0.3464);
  EXPECT_NEAR(fine.pressure, test::of_contact.pressure, 0.005 * 1223.0);
}

/// Forces by spin and moments by creep have one coefficient (Kalker 1990).
TEST(TurnSlip, TwoSpheresCreepAsKalkersLinearTheory) {
  for (const double nu : {0.25, 0.45}) {
    test::HalfSpaces of{1.0, 1.0, 0.5, 0.5, 1.0, nu, 16};
    const double load = 4.0 / (3.0 * (1.0 - nu));  // at which Hertz's radius is 1
    const test::SpinCreep found = test::creep_of(of, load);
    const double c22 = test::at_poisson(nu, 3.40, 3.67, 3.98),
                 c23 = test::at_poisson(nu, 1.33, 1.47, 1.63);
    EXPECT_NEAR(found.c22, c22, 0.02 * c22) << nu;
    EXPECT_NEAR(found.c23, c23, 0.02 * c23) << nu;
    EXPECT_NEAR(found.c23, found.moment, 1e-9) << nu;
  }
}

/// On a wheel: 16 nodes across the contact are few for a moment, and as few for a spin.
TEST(TurnSlip, AWheelCreepsAsKalkersLinearTheory) {
  const double c23 = test::at_poisson(0.45, 1.33, 1.47, 1.63);
  const test::SpinCreep found = test::creep_of_wheel(360, SlipDifference::upwind);
  EXPECT_NEAR(found.c23, c23, 0.13 * c23);
  EXPECT_NEAR(found.c23, found.moment, 0.025 * c23);
}

/// A camber γ turns the wheel by s sin γ about the normal, as the turn slip -sin γ ω/V does. It
/// also moves the contact off the middle of the section: the force is a seventh smaller, the moment
/// less.
TEST(TurnSlip, IsTheSpinOfACamber) {
  constexpr double camber = 0.02;
  const test::SteadyWheel wheel(test::crowned_case(0.3, 8, 24, 360, 1.5));
  RollingWindow<3> upright(wheel.harmonics, SlipDifference::upwind),
      leaning(wheel.harmonics, SlipDifference::upwind, camber);
  RollingDrive d;
  d.height = 0.298;
  d.speed = 0.3e-3;
  d.friction = 50.0;
  d.traction = 0.0;
  const RollingSolution leans = solved(leaning, d);
  d.turn_slip = -std::sin(camber) * 1e-3 / leans.speed;
  const RollingForces turns = solved(upright, d).forces;
  d.turn_slip = -d.turn_slip;
  const RollingForces neither = solved(leaning, d).forces;  // it rolls as a cone
  EXPECT_LT(turns.lateral, -4.0);
  EXPECT_NEAR(leans.forces.lateral / turns.lateral, 0.86, 0.01);
  EXPECT_NEAR(leans.forces.aligning / turns.aligning, 0.932, 0.01);
  EXPECT_LT(std::abs(neither.lateral), 0.14 * std::abs(turns.lateral));
  EXPECT_LT(std::abs(neither.aligning), 0.01 * std::abs(turns.aligning));
}

/// 15 columns over the ellipse. Finer: v40_turn_slip_long.cpp.
TEST(TurnSlip, AWheelBearsNearlyWhatContactHas) {
  const test::SpinForces found = test::spin_of_wheel(32, 540, SlipDifference::bdf2);
  record("540", found);
  EXPECT_NEAR(found.lateral, test::of_contact.lateral, 0.06);
  EXPECT_NEAR(found.moment, test::of_contact.moment, 0.08);
}

}  // namespace v40_turn_slip
