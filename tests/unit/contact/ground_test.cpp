// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace rondo;
using namespace rondo::contact;

namespace {
const GroundShape ledge{.profile = {{-10, -0.1}, {0, -0.1}, {0, 0}, {10, 0}}, .fillet = 0.02};
}

TEST(Ground, FlatGroundGoesOnForEver) {
  const Ground ground{GroundShape{}};
  for (const double x : {-1e6, -1.0, 0.0, 3.0, 1e6}) {
    EXPECT_EQ(ground.distance({x, 0.25}), 0.25);
    EXPECT_EQ(ground.touches({x, 0.25}).count, 0);
    const Touches t = ground.touches({x, -0.25});
    ASSERT_EQ(t.count, 1);
    EXPECT_EQ(t.at[0].gap, -0.25);
    EXPECT_EQ(t.at[0].normal, (Vec2{0.0, 1.0}));
    EXPECT_EQ(ground.abscissa({x, 0.1}), x + 1.0);
  }
  EXPECT_EQ(ground.touches({0.0, 0.0}).count, 1);  // g <= 0 is active
}

TEST(Ground, LedgeDistances) {
  const Ground ground{ledge};
  EXPECT_NEAR(ground.distance({-0.5, 0.0}), 0.1, 1e-15);      // above the lower floor
  EXPECT_NEAR(ground.distance({0.5, 0.03}), 0.03, 1e-15);     // above the upper one
  EXPECT_NEAR(ground.distance({-0.01, -0.05}), 0.01, 1e-15);  // before the wall
  EXPECT_NEAR(ground.distance({0.004, -0.05}), -0.004, 1e-15);
  // Round the fillet, centre (0.02, -0.02): all points on a circle have the same gap.
  for (const double angle : {95.0, 120.0, 135.0, 170.0}) {
    const Vec2 direction = rotation(angle * std::numbers::pi / 180);
    EXPECT_NEAR(ground.distance(Vec2{0.02, -0.02} + 0.025 * direction), 0.005, 1e-15) << angle;
    const Touches t = ground.touches(Vec2{0.02, -0.02} + 0.019 * direction);
    ASSERT_EQ(t.count, 1);
    EXPECT_NEAR(t.at[0].gap, -0.001, 1e-15);
    EXPECT_LT(norm(t.at[0].normal - direction), 1e-13);
  }
}

TEST(Ground, ConcaveCornerHoldsByTwoFacets) {
  const Ground ground{ledge};
  const Touches t = ground.touches({0.002, -0.101});
  ASSERT_EQ(t.count, 2);
  EXPECT_NEAR(t.at[0].gap, -0.002, 1e-15);  // deepest first: the wall
  EXPECT_EQ(t.at[0].normal, (Vec2{-1.0, 0.0}));
  EXPECT_NEAR(t.at[1].gap, -0.001, 1e-15);
  EXPECT_EQ(t.at[1].normal, (Vec2{0.0, 1.0}));
  EXPECT_EQ(ground.touches({-0.002, -0.101}).count, 1);
  EXPECT_EQ(ground.touches({0.002, -0.08}).count, 1);
  EXPECT_EQ(ground.touches({-1e-6, -0.1 + 1e-6}).count, 0);
}

TEST(Ground, ValleyHoldsByTwoFacetsFromEitherSide) {
  const Ground ground{GroundShape{.profile = {{-1, 0.5}, {0, 0}, {1, 0.5}}}};
  for (const double side : {-1.0, 1.0}) {  // below the one slope, behind the corner for the other
    const Touches t = ground.touches({0.01 * side, -0.01});
    ASSERT_EQ(t.count, 2) << side;
    EXPECT_NEAR(t.at[0].gap, -0.03 / std::sqrt(5.0), 1e-16);
    EXPECT_NEAR(t.at[1].gap, -0.01 / std::sqrt(5.0), 1e-16);
    EXPECT_LT(t.at[0].normal.x * side, 0.0);
    EXPECT_GT(t.at[1].normal.x * side, 0.0);
  }
}

TEST(Ground, AFarFacetDoesNotReachPastTheNearestOne) {
  // A valley, then a drop: the valley's first slope, prolonged, would pass above the drop's foot.
  const Ground ground{
      GroundShape{.profile = {{-1, 0.5}, {0, 0}, {1, 1}, {1.5, -5}, {9, -5}}, .fillet = 0.05}};
  EXPECT_EQ(ground.touches({2.5, -2.0}).count, 0);
  EXPECT_GT(ground.distance({2.5, -2.0}), 0.0);
}

TEST(Ground, DistanceIsContinuousAndOneLipschitz) {
  const Ground ground{ledge};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-0.2, 0.3), y(-0.2, 0.2), step(-1e-4, 1e-4);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 p{x(random), y(random)}, q = p + Vec2{step(random), step(random)};
    ASSERT_LE(std::abs(ground.distance(p) - ground.distance(q)), norm(p - q) + 1e-15);
    ASSERT_EQ(ground.touches(p).count > 0, ground.distance(p) <= 0.0);
  }
}

TEST(Ground, AbscissaIsTheLengthOfTheSurface) {
  const Ground ground{ledge};
  const double wall = 0.08, arc = 0.02 * std::numbers::pi / 2;
  EXPECT_NEAR(ground.abscissa({-1.0, 0.0}), 9.0, 1e-14);
  EXPECT_NEAR(ground.abscissa({-0.01, -0.06}), 10.0 + 0.04, 1e-14);
  EXPECT_NEAR(ground.abscissa({1.0, 0.2}), 10.0 + wall + arc + 0.98, 1e-13);
}

TEST(Ground, FaultsAreNamed) {
  const auto first = [](const GroundShape& shape) {
    const auto faults = shape_faults(shape);
    return faults.empty() ? std::string("none") : faults.front().message;
  };
  EXPECT_EQ(first(ledge), "none");
  EXPECT_NE(first({.profile = {{0, 0}}}).find("two points"), std::string::npos);
  EXPECT_NE(first({.profile = {{0, 0}, {0, 0}}}).find("coincides"), std::string::npos);
  EXPECT_NE(first({.profile = {{0, 0}, {-1, 0}}}).find("left"), std::string::npos);
  EXPECT_NE(first({.profile = {{0, 0}, {0, 1}, {0, 0.5}}}).find("turns back"), std::string::npos);
  EXPECT_NE(first({.profile = ledge.profile, .fillet = 0.0}).find("fillet > 0"), std::string::npos);
  EXPECT_NE(first({.profile = ledge.profile, .fillet = 0.11}).find("does not fit"),
            std::string::npos);
  EXPECT_EQ(first({.profile = ledge.profile, .fillet = 0.1}), "none");
  // A valley has no convex corner and needs no fillet.
  EXPECT_EQ(first({.profile = {{-1, 1}, {0, 0}, {1, 1}}}), "none");
}
