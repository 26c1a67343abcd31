// SPDX-License-Identifier: BSD-3-Clause
/// Load and deflection of a tyre, one from the other, and what is unusual of them.
#include "rondo/analysis/build/tyre/pressed_tyre.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rondo::study::test::pressed_tyre_test {
namespace {

/// A 205/55 R16: 14.4 kN of pressure times width times radius, 250 N/mm.
InflationFigures usual() {
  InflationFigures f;
  f.pressure = 2.2e5;
  f.width = 0.207;
  f.outer_radius = 0.316;
  return f;
}
const InflationFigures state = usual();
const PressedTyre tyre{state, {0.316, 0.1}};

std::string warning_of(const PhysicalFigures& told) {
  EXPECT_LE(told.warnings.size(), 1U);  // one slip, one warning
  return told.warnings.empty() ? "" : told.warnings[0];
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << part << "\" is not in \"" << text << "\"";
}

/// A plane cuts a torus: the strips of the cut are summed, and their area times the pressure is the
/// load.
TEST(PressedTyre, TheAirBearsWhatAPlaneCutsOfATorus) {
  const double depth = 1e-4, tube = 0.5 * state.width, ring = state.outer_radius - tube;
  const double floor = state.outer_radius - depth;
  const double half_length = std::sqrt(state.outer_radius * state.outer_radius - floor * floor);
  constexpr int parts = 2000;
  double area = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double x = half_length * (2.0 * (i + 0.5) / parts - 1.0);
    const double r = std::hypot(x, floor) - ring;  // in the section of the tube
    area += 2.0 * std::sqrt(tube * tube - r * r) * 2.0 * half_length / parts;
  }
  EXPECT_NEAR(air_stiffness(state) * depth / (state.pressure * area), 1.0, 2e-3);
}

TEST(PressedTyre, LoadAndDeflectionFollowFromEachOther) {
  const PhysicalFigures loaded = under_load("analysis.load", 4000.0, tyre);
  ASSERT_EQ(loaded.figures.size(), 2U);
  EXPECT_EQ(loaded.figures[0].second,
            "4000 N, 0.278 of pressure times width times radius; the air bears it on 0.0182 m2");
  EXPECT_TRUE(has(loaded.figures[1].second, "about 0.016 m, 16 % of the 0.1 m of the wall"));
  EXPECT_EQ(warning_of(loaded), "");
  const PhysicalFigures pressed = pressed_in("motion.height", 0.016, tyre);
  ASSERT_EQ(pressed.figures.size(), 2U);
  EXPECT_EQ(pressed.figures[0].second, "0.016 m, 16 % of the 0.1 m of the wall");
  EXPECT_TRUE(has(pressed.figures[1].second, "about 4000 N, 0.28 of pressure times width"));
  EXPECT_EQ(warning_of(pressed), "");
}

TEST(PressedTyre, LoadsThatNoTyreBears) {
  const auto warned = [](double load) { return warning_of(under_load("rim.force_y", load, tyre)); };
  EXPECT_TRUE(has(warned(4.0), "rim.force_y: the load of 4 N is 0.00028 times"));
  EXPECT_TRUE(has(warned(4.0), "it hardly presses the tyre; is the load in N"));
  EXPECT_EQ(warned(60.0), "");
  EXPECT_EQ(warned(8000.0), "");
  EXPECT_TRUE(has(warned(9000.0), "comes down by about 0.036 m, 36 % of the 0.1 m of the wall"));
  EXPECT_TRUE(has(warned(4e5), "28 times the 14391 N of pressure times width times radius"));
  EXPECT_TRUE(has(warned(4e5), "the air cannot bear it"));
}

TEST(PressedTyre, DeeperThanTyresBear) {
  const auto warned = [](double way) { return warning_of(pressed_in("motion.height", way, tyre)); };
  EXPECT_EQ(warned(0.034), "");
  EXPECT_TRUE(has(warned(0.036), "motion.height: the rim comes down by 0.036 m, 36 %"));
  EXPECT_TRUE(has(warned(0.036), "give a larger motion.height"));
}

TEST(PressedTyre, WithoutAirThereIsNoEstimate) {
  InflationFigures flat = state;
  flat.pressure = 0.0;
  const PhysicalFigures told = pressed_in("motion.height", 0.016, {flat, tyre.wall});
  ASSERT_EQ(told.figures.size(), 1U);
  EXPECT_EQ(told.figures[0].first, "deflection");
}

TEST(PressedTyre, StaysClearOfTheGround) {
  const auto told = [](double gap, double lean) {
    return stays_clear("motion.height", gap, lean, tyre);
  };
  EXPECT_TRUE(has(told(0.004, 0.0), "whose radius is 0.316 m, stays 0.004 m above the ground"));
  EXPECT_EQ(told(0.004, 0.05), "");   // a shoulder may touch
  EXPECT_EQ(told(0.004, -0.05), "");  // the other one
  EXPECT_TRUE(has(told(0.006, 0.05), "nothing presses it"));
  EXPECT_EQ(told(276.0, 0.0), "");  // stays_above_ground() tells that
}

}  // namespace
}  // namespace rondo::study::test::pressed_tyre_test
