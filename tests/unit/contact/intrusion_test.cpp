// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/intrusion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace intrusion_test {

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

TEST(Intrusion, HiddenBetweenTwoNodes) {
  constexpr double h = 0.01;
  const auto hidden = [](std::vector<Vec2> profile, double fillet) {
    return hidden_between_nodes(Ground{GroundShape{std::move(profile), fillet}}, h);
  };
  // A post, as a whole.
  EXPECT_NEAR(hidden(post, 0.0).whole.depth, 0.02, 1e-12);
  EXPECT_NEAR(hidden(post, 0.0004).whole.depth, 0.02, 1e-12);
  // A corner of 90 degrees: half the spacing, and none of it as a whole.
  const std::vector<Vec2> corner{{-1, 0}, {0, 0}, {0, -1}};
  EXPECT_NEAR(hidden(corner, 0.0).deepest.depth, 0.5 * h, 0.005 * h);
  EXPECT_LT(norm(hidden(corner, 0.0).deepest.at), 1e-15);
  EXPECT_EQ(hidden(corner, 0.0).whole.depth, 0.0);
  // An arc of the spacing: its height over a chord.
  EXPECT_NEAR(hidden(corner, h).deepest.depth, (1.0 - std::sqrt(0.75)) * h, 0.002 * h);
  EXPECT_NEAR(hidden(corner, 5.0 * h).deepest.depth, (5.0 - std::sqrt(24.75)) * h, 0.002 * h);
  // A corner of a small angle δ: h δ/4.
  EXPECT_NEAR(hidden({{-1, 0}, {0, 0}, {1, -0.05}}, 0.0).deepest.depth, 0.0125 * h, 0.0002 * h);
  // A valley and flat ground hide nothing.
  EXPECT_EQ(hidden({{-1, 1}, {0, 0}, {1, 1}}, 0.0).deepest.depth, 0.0);
  EXPECT_EQ(hidden({{-1, 0}, {1, 0}}, 0.0).deepest.depth, 0.0);
}

/// What is as long as the nodes are apart is met somewhere; what is shorter may stand between them.
TEST(Intrusion, ObstaclesShorterThanTheSpacingAreHiddenAsAWhole) {
  constexpr double h = 0.01, high = 0.001;
  for (const double foot : {0.2, 0.9, 1.1, 2.0}) {
    const double x = 0.5 * foot * h;
    const Ground ground{GroundShape{.profile = {{-1, 0}, {-x, 0}, {0, high}, {x, 0}, {1, 0}}}};
    const Hidden hidden = hidden_between_nodes(ground, h);
    if (foot < 1.0)
      EXPECT_NEAR(hidden.whole.depth, high, 1e-15) << foot;
    else
      EXPECT_EQ(hidden.whole.depth, 0.0) << foot;
  }
}

}  // namespace intrusion_test
