// SPDX-License-Identifier: BSD-3-Clause
/// V23, besides its rows: what must hold for any wheel whose rim forces move, whatever it does:
/// mirrored it does the mirrored thing, parked it stays, thrown up it comes down, and a slope is
/// the same as tilted ground.
#include <gtest/gtest.h>

#include <numbers>

#include "support/traps.hpp"
#include "support/wheel_rows.hpp"

namespace v23_free_wheel {

using namespace rondo;
using dynamics::StepReport;

namespace {

const test::Settings coarse{"disk.mesh.radial=6", "disk.mesh.circumferential=90"};

std::vector<StepReport> steps_of(const test::Settings& settings, double end) {
  test::Wheel wheel(test::with(coarse, settings));
  std::vector<StepReport> steps;
  wheel.look(0.0, end, [&](const StepReport& r) { steps.push_back(r); });
  return steps;
}

}  // namespace

/// Sums over the nodes come in another order: 1e-16 each, which landing nodes make larger.
TEST(FreeWheel, MirroredTorqueAndSpinMirrorTheRun) {
  const test::FloatingPointTraps traps;
  const auto run = [](double sign) {
    return steps_of(
        {test::all_free, "motion.speed=0", fmt::format("motion.angular_velocity={}", 5.0 * sign),
         fmt::format("rim.torque=[[0, 0], [0.02, {}]]", 1e4 * sign),
         "rim.brake=[[0, 0], [0.04, 0], [0.05, 5e3]]"},
        0.06);
  };
  const std::vector<StepReport> there = run(1.0), back = run(-1.0);
  double spin = 0.0, speed = 0.0, height = 0.0, impulse = 0.0;
  for (std::size_t i = 0; i < there.size(); ++i) {
    const StepReport &a = there[i], &b = back[i];
    spin = std::max(spin, std::abs(a.rim.spin + b.rim.spin));
    speed = std::max(speed, std::abs(a.rim.velocity.x + b.rim.velocity.x));
    height = std::max(height, std::abs(a.frame.center.y - b.frame.center.y));
    const Vec3 c = a.contact.impulse, d = b.contact.impulse;
    impulse = std::max({impulse, std::abs(c.x + d.x), std::abs(c.y - d.y)});
    ASSERT_EQ(a.contact.nodes, b.contact.nodes) << i;
  }
  EXPECT_GT(there.back().rim.velocity.x, 1.0);  // it has gone somewhere
  EXPECT_LT(spin, 1e-10 * there.back().rim.spin);
  EXPECT_LT(speed, 1e-10 * there.back().rim.velocity.x);
  EXPECT_LT(height, 1e-10 * 0.3);
  EXPECT_LT(impulse, 1e-9 * there.back().contact.impulse.y);
}

/// Braked to rest on a slope of 5°, it keeps its angle to the bit, sways on its rubber, and rolls
/// off when the brake is let go.
TEST(FreeWheel, ParkedUnderItsBrakeItKeepsItsAngleToTheBit) {
  const test::FloatingPointTraps traps;
  test::Wheel wheel(test::with(
      coarse,
      {test::all_free, "motion.slope=0.0872664626", "motion.gravity=9.81", "rim.mass=2000",
       "ground.friction=0.9", "rim.force_y=0", "motion.speed=1", "motion.angular_velocity=3.34",
       "rim.brake=[[0, 0], [0.1, 0], [0.2, 5e3], [0.9, 5e3], [0.91, 0]]"}));
  wheel.look(0.0, 0.6, [](const StepReport&) {});
  const double angle = wheel.run().report().frame.angle;
  EXPECT_LT(angle, -0.3);
  double swayed = 0.0;
  wheel.look(0.6, 0.9, [&](const StepReport& r) {
    EXPECT_EQ(r.frame.angle, angle);
    EXPECT_EQ(r.rim.spin, 0.0);
    EXPECT_FALSE(std::signbit(r.rim.spin));
    swayed = std::max(swayed, std::abs(r.rim.velocity.x));
  });
  EXPECT_GT(swayed, 0.0);
  EXPECT_LT(swayed, 0.1);
  wheel.look(0.9, 1.1, [](const StepReport&) {});
  EXPECT_LT(wheel.run().report().frame.angle, angle - 0.01);
  EXPECT_GT(wheel.run().report().rim.spin, 0.1);
}

/// Lifted off by its load, it flies with its angular momentum, and lands to roll as before.
TEST(FreeWheel, LiftsOffAndLandsAgain) {
  const test::FloatingPointTraps traps;
  test::Wheel wheel(test::with(
      coarse, {"rim.force_y=[[0, 0], [0.01, -1.5e5], [0.1, -1.5e5], [0.11, 1e5], [0.2, 1e5], "
               "[0.22, -1.5e5]]"}));
  const test::WheelMeans before = wheel.means(0.06, 0.1);
  wheel.look(0.1, 0.15, [](const StepReport&) {});
  int nodes = 0;
  double highest = 0.0;
  const test::WheelMeans flying = [&] {
    test::WheelMeans m;
    wheel.look(0.15, 0.2, [&](const StepReport& r) {
      m.see(r, wheel.dt());
      nodes += r.contact.nodes;
      highest = std::max(highest, r.frame.center.y);
    });
    return m;
  }();
  EXPECT_EQ(nodes, 0);
  EXPECT_EQ(flying.force, Vec2{});
  EXPECT_GT(highest, 0.32);
  wheel.look(0.2, 0.45, [](const StepReport&) {});
  const test::WheelMeans after = wheel.means(0.45, 0.49);
  EXPECT_GT(after.force.y, 0.0);
  EXPECT_NEAR(after.force.y, before.force.y, 1e-3 * before.force.y);
  EXPECT_NEAR(after.spin, before.spin, 1e-3 * before.spin);
  EXPECT_NEAR(after.height, before.height, 1e-3 * 0.008);  // of how deep it is pressed
  EXPECT_LT(wheel.run().balance().relative, 1e-12);
}

/// Ground tilted by three sectors under upright gravity, and flat ground under tilted gravity.
TEST(FreeWheel, ASlopeIsTiltedGround) {
  const test::FloatingPointTraps traps;
  const double slope = 3.0 * 4.0 * std::numbers::pi / 180.0, c = std::cos(slope),
               s = std::sin(slope);
  const test::Settings both{test::all_free,
                            "rim.force_y=0",
                            "motion.gravity=500",
                            "motion.speed=0",
                            "rim.support.y.damping=0",
                            "ground.friction=0.8",
                            "motion.angular_velocity=1"};
  const auto flat = steps_of(
      test::with(both, {fmt::format("motion.slope={:.17g}", slope), "motion.height=0.3"}), 0.1);
  const auto tilted = steps_of(
      test::with(both, {fmt::format("ground.profile=[[{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]",
                                    -10.0 * c, 10.0 * s, 10.0 * c, -10.0 * s),
                        fmt::format("motion.start_x={:.17g}", 0.3 * s),
                        fmt::format("motion.height={:.17g}", 0.3 * c)}),
      0.1);
  const auto along = [&](Vec2 v) { return Vec2{c * v.x - s * v.y, s * v.x + c * v.y}; };
  double place = 0.0, spin = 0.0, impulse = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const StepReport &a = flat[i], &b = tilted[i];
    place = std::max(place, norm(a.frame.center.plane() - along(b.frame.center.plane())));
    spin = std::max(spin, std::abs(a.rim.spin - b.rim.spin));
    impulse = std::max(impulse, norm(a.contact.impulse.plane() - along(b.contact.impulse.plane())));
    largest = std::max(largest, norm(a.contact.impulse));
    ASSERT_EQ(a.contact.nodes, b.contact.nodes) << i;
  }
  EXPECT_GT(flat.back().frame.center.x, 0.1);
  EXPECT_LT(place, 1e-10 * 0.3);
  EXPECT_LT(spin, 1e-9 * flat.back().rim.spin);
  EXPECT_LT(impulse, 1e-8 * largest);
}

}  // namespace v23_free_wheel
