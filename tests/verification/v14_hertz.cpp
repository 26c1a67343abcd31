// SPDX-License-Identifier: BSD-3-Clause
/// V14: half width and largest pressure of a line contact against Hertz; what the rim changes.
#include "support/hertz.hpp"

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
