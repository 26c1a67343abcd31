// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/intrusion.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace rondo;
using namespace rondo::contact;

namespace {

/// A post 20 mm high and 1 mm wide.
const std::vector<Vec2> post{{-1, 0}, {0, 0}, {0, 0.02}, {0.001, 0.02}, {0.001, 0}, {1, 0}};

}  // namespace

TEST(Intrusion, SharpCornerInsideASide) {
  const Ground ground{GroundShape{.profile = post}};
  // The body is above the side, whose ends are outside the ground.
  const Intrusion found = deepest_inside(ground, {-0.004, 0.012}, {0.006, 0.012}, 0.1);
  EXPECT_NEAR(found.depth, 0.008, 1e-17);
  EXPECT_EQ(found.at.y, 0.02);
  // Tilted: the corner that is deeper.
  const Vec2 a{-0.004, 0.012}, b{0.006, 0.014};
  EXPECT_EQ(deepest_inside(ground, a, b, 0.1).at, (Vec2{0.0, 0.02}));
  EXPECT_EQ(deepest_inside(ground, {-0.004, 0.014}, {0.006, 0.012}, 0.1).at, (Vec2{0.001, 0.02}));
}

TEST(Intrusion, NothingBesideAboveBelowOrBehind) {
  const Ground ground{GroundShape{.profile = post}};
  EXPECT_EQ(deepest_inside(ground, {0.002, 0.012}, {0.012, 0.012}, 0.1).depth, 0.0);
  EXPECT_EQ(deepest_inside(ground, {-0.004, 0.021}, {0.006, 0.021}, 0.1).depth, 0.0);
  EXPECT_EQ(deepest_inside(ground, {-0.004, 0.012}, {0.006, 0.012}, 0.007).depth, 0.0);  // too deep
  EXPECT_EQ(deepest_inside(ground, {0.006, 0.03}, {-0.004, 0.03}, 0.1).depth, 0.0);  // body below
  EXPECT_EQ(deepest_inside(ground, {0.0, 0.012}, {0.0, 0.012}, 0.1).depth, 0.0);     // no side
}

TEST(Intrusion, ArcIsMetWhereItIsDeepest) {
  constexpr double radius = 0.01;
  const Ground ground{GroundShape{.profile = {{-1, 0}, {0, 0}, {0, -1}}, .fillet = radius}};
  const Vec2 center{-radius, -radius};
  for (const double degrees : {10.0, 45.0, 80.0}) {
    const Vec2 normal = direction_at(degrees * 0.017453292519943295);
    const Vec2 middle = center + (radius - 0.002) * normal, along = turn90(normal);
    const Intrusion found =
        deepest_inside(ground, middle + 0.01 * along, middle - 0.01 * along, 0.1);
    EXPECT_NEAR(found.depth, 0.002, 1e-15) << degrees;
    EXPECT_LT(norm(found.at - (center + radius * normal)), 1e-15) << degrees;
  }
  // A side that leans beyond the end of the arc meets that end.
  const Vec2 normal = direction_at(100.0 * 0.017453292519943295), end = center + Vec2{0, radius};
  const Vec2 middle = end - 0.003 * normal;
  const Intrusion found =
      deepest_inside(ground, middle + 0.005 * turn90(normal), middle - 0.005 * turn90(normal), 0.1);
  EXPECT_NEAR(found.depth, 0.003, 1e-15);
  EXPECT_LT(norm(found.at - end), 1e-15);
}
