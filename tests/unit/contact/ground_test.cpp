// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace ground_test {

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
  // Round the fillet, center (0.02, -0.02): all points on a circle have the same gap.
  for (const double angle : {95.0, 120.0, 135.0, 170.0}) {
    const Vec2 direction = direction_at(angle * std::numbers::pi / 180);
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

TEST(Ground, TheNearestFacetIsGivenInsideAndOutside) {
  const Ground ground{ledge};
  for (const double y : {0.03, 0.0, -0.001}) {
    const Touch t = ground.facet_near({0.5, y});
    EXPECT_NEAR(t.gap, y, 1e-16);
    EXPECT_EQ(t.normal, (Vec2{0.0, 1.0}));
  }
  const Touch arc = ground.facet_near(Vec2{0.02, -0.02} + 0.025 * direction_at(2.0));
  EXPECT_NEAR(arc.gap, 0.005, 1e-15);
  EXPECT_NEAR(norm(arc.normal - direction_at(2.0)), 0.0, 1e-14);
}

TEST(Ground, TellsHowFarTheOtherFacetOfAConcaveCornerIs) {
  const Ground ground{ledge};
  EXPECT_NEAR(ground.beside_concave_corner({-0.3, -0.1}), 0.3, 1e-15);      // floor to wall
  EXPECT_NEAR(ground.beside_concave_corner({-0.001, -0.05}), 0.05, 1e-15);  // wall to floor
  EXPECT_EQ(ground.beside_concave_corner({0.5, 0.0}), std::numeric_limits<double>::infinity());
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

TEST(Ground, SharpConvexCornersAreListed) {
  const Ground ground{GroundShape{.profile = ledge.profile}};
  ASSERT_EQ(ground.corners().size(), 1u);
  const Corner& corner = ground.corners()[0];
  EXPECT_EQ(corner.position, (Vec2{0.0, 0.0}));
  EXPECT_EQ(corner.normals[0], (Vec2{-1.0, 0.0}));
  EXPECT_EQ(corner.normals[1], (Vec2{0.0, 1.0}));
  EXPECT_TRUE(Ground{ledge}.corners().empty());  // a fillet rounds it
  const GroundShape in_line{.profile = {{-1, 0}, {0, 0}, {1, 0}, {2, -1}, {3, 0}, {4, 0}}};
  ASSERT_EQ(Ground{in_line}.corners().size(), 2u);
  EXPECT_EQ(Ground{in_line}.corners()[0].position, (Vec2{1.0, 0.0}));
  EXPECT_EQ(Ground{in_line}.corners()[1].position, (Vec2{3.0, 0.0}));
}

TEST(Ground, ArcsBelowTheSpacingOfNodesAreCorners) {
  const Ground ground{ledge, 0.021};
  ASSERT_EQ(ground.corners().size(), 1u);
  const Corner& corner = ground.corners()[0];
  EXPECT_EQ(corner.radius, 0.02);
  EXPECT_LT(norm(corner.center - Vec2{0.02, -0.02}), 1e-16);
  EXPECT_LT(norm(corner.position - (corner.center + 0.02 * direction_at(0.75 * std::numbers::pi))),
            1e-16);
  EXPECT_NEAR(ground.bend_reach(), 0.005 * std::numbers::pi, 1e-16);
  const Ground resolved{ledge, 0.02};
  EXPECT_TRUE(resolved.corners().empty());
  EXPECT_EQ(resolved.bends().size(), 1u);
}

TEST(Ground, BluntTurnsAreNoCorners) {
  GroundShape noisy;
  noisy.profile.clear();
  for (int i = 0; i <= 1000; ++i) noisy.profile.push_back({0.01 * i, i % 2 * 1e-12});
  const Ground ground{noisy, 0.01};
  EXPECT_TRUE(ground.corners().empty());
  EXPECT_FALSE(ground.has_concave_corners());
  EXPECT_EQ(ground.touches({5.0, -0.001}).count, 1);
  const auto corners = [](double turn) {  // a hill and its valleys
    const Ground hill{GroundShape{.profile = {{-2, 0}, {-1, 0}, {0, turn}, {1, 0}, {2, 0}}}};
    return std::pair(hill.corners().size(), hill.has_concave_corners());
  };
  EXPECT_EQ(corners(0.51 * blunt_turn), std::pair(std::size_t{1}, false));
  EXPECT_EQ(corners(0.49 * blunt_turn), std::pair(std::size_t{0}, false));
  EXPECT_EQ(corners(1.01 * blunt_turn), std::pair(std::size_t{1}, true));
}

/// Many turns that are blunt each: a round bar of 5 mm in a thousand pieces.
TEST(Ground, BluntTurnsAddUpWithinASpacing) {
  GroundShape bar;
  bar.profile = {{-1, 0}};
  for (int i = 0; i <= 1000; ++i)
    bar.profile.push_back(0.005 * direction_at(std::numbers::pi * (1.0 - 0.001 * i)));
  bar.profile.push_back({1, 0});
  EXPECT_TRUE(Ground(bar, 1e-6).corners().empty());
  const Ground ground{bar, 0.01};
  EXPECT_NEAR(static_cast<double>(ground.corners().size()), std::numbers::pi / blunt_turn, 70.0);
  for (std::size_t k = 1; k < ground.corners().size(); ++k)
    EXPECT_LT(norm(ground.corners()[k].position - ground.corners()[k - 1].position), 1e-4);
}

TEST(Ground, BesideASharpCornerTheNearerFacetHolds) {
  const Ground ground{GroundShape{.profile = ledge.profile}};
  const auto hold = [&](Vec2 x) {
    const Touches t = ground.touches(x);
    EXPECT_EQ(t.count, 1);
    return t.at[0];
  };
  EXPECT_EQ(hold({0.01, -0.002}).normal, (Vec2{0.0, 1.0}));
  EXPECT_NEAR(hold({0.01, -0.002}).gap, -0.002, 1e-18);
  EXPECT_EQ(hold({0.002, -0.01}).normal, (Vec2{-1.0, 0.0}));
  EXPECT_NEAR(hold({0.002, -0.01}).gap, -0.002, 1e-18);
  EXPECT_EQ(hold({0.0, 0.0}).gap, 0.0);
  EXPECT_EQ(ground.touches({-0.002, 0.001}).count, 0);
  EXPECT_EQ(ground.touches({-0.002, -0.01}).count, 0);
  EXPECT_NEAR(ground.distance({-0.003, 0.004}), 0.005, 1e-17);  // from the corner itself
}

/// Outside an acute corner a point is behind the line of one of its facets.
TEST(Ground, OutsideAnAcuteCornerNothingTouches) {
  const Ground ground{GroundShape{.profile = {{-9, 0}, {0, 0}, {0.05, 1}, {0.1, 0}, {9, 0}}}};
  EXPECT_EQ(ground.touches({0.05, 1.1}).count, 0);
  EXPECT_EQ(ground.touches({0.06, 1.001}).count, 0);  // behind the left facet's line
  EXPECT_EQ(ground.touches({0.04, 1.001}).count, 0);
  EXPECT_NEAR(ground.distance({0.06, 1.001}), std::hypot(0.01, 1e-3), 1e-16);
  EXPECT_EQ(ground.touches({0.05, 0.99}).count, 1);
  EXPECT_LT(ground.distance({0.05, 0.99}), 0.0);
  EXPECT_GT(ground.touches({0.055, 0.85}).at[0].normal.x, 0.0);
  EXPECT_LT(ground.touches({0.045, 0.85}).at[0].normal.x, 0.0);
}

/// The sign of the distance is that of the solid: below the profile, walked from left to right.
TEST(Ground, SharpDistanceIsContinuousAndHasTheRightSign) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int round = 0; round < 100; ++round) {
    GroundShape shape{.profile = {{-3.0, u(random)}}};
    for (double x = -2.0; x < 3.0; x += 0.3 + 0.3 * std::abs(u(random)))
      shape.profile.push_back({x, 1.5 * u(random)});
    shape.profile.push_back({3.5, u(random)});
    ASSERT_TRUE(shape_faults(shape).empty());
    const Ground ground(shape);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p{2.5 * u(random), 2.5 * u(random)}, q = p + 1e-3 * Vec2{u(random), u(random)};
      std::size_t k = 0;
      while (shape.profile[k + 1].x < p.x) ++k;
      const Vec2 a = shape.profile[k], b = shape.profile[k + 1];
      const bool below = cross(b - a, p - a) < 0.0;
      ASSERT_EQ(ground.distance(p) < 0.0, below) << round << " " << i;
      ASSERT_EQ(ground.touches(p).count > 0, below);
      ASSERT_LE(std::abs(ground.distance(p) - ground.distance(q)), norm(p - q) + 1e-15);
    }
  }
}

/// Of a profile with many points only those near are looked at: the same as with all of them.
TEST(Ground, ManyFacetsAreSearched) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  GroundShape shape{.profile = {{0.0, 0.0}}};
  for (int i = 0; i < 400; ++i) {
    const bool step = unit(random) < 0.2;  // vertical
    const Vec2 before = shape.profile.back();
    shape.profile.push_back({before.x + (step ? 0.0 : 0.05 * unit(random)),
                             step ? before.y + (unit(random) < 0.5 ? -0.1 : 0.1)
                                  : before.y + 0.1 * unit(random) - 0.05});
    if (std::abs(shape.profile.back().y - before.y) < 1e-9) shape.profile.pop_back();
  }
  while (!shape_faults(shape).empty())  // steps up and down again
    shape.profile.erase(shape.profile.begin() + shape_faults(shape).front().point);
  ASSERT_GT(shape.profile.size(), 200U);
  const Ground ground(shape);
  const auto& p = shape.profile;
  for (int trial = 0; trial < 3000; ++trial) {
    const double far = trial % 10 == 0 ? 100.0 : 1.0;
    const Vec2 x{far * 14.0 * (unit(random) - 0.1), far * 4.0 * (unit(random) - 0.5)};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      const Vec2 d = p[i + 1] - p[i];
      const double low = i == 0 ? -1e9 : 0.0, high = i + 2 == p.size() ? 1e9 : 1.0;
      const double along = std::clamp(dot(x - p[i], d) / dot(d, d), low, high);
      least = std::min(least, norm(x - (p[i] + along * d)));
    }
    EXPECT_NEAR(std::abs(ground.distance(x)), least, 1e-12 * (1.0 + norm(x))) << trial;
  }
}

/// The corners of a stretch are all that have a point in it.
TEST(Ground, CornersOfAStretch) {
  for (const double fillet : {0.0, 1e-3}) {
    GroundShape shape{.profile = {{-10.0, 0.0}}, .fillet = fillet};
    for (int i = 0; i < 50; ++i)
      for (const double y : {0.0, 0.01}) shape.profile.push_back({0.02 * i + 2.0 * y / 4.0, y});
    ASSERT_TRUE(shape_faults(shape).empty());
    const Ground ground(shape, 0.01);
    ASSERT_EQ(ground.corners().size(), 49U);
    for (const double low : {-20.0, 0.2, 0.7, 5.0}) {
      const auto some = ground.corners(low, low + 0.1);
      for (const Corner& corner : ground.corners()) {
        const bool inside = corner.position.x >= low && corner.position.x <= low + 0.1;
        const bool listed = &corner >= some.data() && &corner < some.data() + some.size();
        EXPECT_TRUE(listed || !inside) << low;
        if (fillet == 0.0) {
          EXPECT_EQ(listed, inside) << low;
        }
      }
    }
  }
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
  // Found by fuzzing: a direction of rounded numbers, which was no unit vector.
  EXPECT_NE(first({.profile = {{0, 5e-324}, {5e-324, 0}}}).find("coincides"), std::string::npos);
  // Found by fuzzing: the length between two points was not finite, nor any distance.
  EXPECT_NE(first({.profile = {{-1.7e308, 0}, {1.7e308, 0}}}).find("origin"), std::string::npos);
  EXPECT_NE(first({.profile = ledge.profile, .fillet = 1e300}).find("at most"), std::string::npos);
  EXPECT_EQ(first({.profile = ledge.profile, .fillet = 0.0}), "none");  // sharp
  EXPECT_NE(first({.profile = ledge.profile, .fillet = -0.1}).find(">= 0"), std::string::npos);
  EXPECT_NE(first({.profile = ledge.profile, .fillet = 0.11}).find("does not fit"),
            std::string::npos);
  EXPECT_EQ(first({.profile = ledge.profile, .fillet = 0.1}), "none");
  EXPECT_EQ(first({.profile = {{-1, 1}, {0, 0}, {1, 1}}}), "none");
}

}  // namespace ground_test
