// SPDX-License-Identifier: BSD-3-Clause
/// Friction by tables, over slip speed, pressure and place, against its formula and differences.
#include "rondo/contact/friction_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rondo::contact::friction_table_test {
namespace {

FrictionTable rubber() {
  return {.coefficient = 0.8,
          .slip = {{0.0, 1.0}, {0.5, 1.2}, {2.0, 0.9}},
          .pressure_exponent = -0.2,
          .pressure_reference = 1.0e5,
          .patches = {}};
}

double at(const FrictionTable& table, double slip, double pressure, Vec3 place = {}) {
  return friction_at(table, {place, slip, pressure}).coefficient;
}

TEST(FrictionTable, FollowsItsTableAndItsPower) {
  const FrictionTable table = rubber();
  EXPECT_NEAR(at(table, 0.25, 1.0e5), 0.8 * 1.1, 1e-15);
  EXPECT_NEAR(at(table, 1.0, 1.0e5), 0.8 * 1.1, 1e-15);
  EXPECT_NEAR(at(table, 9.0, 1.0e5), 0.8 * 0.9, 1e-15);
  EXPECT_NEAR(at(table, 0.0, 3.0e5), 0.8 * std::pow(3.0, -0.2), 1e-15);
}

TEST(FrictionTable, ThePressureCountsBetweenATenthAndTenTimesTheReference) {
  const FrictionTable table = rubber();
  EXPECT_EQ(at(table, 0.0, 0.0), at(table, 0.0, 1.0e4));
  EXPECT_EQ(at(table, 0.0, 1.0e9), at(table, 0.0, 1.0e6));
  EXPECT_NEAR(at(table, 0.0, 0.0), 0.8 * std::pow(0.1, -0.2), 1e-15);
}

TEST(FrictionTable, TheMostThatItGivesIsThatOfAllItsFactors) {
  FrictionTable table = rubber();
  EXPECT_DOUBLE_EQ(largest_friction(table), 0.8 * 1.2 * std::pow(10.0, 0.2));
  EXPECT_DOUBLE_EQ(largest_friction(table), at(table, 0.5, 0.0));
  table.patches = {{0.0, 1.0, Side::both, 0.2}, {2.0, 3.0, Side::both, 1.5}};
  EXPECT_DOUBLE_EQ(largest_friction(table), at(table, 0.5, 0.0, {2.5, 0.0, 0.0}));
  table.coefficient = 0.0;
  EXPECT_TRUE(table.is_constant());
}

TEST(FrictionTable, ItsSteepestRiseIsThatOfItsSteepestPieceAtThePressure) {
  FrictionTable table = rubber();
  EXPECT_NEAR(steepest_rise(table, 1.0e5), 0.8 * 0.4, 1e-15);
  EXPECT_NEAR(steepest_rise(table, 4.0e5), 0.8 * 0.4 * std::pow(4.0, -0.2), 1e-15);
  table.slip = {{0.0, 1.0}, {0.5, 0.8}, {0.6, 0.9}, {2.0, 0.5}};
  EXPECT_NEAR(steepest_rise(table, 1.0e5), 0.8 * 1.0, 1e-12);
  table.slip = {{0.0, 1.0}, {0.5, 0.8}};
  EXPECT_EQ(steepest_rise(table, 1.0e5), 0.0);
  table.slip.clear();
  EXPECT_EQ(steepest_rise(table, 1.0e5), 0.0);
}

TEST(FrictionTable, ItsDerivativesAreThoseOfDifferences) {
  const FrictionTable table = rubber();
  for (const double slip : {0.2, 0.7, 1.9, 3.0})
    for (const double pressure : {5.0e3, 3.0e4, 4.0e5, 2.0e6}) {
      const FrictionValue value = friction_at(table, {{}, slip, pressure});
      const double dw = 1e-6, dp = 1e-5 * pressure;
      EXPECT_NEAR(value.by_slip,
                  (at(table, slip + dw, pressure) - at(table, slip - dw, pressure)) / (2.0 * dw),
                  1e-9);
      EXPECT_NEAR(value.by_pressure * pressure,
                  (at(table, slip, pressure + dp) - at(table, slip, pressure - dp)) / 2e-5, 1e-9);
    }
}

TEST(FrictionTable, PatchesLieFromOnePlaceToAnotherAndOnTheirSide) {
  FrictionTable table;
  table.coefficient = 0.5;
  table.patches = {{3.0, 5.0, Side::left, 0.2}, {4.0, 6.0, Side::both, 0.5}};
  const auto here = [&](double x, double z) { return at(table, 0.0, 0.0, {x, 0.0, z}); };
  EXPECT_DOUBLE_EQ(here(2.9, -0.1), 0.5);
  EXPECT_DOUBLE_EQ(here(3.0, -0.1), 0.1);
  EXPECT_DOUBLE_EQ(here(3.5, 0.1), 0.5);
  EXPECT_DOUBLE_EQ(here(3.5, 0.0), 0.3) << "half of the node";
  EXPECT_NEAR(here(3.5, 1e-19), 0.3, 1e-15) << "whatever round-off makes of its place";
  EXPECT_DOUBLE_EQ(here(3.5, 0.0005), 0.4);
  EXPECT_DOUBLE_EQ(here(3.5, 0.001), 0.5);
  EXPECT_DOUBLE_EQ(here(4.5, -0.1), 0.05) << "one patch over another";
  EXPECT_DOUBLE_EQ(here(5.0, -0.1), 0.25);
  EXPECT_DOUBLE_EQ(here(6.0, -0.1), 0.5);
}

TEST(FrictionTable, WhatIsTheSameEverywhereIsAConstant) {
  FrictionTable table;
  table.coefficient = 0.7;
  EXPECT_TRUE(friction_of(table).is_constant());
  EXPECT_EQ(friction_of(table).constant(), 0.7);
  table.slip = {{0.0, 1.0}, {1.0, 1.0}};
  table.patches = {{0.0, 1.0, Side::both, 1.0}};
  EXPECT_EQ(friction_of(table).constant(), 0.7);
  table.slip[1][1] = 0.9;
  EXPECT_FALSE(friction_of(table).is_constant());
  EXPECT_NEAR(friction_of(table).coefficient({{}, 0.5, 0.0}), 0.665, 1e-15);
  EXPECT_FALSE(friction_of(rubber()).is_constant());
}

}  // namespace
}  // namespace rondo::contact::friction_table_test
