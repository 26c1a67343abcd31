// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/space/obstacle_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "rondo/contact/space/road_ground.hpp"
#include "support/crg_files.hpp"

namespace obstacle_ground_test {

using namespace rondo;
using namespace rondo::contact;

const Obstacle cleat{ObstacleKind::cleat, 0.1, 0.02, 0.06, 0.5, 0.008};
const Obstacle pothole{ObstacleKind::pothole, 0.4, 0.03, 0.08, -0.4, 0.01};

std::shared_ptr<const BaseGround> level_ground() {
  return std::make_shared<const ProfileGround>(Ground(GroundShape{}));
}

std::shared_ptr<const BaseGround> slope(double by) {
  return std::make_shared<const ProfileGround>(
      Ground(GroundShape{.profile = {{-1.0, -by}, {1.0, by}}}));
}

/// The surface of a road with x = t1 and v = -t2, from -1 to 1 m along and 0.5 m to either side.
template <class Height>
std::shared_ptr<const BaseGround> road_of(Height&& height) {
  std::vector<double> v;
  for (int j = -40; j <= 40; ++j) v.push_back(0.0125 * j);
  return std::make_shared<const RoadGround>(
      road::Surface(test::road_by(height, -1.0, 0.0125, 161, v)), RoadPlacing{});
}

double waves(double u, double v) {
  return 0.01 * std::sin(4.0 * u) + 0.05 * v + 0.006 * std::cos(5.0 * v - u);
}

std::vector<Vec3> places(int n, double low, double high) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-0.1, 0.6), y(low, high), z(-0.1, 0.1);
  std::vector<Vec3> all;
  for (int k = 0; k < n; ++k) all.emplace_back(x(random), y(random), z(random));
  return all;
}

void expect_near(Vec3 a, Vec3 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

void expect_same(const SpaceTouches& a, const SpaceTouches& b, double tolerance) {
  ASSERT_EQ(a.count, b.count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) {
    EXPECT_NEAR(a.at[i].gap, b.at[i].gap, tolerance);
    expect_near(a.at[i].frame.normal, b.at[i].frame.normal, tolerance);
  }
}

/// A point straight above or below the surface.
Vec3 at_height(const SpaceGround& ground, Vec3 place, double above) {
  return {place.x, place.y - ground.clearance(place) + above, place.z};
}

TEST(ObstacleGround, OfOneAngleOnLevelGroundIsTheProfileInItsAxes) {
  const ObstacleGround ground(level_ground(), std::vector{cleat});
  const EdgeAxes axes(cleat.angle);
  Obstacle drawn = cleat;
  drawn.at *= std::cos(cleat.angle);
  const Ground profile(with_obstacles(GroundShape{}, std::vector{drawn}));
  int touching = 0, at_two = 0;
  for (const Vec3 place : places(20000, -0.01, 0.025)) {
    const SpaceTouches expected = extruded(profile.touches(axes.from_ground(place).plane()), axes);
    const SpaceTouches found = ground.touches(place);
    expect_same(found, expected, 1e-15);
    touching += found.count > 0 ? 1 : 0;
    at_two += found.count == 2 ? 1 : 0;
    if (found.count == 2)
      for (const SpaceTouch& touch : found.at)
        expect_near(touch.frame.line, axes.to_ground({0.0, 0.0, 1.0}), 1e-15);
  }
  EXPECT_GT(touching, 2000);
  EXPECT_GT(at_two, 20);
}

TEST(ObstacleGround, OnAFlatRoadIsThatOnLevelGround) {
  const std::vector<Obstacle> both{cleat, pothole};
  const ObstacleGround level(level_ground(), both),
      road(road_of([](double, double) { return 0.0; }), both);
  for (const Vec3 place : places(20000, -0.035, 0.025)) {
    expect_same(road.touches(place), level.touches(place), 1e-15);
    EXPECT_NEAR(road.clearance(place), level.clearance(place), 1e-15);
  }
}

/// The normal is that of the height as a function of the place.
TEST(ObstacleGround, NormalsAreThoseOfTheHeights) {
  for (const auto& base : {slope(0.2), road_of(waves)}) {
    const ObstacleGround ground(base, std::vector{cleat, pothole});
    int sloped = 0;
    for (const Vec3 place : places(20000, 0.0, 0.0)) {
      const Vec3 below = at_height(ground, place, -1e-9);
      const auto rise = [&](Vec3 by) {
        return (ground.clearance(below - by) - ground.clearance(below + by)) / (2.0 * norm(by));
      };
      const double step = 1e-6, along = rise({step, 0.0, 0.0}), across = rise({0.0, 0.0, step});
      if (!(std::hypot(along, across) < 3.0)) continue;  // a wall, or beside one
      const SpaceTouches touches = ground.touches(below);
      ASSERT_EQ(touches.count, 1) << place.x << " " << place.z;
      const Vec3 upward{-along, 1.0, -across};
      expect_near(touches.at[0].frame.normal, upward / norm(upward), 2e-3);
      EXPECT_NEAR(touches.at[0].gap, -1e-9 / norm(upward), 1e-11);
      sloped += touches.at[0].frame.normal.y < 0.9 ? 1 : 0;
    }
    EXPECT_GT(sloped, 100);
  }
}

TEST(ObstacleGround, FramesAreRightHandedAndOrthonormal) {
  const auto road = road_of(waves);
  const ObstacleGround ground(road, std::vector{cleat, pothole});
  int touching = 0, at_two = 0;
  for (const Vec3 place : places(20000, -0.034, 0.02)) {
    const SpaceTouches touches = ground.touches(at_height(*road, place, place.y));
    touching += touches.count > 0 ? 1 : 0;
    at_two += touches.count == 2 ? 1 : 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(touches.count); ++i) {
      const SpaceFrame& frame = touches.at[i].frame;
      EXPECT_NEAR(norm(frame.normal), 1.0, 1e-15);
      EXPECT_NEAR(norm(frame.line), 1.0, 1e-15);
      EXPECT_NEAR(dot(frame.normal, frame.line), 0.0, 1e-15);
      EXPECT_GT(frame.line.z, 0.7);
      EXPECT_LE(touches.at[i].gap, 0.0);
    }
    if (touches.count < 2) continue;
    expect_near(touches.at[0].frame.line, touches.at[1].frame.line, 0.0);
    const Vec3 cleat_side{-std::cos(cleat.angle), 0.0, std::sin(cleat.angle)};
    const Vec3 hole_side{-std::cos(pothole.angle), 0.0, std::sin(pothole.angle)};
    double wall = 0.0;  // one of both facets is a vertical wall, though the road is not level
    for (const SpaceTouch& touch : touches.at)
      wall = std::max({wall, std::abs(dot(touch.frame.normal, cleat_side)),
                       std::abs(dot(touch.frame.normal, hole_side))});
    EXPECT_NEAR(wall, 1.0, 1e-12);
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(at_two, 20);
}

TEST(ObstacleGround, AMirrorTurnsTheAngles) {
  const auto mirrored = [](Obstacle o) {
    o.angle = -o.angle;
    return o;
  };
  const ObstacleGround ground(level_ground(), std::vector{cleat, pothole});
  const ObstacleGround mirror(level_ground(), std::vector{mirrored(cleat), mirrored(pothole)});
  for (const Vec3 place : places(5000, -0.035, 0.025)) {
    const SpaceTouches a = ground.touches(place), b = mirror.touches({place.x, place.y, -place.z});
    ASSERT_EQ(a.count, b.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) {
      EXPECT_EQ(a.at[i].gap, b.at[i].gap);
      const Vec3 n = b.at[i].frame.normal;
      expect_near(a.at[i].frame.normal, {n.x, n.y, -n.z}, 0.0);
    }
  }
}

TEST(ObstacleGround, BesideObstaclesTheRoadIsAsItWas) {
  const auto road = road_of(waves);
  const ObstacleGround ground(road, std::vector{cleat, pothole});
  for (const Vec3 place : places(2000, 0.0, 0.0)) {
    const Vec3 before = at_height(*road, {place.x - 0.6, 0.0, place.z}, -1e-3);
    ASSERT_EQ(ground.touches(before).count, 1);
    expect_same(ground.touches(before), road->touches(before), 1e-15);
  }
}

TEST(ObstacleGround, NoGroundIsAboveItsTop) {
  const auto road = road_of(waves);
  const ObstacleGround ground(road, std::vector{cleat, pothole});
  const double top = ground.top(-0.1, 0.6);
  EXPECT_NEAR(top, road->top(-0.1, 0.6) + cleat.height, 1e-15);
  for (const Vec3 place : places(2000, 0.0, 0.0))
    EXPECT_LT(at_height(ground, place, 0.0).y, top + 1e-15);
}

TEST(ObstacleGround, AStepChangesTheLevelForTheOthers) {
  const Obstacle up{ObstacleKind::step, 0.0, 0.015, 0.0, 0.3, 0.01};
  const ObstacleGround ground(level_ground(), std::vector{cleat, up});
  EXPECT_NEAR(ground.clearance({-0.2, 0.0, 0.0}), 0.0, 1e-15);
  EXPECT_NEAR(ground.clearance({0.05, 0.0, 0.0}), -0.015, 1e-15);
  EXPECT_NEAR(ground.clearance({0.13, 0.0, 0.0}), -0.035, 1e-15);
  EXPECT_NEAR(ground.clearance({0.3, 0.0, 0.0}), -0.015, 1e-15);
  const SpaceTouches behind = ground.touches({0.3, 0.0149, 0.0});
  ASSERT_EQ(behind.count, 1);
  EXPECT_NEAR(behind.at[0].gap, -1e-4, 1e-15);
}

}  // namespace obstacle_ground_test
