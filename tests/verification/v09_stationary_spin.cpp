// SPDX-License-Identifier: BSD-3-Clause
/// V9: stationary spin against the closed form of the spinning annulus; orders of convergence.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/fem/stress.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "support/models.hpp"
#include "support/spinning_annulus.hpp"

namespace v09_stationary_spin {

using namespace rondo;

namespace {

struct Computed {
  double top_displacement;
  double radial_stress, hoop_stress;  ///< at the rim
};

/// Node 0 is on the rim at -90°, node `radial` on the top above it: x and y are hoop and radius.
Computed compute(int radial) {
  const auto c = test::rubber_annulus(radial, 15 * radial);
  const auto b = test::build(c);
  const auto s = statics::stationary_spin(b.model.stiffness, b.model.mass, b.model.reference,
                                          b.model.free, -50.0);
  EXPECT_EQ(s.status, statics::SpinStatus::solved);
  fem::StressRecovery recovery(b.mesh, {&c.material, 1});
  const fem::Stress rim = recovery(s.u)[0];
  return {-s.u.plane()[static_cast<std::size_t>(radial)].y, rim[1], rim[0]};
}

}  // namespace

TEST(StationarySpinClosedForm, GivesThePublishedFigures) {
  const test::SpinningAnnulus exact({5e6, 0.45, 1100.0, fem::Plane::strain}, 0.2, 0.3, 50.0);
  EXPECT_NEAR(exact.displacement(0.3), 1.591599e-4, 5e-11);  // the digits given
  EXPECT_NEAR(exact.radial_stress(0.2), 70610.7, 0.05);
  EXPECT_NEAR(exact.hoop_stress(0.2), 57772.4, 0.05);
  EXPECT_NEAR(exact.radial_stress(0.3), 0.0, 1e-6);
  EXPECT_NEAR(exact.displacement(0.2), 0.0, 1e-15);
}

TEST(StationarySpinMesh, DisplacementIsSecondOrder) {
  const test::SpinningAnnulus exact({5e6, 0.45, 1100.0, fem::Plane::strain}, 0.2, 0.3, 50.0);
  double before = 0.0;
  for (const int radial : {4, 8, 16, 32}) {
    const double error = std::abs(compute(radial).top_displacement / exact.displacement(0.3) - 1.0);
    RecordProperty("error_" + std::to_string(radial), std::to_string(error));
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1) << radial;
    }
    before = error;
  }
  EXPECT_LT(before, 2e-4);  // 1.2e-2 at 4 layers, quartered three times
}

TEST(StationarySpinMesh, NodalStressConvergesAtLeastFirstOrder) {
  const test::SpinningAnnulus exact({5e6, 0.45, 1100.0, fem::Plane::strain}, 0.2, 0.3, 50.0);
  double before_r = 0.0, before_h = 0.0;
  for (const int radial : {4, 8, 16, 32}) {
    const Computed c = compute(radial);
    const double r = std::abs(c.radial_stress / exact.radial_stress(0.2) - 1.0);
    const double h = std::abs(c.hoop_stress / exact.hoop_stress(0.2) - 1.0);
    RecordProperty("radial_" + std::to_string(radial), std::to_string(r));
    RecordProperty("hoop_" + std::to_string(radial), std::to_string(h));
    if (before_r > 0.0) {
      EXPECT_GT(std::log2(before_r / r), 0.9) << radial;
      EXPECT_GT(std::log2(before_h / h), 0.9) << radial;
    }
    before_r = r;
    before_h = h;
  }
  EXPECT_LT(before_r, 0.02);
}

}  // namespace v09_stationary_spin
