// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/space/road_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "support/crg_files.hpp"

namespace road_ground_test {

using namespace rondo;
using namespace rondo::contact;
using road::Border;
using road::Road;
using road::Surface;
using rondo::test::road_by;

const RoadPlacing placing{3.4, 0.05, 0.0};

std::vector<double> even_v(int n = 41, double step = 0.0125) {
  std::vector<double> v;
  for (int j = 0; j < n; ++j) v.push_back(step * (j - n / 2));
  return v;
}

/// u from 3 to 4 m, v from -0.25 to 0.25 m.
template <class Height>
RoadGround ground_by(Height&& height, const RoadPlacing& where = placing) {
  return {Surface(road_by(height, 3.0, 0.0125, 81, even_v())), where};
}

double waves(double u, double v) {
  return 0.018 * std::sin(40.0 * u + 5.0 * v) + 0.006 * std::cos(60.0 * v - 9.0 * u);
}

/// Places on the part of the road that is not near its borders, above and below.
std::vector<Vec3> places(int n, double depth) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-0.3, 0.5), z(-0.12, 0.22), y(-depth, depth);
  std::vector<Vec3> all;
  for (int k = 0; k < n; ++k) all.emplace_back(x(random), y(random), z(random));
  return all;
}

Vec3 point_at(const RoadGround& ground, double u, double v) {
  return {u - placing.start, ground.surface().at(u, v).height - placing.height, placing.offset - v};
}

/// The least distance of a point to the surface, around (u, v): a grid that closes in.
double distance_by_search(const RoadGround& ground, Vec3 place) {
  double u = place.x + placing.start, v = placing.offset - place.z, size = 4e-3;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 44; ++round, size *= 0.5) {
    const double at_u = u, at_v = v;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j) {
        const double to_u = at_u + 0.25 * i * size, to_v = at_v + 0.25 * j * size;
        const double distance = norm(point_at(ground, to_u, to_v) - place);
        if (distance < least) least = distance, u = to_u, v = to_v;
      }
  }
  return least;
}

TEST(RoadGround, AFlatRoadIsFlatGroundToTheLastBit) {
  const RoadGround ground = ground_by([](double, double) { return 123.456; }, {3.4, 0.05, 123.456});
  const Ground flat({});
  for (const Vec3 place : places(500, 1e-3)) {
    const SpaceTouches found = ground.touches(place),
                       expected = extruded(flat.touches(place.plane()));
    ASSERT_EQ(found.count, expected.count);
    EXPECT_EQ(ground.clearance(place), place.y);
    if (found.count == 0) continue;
    EXPECT_EQ(found.at[0].gap, expected.at[0].gap);
    EXPECT_EQ(found.at[0].frame.normal, expected.at[0].frame.normal);
    EXPECT_EQ(found.at[0].frame.line, expected.at[0].frame.line);
    EXPECT_EQ(found.at[0].frame.tangent(), expected.at[0].frame.tangent());
  }
  EXPECT_EQ(ground.top(-0.2, 0.2), 0.0);
}

/// A slope along and a banking: the foot and the distance are those of a plane.
TEST(RoadGround, ABankedSlopeIsAPlane) {
  constexpr double along = 0.3, banking = -0.2;
  const auto height = [](double u, double v) { return along * (u - 3.4) + banking * (v - 0.05); };
  const RoadGround ground = ground_by(height);
  const Vec3 up{-along, 1.0, banking};
  const Vec3 normal = up / norm(up);
  int touches = 0;
  for (const Vec3 place : places(500, 0.2)) {
    const double gap = dot(normal, place);
    const SpaceTouches found = ground.touches(place);
    ASSERT_EQ(found.count, gap <= 0.0 ? 1 : 0) << gap;
    EXPECT_NEAR(ground.clearance(place), gap * norm(up), 1e-8);
    if (found.count == 0) continue;
    ++touches;
    const RoadFoot foot = ground.foot_of(place);
    EXPECT_NEAR(found.at[0].gap, gap, 1e-8);
    EXPECT_LT(norm(found.at[0].frame.normal - normal), 1e-7);
    EXPECT_LT(norm(point_at(ground, foot.u, foot.v) - (place - gap * normal)), 1e-7);
  }
  EXPECT_GT(touches, 200);
}

TEST(RoadGround, TheGapIsTheLeastDistanceAndTwoStepsFindIt) {
  const RoadGround ground = ground_by(waves);
  int touches = 0;
  double worst = 0.0, third = 0.0, turned = 0.0, steepest = 0.0;
  for (Vec3 place : places(400, 1e-3)) {
    place.y += waves(place.x + placing.start, placing.offset - place.z);
    const SpaceTouches found = ground.touches(place);
    ASSERT_EQ(found.count, ground.clearance(place) <= 0.0 ? 1 : 0);
    if (found.count == 0) continue;
    ++touches;
    const RoadFoot foot = ground.foot_of(place), next = ground.foot_of(place, 3),
                   found_foot = ground.foot_of(place, 9);
    const Vec3 up{-found_foot.surface.slope_u, 1.0, found_foot.surface.slope_v};
    turned = std::max(turned, norm(found.at[0].frame.normal - up / norm(up)));
    steepest = std::max(steepest, std::hypot(foot.surface.slope_u, foot.surface.slope_v));
    worst = std::max(worst, std::abs(distance_by_search(ground, place) + found.at[0].gap));
    third = std::max(third, std::hypot(next.u - foot.u, next.v - foot.v));
  }
  EXPECT_GT(touches, 150);
  EXPECT_GT(steepest, 0.8);
  EXPECT_LT(worst, 1e-13);  // [m], of up to 1 mm
  EXPECT_LT(third, 1e-9);
  EXPECT_LT(turned, 1e-9);  // [rad]
}

/// The road is a sine wave, the same all across; distances are compared with those to the curve.
TEST(RoadGround, AFineWaveHasTheNormalsOfItsFunction) {
  constexpr double size = 0.01, k = 2.0 * std::numbers::pi / 0.4;
  const RoadGround ground{Surface(road_by([](double u, double) { return size * std::sin(k * u); },
                                          3.0, 1e-3, 1001, even_v())),
                          placing};
  for (int i = 0; i < 200; ++i) {
    const double u = 3.1 + 0.004 * i, slope = size * k * std::cos(k * u);
    const Vec3 normal = Vec3{-slope, 1.0, 0.0} / std::hypot(1.0, slope);
    const Vec3 foot{u - placing.start, size * std::sin(k * u), 0.01};
    const SpaceTouches found = ground.touches(foot - 2e-4 * normal);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.at[0].gap, -2e-4, 3e-8);
    EXPECT_LT(norm(found.at[0].frame.normal - normal), 3e-4);
  }
}

TEST(RoadGround, FramesAreRightHandedWithATangentInThePlaneOfTheHeading) {
  const RoadGround ground = ground_by(waves);
  for (Vec3 place : places(200, 1e-3)) {
    place.y = point_at(ground, place.x + placing.start, placing.offset - place.z).y - 5e-4;
    const SpaceTouches found = ground.touches(place);
    ASSERT_EQ(found.count, 1);
    const auto& [normal, line] = found.at[0].frame;
    const Vec3 tangent = found.at[0].frame.tangent();
    EXPECT_NEAR(norm(normal), 1.0, 1e-15);
    EXPECT_NEAR(norm(line), 1.0, 1e-15);
    EXPECT_NEAR(dot(normal, line), 0.0, 1e-15);
    EXPECT_NEAR(tangent.z, 0.0, 1e-15);
    EXPECT_LT(norm(cross(normal, tangent) - line), 1e-15);
    EXPECT_GT(line.z, 0.5);
    const Vec3 some{0.3, -1.2, 0.7};
    EXPECT_LT(norm(found.at[0].frame.from(found.at[0].frame.to(some)) - some), 4e-15);  // of 1.4
  }
}

TEST(RoadGround, AMirroredRoadHasMirroredTouches) {
  const RoadGround ground = ground_by(waves, {3.4, 0.05, 0.0});
  const RoadGround other =
      ground_by([](double u, double v) { return waves(u, -v); }, {3.4, -0.05, 0.0});
  for (Vec3 place : places(300, 1e-3)) {
    place.y += waves(place.x + placing.start, placing.offset - place.z);
    const SpaceTouches a = ground.touches(place), b = other.touches({place.x, place.y, -place.z});
    ASSERT_EQ(a.count, b.count);
    if (a.count == 0) continue;
    EXPECT_NEAR(a.at[0].gap, b.at[0].gap, 1e-15);
    EXPECT_LT(std::abs(a.at[0].frame.normal.z + b.at[0].frame.normal.z), 1e-12);
    EXPECT_LT(norm(a.at[0].frame.normal.plane() - b.at[0].frame.normal.plane()), 1e-12);
  }
}

TEST(RoadGround, NothingRisesAboveItsTop) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(0.0, 0.001), x(-0.6, 0.9), z(-0.3, 0.3);
  Road road = road_by([&](double u, double) { return 0.1 * u + height(random); }, 3.0, 0.0025, 401,
                      even_v());
  for (const Border border : {Border::keep, Border::zero, Border::repeat, Border::reflect}) {
    road.edges = {border, border, 0.002, 0.004};
    const RoadGround ground{Surface(road), {3.4, 0.05, 0.35}};
    for (int k = 0; k < 3000; ++k) {
      const Vec3 place{x(random), 0.0, z(random)};
      EXPECT_LE(-ground.clearance(place), ground.top(place.x - 0.01, place.x + 0.02));
    }
    EXPECT_LT(ground.top(-0.3, -0.2), ground.top(0.2, 0.3)) << "it follows the slope";
  }
}

TEST(RoadGround, WhereThereIsNoRoadThereIsNoTouch) {
  Road road = road_by([](double, double) { return 0.0; }, 3.0, 0.0125, 81, even_v());
  road.edges = {Border::none, Border::none, 0.0, 0.0};
  const RoadGround ground{Surface(road), placing};
  EXPECT_EQ(ground.touches({0.0, -1e-3, 0.0}).count, 1);
  for (const Vec3 place : {Vec3{0.7, -1e-3, 0.0}, Vec3{0.0, -1e-3, 0.4}}) {
    EXPECT_EQ(ground.touches(place).count, 0);
    EXPECT_EQ(ground.clearance(place), std::numeric_limits<double>::infinity());
  }
}

/// Deeper than a crest is round, where the nearest place is not a minimum in reach, the touch is
/// still one of the surface, and is felt.
TEST(RoadGround, DeepUnderACrestItIsHeld) {
  const RoadGround ground = ground_by(
      [](double u, double v) { return 0.006 * std::cos(130.0 * u) * std::cos(110.0 * v); });
  int behind = 0;
  for (Vec3 place : places(2000, 0.0)) {
    place.y = -0.03;
    const SpaceTouches found = ground.touches(place);
    ASSERT_EQ(found.count, 1);
    EXPECT_LT(found.at[0].gap, 0.0);
    EXPECT_GT(found.at[0].frame.normal.y, 0.5);
    const RoadFoot foot = ground.foot_of(place);
    const Vec3 up{-foot.surface.slope_u, 1.0, foot.surface.slope_v};
    behind += dot(up, place - point_at(ground, foot.u, foot.v)) > 0.0 ? 1 : 0;
  }
  EXPECT_GT(behind, 0) << "places whose foot has its tangent plane behind them";
}

}  // namespace road_ground_test
