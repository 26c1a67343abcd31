// SPDX-License-Identifier: BSD-3-Clause
/// How steeply friction may rise, against the motion of one node on a spring.
#include "rondo/model/stability/friction_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rondo::dynamics::friction_step_test {
namespace {

/// Velocity after many steps of a node on a spring of frequency ω whose damping, and whose friction
/// by the slip of the step before, act at the old half step; it begins with 1.
double speed_after_many_steps(const ElementLimit& of, double dt, double steepness) {
  double u = 0.0, v = 1.0;
  for (int step = 0; step < 4000; ++step) {
    const double force = -of.omega * of.omega * (u + of.stiffness_damping * v);
    v += dt * force - steepness * v;
    u += dt * v;
  }
  return std::hypot(v, of.omega * u);
}

TEST(FrictionStep, ANodeOnTheStiffestSpringAlternatesAboveTheLimit) {
  for (const double beta : {0.0, 2e-5})
    for (const double turn : {0.1, 1.0, 1.5}) {
      const ElementLimit of{5e4, beta};
      const double dt = turn / of.omega, limit = friction_limit(of, dt);
      if (limit == 0.0) continue;  // no friction at all: the last of them
      EXPECT_LT(speed_after_many_steps(of, dt, 0.99 * limit), 1e-6) << beta << " " << turn;
      EXPECT_GT(speed_after_many_steps(of, dt, 1.01 * limit), 1e3) << beta << " " << turn;
    }
}

TEST(FrictionStep, IsTwoInSmallStepsAndNothingAtTheCriticalOne) {
  EXPECT_NEAR(friction_limit({5e4, 0.0}, 1e-12), 2.0, 1e-14);
  EXPECT_DOUBLE_EQ(friction_limit({0.0, 0.0}, 1.0), 2.0);  // all elements are implicit
  EXPECT_NEAR(friction_limit({5e4, 0.0}, 2.0 / 5e4), 0.0, 1e-14);
  EXPECT_EQ(friction_limit({5e4, 1e-5}, 2.0 / 5e4), 0.0);
  EXPECT_NEAR(friction_limit({0.0, 0.0, 3000.0}, 1e-4), 2.0 - 0.3, 1e-14);  // mass damping lags
}

TEST(FrictionStep, TheStepIsThatAtWhichTheRateMeetsTheLimit) {
  for (const double beta : {0.0, 2e-5})
    for (const double rate : {1.0, 2.6e5, 1e8}) {
      const ElementLimit of{5e4, beta, 1e3 * beta / 2e-5};
      const double step = friction_step(of, rate);
      EXPECT_NEAR(rate * step, friction_limit(of, step), 1e-12) << beta << " " << rate;
    }
  EXPECT_DOUBLE_EQ(friction_step({0.0, 0.0}, 4.0), 0.5);
  EXPECT_EQ(friction_step({0.0, 0.0}, 0.0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace rondo::dynamics::friction_step_test
