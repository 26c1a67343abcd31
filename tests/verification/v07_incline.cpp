// SPDX-License-Identifier: BSD-3-Clause
/// V7: an elastic block on an incline and on the flat (docs/validation.md). Expected: Coulomb's law
/// for a rigid block.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/model/corotated.hpp"
#include "support/incline.hpp"
#include "support/traps.hpp"

namespace v07_incline {

using namespace rondo;
using namespace rondo::dynamics;

/// Not a block released unloaded, which slips while it loads: gravity grows slowly.
TEST(Incline, ABlockThatSticksDoesNotCreep) {
  for (const double angle : {15.0, 30.0}) {
    test::Incline incline{.angle = angle};
    incline.friction = 1.5 * std::tan(incline.radians());
    const test::FloatingPointTraps traps;
    const test::Stuck stuck = test::stick(incline, 10000);
    EXPECT_EQ(stuck.sticking, 9) << angle;
    EXPECT_EQ(stuck.before, stuck.after) << angle;  // to the last bit
    // It has come down with its foot, by less than its weight would press it together.
    EXPECT_LT(norm(stuck.before[0]), 1000.0 * 9.81 * incline.height() / incline.youngs) << angle;
  }
}

/// The law knows no length: the same acceleration at three scales, to the same accuracy.
TEST(Incline, ASlidingBlockAcceleratesAsCoulombHasIt) {
  for (const double scale : {0.1, 1.0, 10.0}) {
    const test::Incline incline{.friction = 0.3, .scale = scale};
    const Model model = test::incline_model(incline);
    const std::vector<Vec2> none(model.n_nodes());
    test::Stepping run(model, start(model, none, none));
    const test::FloatingPointTraps traps;
    run.advance_to(40.0 * incline.period());
    const Vec2 before = test::mean_velocity(model, run.state());
    const double from = run.report().frame.time;
    run.advance_to(60.0 * incline.period());
    const Vec2 gained = test::mean_velocity(model, run.state()) - before;
    const double time = run.report().frame.time - from;
    const double acceleration = dot(gained, incline.down()) / time;
    RecordProperty(fmt::format("scale_{}", scale), fmt::format("{:.9f}", acceleration));
    // 20 periods after the ramp a tenth of critical damping has left e^{-12} of what was up and
    // down, some g Δt, and it is a mean over 20 periods. Across it may be more: gaps are round-off,
    // and where that opens a node for a step its mass, a 45th and less, falls by g Δt.
    const double of_a_node = incline.gravity * model.dt / 45.0;
    EXPECT_NEAR(acceleration, 2.356287, 1e-6) << scale;
    EXPECT_LT(std::abs(cross(incline.down(), gained)), of_a_node) << scale;
    EXPECT_EQ(run.report().contact.nodes, 9);
    EXPECT_EQ(run.report().contact.sticking, 0);
  }
}

/// Let go at 5 m/s, under its weight already: v²/(2μg). What an elastic block stores on its way, of
/// the order of ρ g H/E, is the difference, so a stiffer one has less of it.
TEST(Incline, ABlockStopsWhereItsEnergyIsGone) {
  const double distance = 2.548420, speed = 5.0;
  double before = 0.0;
  for (const double youngs : {1e7, 1e8, 1e9}) {
    test::Incline flat{.angle = 0.0, .friction = 0.0, .youngs = youngs};
    const Model settling = test::incline_model(flat);
    const std::vector<Vec2> none(settling.n_nodes());
    test::Stepping rest(settling, start(settling, none, none));
    rest.advance_to(80.0 * flat.period());
    flat.friction = 0.5;
    Model model = test::incline_model(flat);
    model.motion.gravity = Table(flat.gravity);
    const std::span<const Vec2> u = rest.state().u.plane();
    test::Stepping run(model,
                       start(model, rest.state().u, std::vector<Vec2>(u.size(), Vec2{speed, 0.0})));
    const double from = mean_pose(model, model.free_bodies[0], u, {}).center.x;
    const test::FloatingPointTraps traps;
    run.advance_to(1.1);  // it stops at 1.02 s
    const double way = run.state().poses[0].center.x - from;
    RecordProperty(fmt::format("E_{:.0e}", youngs), fmt::format("{:.8f}", way));
    const double off = std::abs(way / distance - 1.0);
    EXPECT_LT(off, 0.1 * 1000.0 * flat.gravity * flat.height() / youngs + 2e-7) << youngs;
    EXPECT_LT(norm(test::mean_velocity(model, run.state())), 1e-3 * speed);
    if (before > 0.0) {
      EXPECT_LT(off, 0.5 * before);
    }
    before = off;
  }
}

}  // namespace v07_incline
