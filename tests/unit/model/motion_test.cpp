// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace motion_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {
const Table ramp({{0.1, 2.0}, {0.3, 6.0}, {0.4, -1.0}});
}

TEST(Table, ValuesAndSlopes) {
  EXPECT_EQ(ramp.at(-1.0), 2.0);
  EXPECT_EQ(ramp.at(0.1), 2.0);
  EXPECT_NEAR(ramp.at(0.2), 4.0, 1e-15);
  EXPECT_EQ(ramp.at(0.3), 6.0);
  EXPECT_NEAR(ramp.at(0.35), 2.5, 1e-14);
  EXPECT_EQ(ramp.at(9.0), -1.0);
  EXPECT_EQ(ramp.slope(0.0), 0.0);
  EXPECT_NEAR(ramp.slope(0.1), 20.0, 1e-13);  // just after the knot
  EXPECT_NEAR(ramp.slope(0.3), -70.0, 1e-13);
  EXPECT_EQ(ramp.slope(0.4), 0.0);
  EXPECT_EQ(ramp.largest(), 6.0);
}

TEST(Table, IntegralsAreExactAcrossKnots) {
  // By hand: 0.1·2 + 0.2·4 + 0.1·2.5 + 0.1·(-1) over [0, 0.5].
  EXPECT_NEAR(ramp.integral(0.0, 0.5), 0.2 + 0.8 + 0.25 - 0.1, 1e-15);
  EXPECT_NEAR(ramp.integral(0.5, -0.5), -(0.2 + 0.8 + 0.25 - 0.1), 1e-15);
  EXPECT_NEAR(ramp.integral(0.2, 0.15), ramp.integral(0.0, 0.35) - ramp.integral(0.0, 0.2), 1e-15);
  for (const double from : {0.0, 0.15, 0.29, 0.33})
    for (const double length : {0.01, 0.1, 0.5})
      EXPECT_NEAR(ramp.change(from, length), ramp.at(from + length) - ramp.at(from), 1e-14);
}

TEST(Motion, ConstantMotionAdvancesBySameBitsAtEveryStep) {
  Motion m;
  m.angular_velocity = Table(33.3);
  m.speed = Table(10.0);
  const double dt = 1.23e-5;
  const FrameStep first = frame_step(m, 0, dt);
  for (const long long n : {1LL, 77LL, 123456LL, 987654321LL}) {
    const FrameStep f = frame_step(m, n, dt);
    EXPECT_EQ(f.advance, first.advance);
    EXPECT_EQ(f.turn, first.turn);
    EXPECT_EQ(f.pull, Vec2{});  // no acceleration out of round-off, however far the body has gone
  }
}

TEST(Motion, RollsTowardsPlusXWithClockwiseAngle) {
  Motion m;
  m.angular_velocity = Table(2.0);
  m.speed = Table(0.6);
  m.height = Table(0.3);
  m.start_x = -1.0;
  const FrameStep f = frame_step(m, 100, 0.01);
  EXPECT_NEAR(f.angle, -2.0, 1e-14);
  EXPECT_NEAR(f.center.x, -0.4, 1e-15);
  EXPECT_EQ(f.center.y, 0.3);
  EXPECT_EQ(f.spin, -2.0);
  // The lowest point of a rolling disk stands still: V - ωR with R = 0.3.
  EXPECT_NEAR(0.6 + (turn90(f.spin * Vec2{0.0, -0.3})).x, 0.0, 1e-15);
}

TEST(Motion, KinkOfTheHeightIsOneImpulse) {
  Motion m;
  m.height = Table({{0.0, 0.31}, {0.105, 0.31}, {0.205, 0.29}});
  const double dt = 0.01;
  double velocity_change = 0.0;
  for (int n = 5; n < 15; ++n) velocity_change += dt * frame_step(m, n, dt).pull.y;
  EXPECT_NEAR(velocity_change, -0.2, 1e-12);
  Motion falling;
  falling.height = Table({{0.0, 1.0}, {1.0, 0.0}});
  EXPECT_EQ(frame_step(falling, 0, dt).pull.y, 0.0);  // it moved like that before the start
}

TEST(Motion, GravityFollowsItsTable) {
  Motion m;
  m.gravity = Table({{0.0, 0.0}, {0.5, 10.0}});
  EXPECT_EQ(frame_step(m, 0, 0.01).pull, Vec2{});
  EXPECT_NEAR(frame_step(m, 25, 0.01).pull.y, 5.0, 1e-14);  // at t = 0.25: half way
  EXPECT_EQ(frame_step(m, 80, 0.01).pull, (Vec2{0.0, 10.0}));
}

TEST(Table, TheIntegralFromTheStartHasTheBitsOfItsPieces) {
  const Table table({{-1.0, 2.0}, {0.0, 1.7}, {0.3, -0.9}, {0.31, 4.1}, {2.0, 4.1}, {2.7, 0.3}});
  for (const double end : {1e-3, 0.3, 0.305, 0.31, 1.0, 2.0, 2.5, 2.7, 9.0}) {
    double sum = 0.0, done = 0.0;
    for (const auto& point : table.points()) {
      if (point[0] <= 0.0 || point[0] >= end) continue;
      const double part = point[0] - done;
      sum += part * (table.at(done) + 0.5 * table.slope(done) * part);
      done = point[0];
    }
    sum += (end - done) * (table.at(done) + 0.5 * table.slope(done) * (end - done));
    EXPECT_EQ(table.integral(0.0, end), sum) << end;
    EXPECT_NEAR(table.integral(0.0, end),
                table.integral(-0.5, end + 0.5) - table.integral(-0.5, 0.5), 1e-14);
  }
}

}  // namespace motion_test
