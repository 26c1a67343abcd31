// SPDX-License-Identifier: BSD-3-Clause
/// Viscous branches in simple shear (docs/rubber.md, 1.5): relaxation and loss against a Prony
/// series, which they are at small strain.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rondo/fem/hyperelastic/branch.hpp"

namespace rondo::fem::hyperelastic::rubber_branch_test {
namespace {

const Symmetric<double> undeformed{1.0, 1.0, 0.0};

/// F of a shear, by columns.
Gradient<double> sheared(double shear) {
  return {{1.0, 0.0}, {shear, 1.0}};
}

double shear_stress(double shear, const Symmetric<double>& history, double modulus) {
  return branch_stress(sheared(shear), history, 1.0, modulus).y.x;
}

/// Of the overstress of a shear that is held, what is left after a time of relaxation.
double left_after_one_time(double shear) {
  constexpr int half_steps = 2000;
  const Symmetric<double> c = right_cauchy_green(sheared(shear));
  Symmetric<double> history = undeformed;
  for (int i = 0; i < half_steps; ++i)
    history = relaxed(history, c, 1.0, std::expm1(1.0 / half_steps));
  EXPECT_NEAR(unrelaxed(undeformed, c, 1.0) - 3.0, shear * shear, 1e-14);
  return shear_stress(shear, history, 1.0) / shear_stress(shear, undeformed, 1.0);
}

/// Loss factor of a small oscillation at ωτ = 1 beside a long-term modulus of 1.
double loss_factor(double relative_modulus, int steps_a_cycle) {
  constexpr double amplitude = 1e-4;
  const double dt = 2.0 * std::numbers::pi / steps_a_cycle, growth = std::expm1(0.5 * dt);
  Symmetric<double> history = undeformed;
  double in_phase = 0.0, ahead = 0.0;
  for (int i = 0; i < 20 * steps_a_cycle; ++i) {
    const double shear = amplitude * std::sin(i * dt);
    const Symmetric<double> c = right_cauchy_green(sheared(shear));
    history = relaxed(history, c, 1.0, growth);
    const double stress = shear + shear_stress(shear, history, relative_modulus);
    history = relaxed(history, c, 1.0, growth);
    if (i < 19 * steps_a_cycle) continue;
    in_phase += stress * std::sin(i * dt);
    ahead += stress * std::cos(i * dt);
  }
  return ahead / in_phase;
}

}  // namespace

TEST(RubberBranch, RelaxesAsAPronySeriesAtSmallStrain) {
  EXPECT_NEAR(left_after_one_time(1e-4), std::exp(-1.0), 1e-8);
}

TEST(RubberBranch, RelaxesFasterAtLargeStrain) {
  EXPECT_NEAR(left_after_one_time(0.5), 0.948 * std::exp(-1.0), 2e-4);
  EXPECT_NEAR(left_after_one_time(1.0), 0.820 * std::exp(-1.0), 2e-4);
}

/// tan δ = ½ / (2 + ½) by the series; of second order in the step.
TEST(RubberBranch, LosesAsAPronySeries) {
  EXPECT_NEAR(loss_factor(0.5, 200), 0.199974, 1e-6);
  const double coarse = 0.2 - loss_factor(0.5, 50), fine = 0.2 - loss_factor(0.5, 100);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

}  // namespace rondo::fem::hyperelastic::rubber_branch_test
