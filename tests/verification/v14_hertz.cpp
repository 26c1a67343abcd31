// SPDX-License-Identifier: BSD-3-Clause
/// V14: half width and largest pressure of a line contact against Hertz; what the rim changes.
#include "support/hertz.hpp"

namespace v14_hertz {

using namespace rondo;

/// What is left at the finest mesh: (a/R)² = 0.15 %, by which a circle is no parabola, and some
/// 0.1 % of the layers. On few nodes the fit follows where the outermost one stands.
TEST(Hertz, HalfWidthAndPressure) {
  const auto coarse = test::deviation_from_hertz(0.05, 10, 400);
  EXPECT_LT(std::abs(coarse.half_width), 0.06);
  EXPECT_LT(std::abs(coarse.pressure), 0.012);
  const auto middle = test::deviation_from_hertz(0.05, 20, 800);
  EXPECT_LT(std::abs(middle.half_width), 5e-3);
  EXPECT_LT(std::abs(middle.pressure), 3e-3);
  const auto fine = test::deviation_from_hertz(0.05, 40, 1600);  // a/h = 10
  EXPECT_LT(std::abs(fine.half_width), 2e-3);
  EXPECT_LT(std::abs(fine.pressure), 2e-3);
  EXPECT_LT(fine.misfit, 0.5 * middle.misfit);  // of the ellipse; first order at least
}

TEST(Hertz, GivesThePublishedFigures) {
  const test::Hertz exact = test::hertz(test::nearly_incompressible);
  EXPECT_NEAR(exact.half_width, 10.775e-3, 5e-7);  // the digits given
  EXPECT_NEAR(exact.pressure, 118.164e3, 0.5);
}

/// ν = 0.49. B-bar converges to Hertz as full integration does for ν = 0.3, a node of the edge of
/// the contact later; full integration is too stiff here, and its pressure too high and uneven.
TEST(Hertz, NearlyIncompressibleByBBar) {
  const auto middle = test::deviation_from_hertz(0.05, 20, 800, test::nearly_incompressible);
  EXPECT_LT(std::abs(middle.half_width), 0.02);
  EXPECT_LT(std::abs(middle.pressure), 8e-3);
  const auto fine = test::deviation_from_hertz(0.05, 40, 1600, test::nearly_incompressible);
  EXPECT_LT(std::abs(fine.half_width), 7e-3);
  EXPECT_LT(std::abs(fine.pressure), 2e-3);
  EXPECT_LT(fine.misfit, 0.8 * middle.misfit);
  fem::Material full = test::nearly_incompressible;
  full.integration = fem::Integration::full;
  const auto locked = test::deviation_from_hertz(0.05, 20, 800, full);
  EXPECT_LT(locked.half_width, -0.05);
  EXPECT_GT(locked.pressure, 0.05);
  EXPECT_GT(locked.misfit, 3.0 * middle.misfit);
}

/// A rigid rim nearer than some widths of the contact makes it narrower and the pressure higher.
TEST(Hertz, TheRimNarrowsTheContact) {
  const auto thick = test::deviation_from_hertz(0.15, 40, 1600);  // 0.15 m, 13 half widths
  EXPECT_LT(std::abs(thick.half_width), 2.5e-3);
  EXPECT_LT(std::abs(thick.pressure), 2.5e-3);
  const auto thin = test::deviation_from_hertz(0.25, 40, 1600);  // 0.05 m, 4 half widths
  EXPECT_LT(thin.half_width, thick.half_width - 5e-3);
  EXPECT_GT(thin.pressure, thick.pressure + 1e-2);
  EXPECT_GT(thin.half_width, -0.02);
  EXPECT_LT(thin.pressure, 0.02);
}

}  // namespace v14_hertz
