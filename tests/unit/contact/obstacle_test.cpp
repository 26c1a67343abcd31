// SPDX-License-Identifier: BSD-3-Clause
/// Obstacles on a ground, against profiles that are drawn by hand.
#include "rondo/contact/obstacle.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rondo::contact::obstacle_test {
namespace {

using enum ObstacleKind;

const GroundShape flat{.profile = {{-1, 0}, {1, 0}}, .fillet = 0.5};

TEST(Obstacle, ACleatIsABar) {
  const std::vector<Obstacle> bar{
      {.kind = cleat, .at = 0.5, .height = 0.01, .length = 0.02, .fillet = 0.002}};
  const GroundShape shape = with_obstacles(flat, bar);
  const std::vector<Vec2> drawn{{-1, 0}, {0.5, 0}, {0.5, 0.01}, {0.52, 0.01}, {0.52, 0}, {1, 0}};
  EXPECT_EQ(shape.profile, drawn);
  EXPECT_EQ(shape.radii, (std::vector<double>{0.5, 0.002, 0.002, 0.002, 0.002, 0.5}));
  ASSERT_TRUE(shape_faults(shape).empty());
  const Ground ground(shape);
  EXPECT_NEAR(ground.distance({0.51, 0.02}), 0.01, 1e-15);
  EXPECT_NEAR(ground.distance(Vec2{0.502, 0.008} + Vec2{-0.003, 0.004}), 0.003, 1e-15)
      << "its edge is round";
  EXPECT_TRUE(ground.corners().empty());
}

TEST(Obstacle, BeyondTheEndsOfTheProfileTheGroundGoesOn) {
  const GroundShape slope{.profile = {{0, 0}, {1, 0.1}}};
  const std::vector<Obstacle> before{{.kind = cleat, .at = -3, .height = 0.01, .length = 0.1}};
  const std::vector<Obstacle> behind{{.kind = step, .at = 2, .height = -0.05}};
  const Ground with_cleat(with_obstacles(slope, before)), with_step(with_obstacles(slope, behind)),
      alone(slope);
  for (const double x : {-5.0, -3.5, 0.5, 3.0})
    EXPECT_NEAR(with_cleat.distance({x, 1}), alone.distance({x, 1}), 1e-14) << x;
  EXPECT_NEAR(with_cleat.facet_near({-2.95, -0.28}).gap, alone.distance({-2.95, -0.29}), 1e-14);
  EXPECT_NEAR(with_step.distance({1, 1}), alone.distance({1, 1}), 1e-14);
  EXPECT_NEAR(with_step.distance({5, 1}), alone.distance({5, 1.05}), 1e-14);
}

TEST(Obstacle, PotholesAndStairsFollowEachOther) {
  const std::vector<Obstacle> stairs{{.kind = step, .at = 0.2, .height = 0.05},
                                     {.kind = pothole, .at = -0.5, .height = 0.1, .length = 0.3},
                                     {.kind = step, .at = 0.4, .height = -0.02}};
  ASSERT_TRUE(obstacle_faults(flat, stairs).empty());
  const std::vector<Vec2> drawn{{-1, 0},  {-0.5, 0},   {-0.5, -0.1}, {-0.2, -0.1}, {-0.2, 0},
                                {0.2, 0}, {0.2, 0.05}, {0.4, 0.05},  {0.4, 0.03},  {1, 0.03}};
  const std::vector<Vec2> made = with_obstacles(flat, stairs).profile;
  ASSERT_EQ(made.size(), drawn.size());
  for (std::size_t i = 0; i < made.size(); ++i) EXPECT_LT(norm(made[i] - drawn[i]), 1e-15) << i;
}

TEST(Obstacle, AtAPointOfTheProfileItIsThere) {
  const GroundShape ledge{.profile = {{-1, 0}, {0, 0}, {0, 0.1}, {1, 0.1}}};
  const std::vector<Obstacle> on{{.kind = cleat, .at = 0, .height = 0.01, .length = 0.5}};
  const std::vector<Vec2> drawn{{-1, 0}, {0, 0}, {0, 0.11}, {0.5, 0.11}, {0.5, 0.1}, {1, 0.1}};
  EXPECT_EQ(with_obstacles(ledge, on).profile, drawn);
  const std::vector<Obstacle> two{{.kind = cleat, .at = 0.2, .height = 0.01, .length = 0.1},
                                  {.kind = cleat, .at = 0.3, .height = 0.01, .length = 0.1}};
  EXPECT_TRUE(obstacle_faults(flat, two).empty());
  EXPECT_EQ(with_obstacles(flat, two).profile.size(), 6u) << "they touch: it is one";
  EXPECT_EQ(with_obstacles(ledge, {}).profile, ledge.profile);
  // u - 0.5 of the rows of a road is not x of a case, by round-off.
  const GroundShape rows{.profile = {{-1, 0}, {0.8 - 0.5, 0}, {1, 0}}};
  const std::vector<Obstacle> bar{
      {.kind = cleat, .at = 0.3, .height = 0.01, .length = 0.1, .fillet = 0.002}};
  ASSERT_NE(rows.profile[1].x, bar[0].at);
  EXPECT_EQ(with_obstacles(rows, bar).profile.size(), 6u);
  EXPECT_TRUE(shape_faults(with_obstacles(rows, bar)).empty());
}

TEST(Obstacle, WhatIsNoneIsRefused) {
  const auto members = [](Obstacle o, const GroundShape& base = flat) {
    std::string all;
    for (const ObstacleFault& fault : obstacle_faults(base, std::vector<Obstacle>{o}))
      all += fault.member + " ";
    return all;
  };
  EXPECT_EQ(members({.kind = cleat, .height = 0.01, .length = 0.02, .fillet = 0.01}), "");
  EXPECT_EQ(members({.kind = cleat, .height = -0.01, .length = 0.02}), "height ");
  EXPECT_EQ(members({.kind = pothole, .height = 0.01}), "length ");
  EXPECT_EQ(members({.kind = step}), "height ");
  EXPECT_EQ(members({.kind = step, .height = -0.01, .fillet = 0.02}), "fillet ");
  EXPECT_EQ(members({.kind = cleat, .height = 0.02, .length = 0.03, .fillet = 0.02}), "fillet ");
  const GroundShape cliff{.profile = {{-1, 0}, {0, 0}, {0, -1}}};
  EXPECT_EQ(members({.kind = step, .at = 1, .height = 1}, cliff), "at ");
  const std::vector<Obstacle> two{{.kind = cleat, .at = 0.2, .height = 0.01, .length = 0.1},
                                  {.kind = step, .at = 0.25, .height = 0.01}};
  const auto faults = obstacle_faults(flat, two);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].obstacle, 1u);
  EXPECT_EQ(faults[0].message, "begins within the obstacle from x = 0.2 to 0.3 m");
}

}  // namespace
}  // namespace rondo::contact::obstacle_test
