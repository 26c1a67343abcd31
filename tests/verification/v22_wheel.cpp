// SPDX-License-Identifier: BSD-3-Clause
/// V22, besides its rows: a wheel that settles under its load, against statics; what a run with
/// given forces does, given as motion to another one, gives the forces back.
#include <gtest/gtest.h>

#include "support/loaded_wheel.hpp"
#include "support/traps.hpp"
#include "support/wheel_rows.hpp"

namespace v22_wheel {

using namespace rondo;

/// 0.8 of the critical one, with a rim that is free to move and with α.
TEST(WheelUnderLoad, StepsAsTheOtherProgram) {
  EXPECT_NEAR(test::Wheel({}).dt(), 1.989712e-5, 1e-6 * 1.989712e-5);
  EXPECT_NEAR(test::Wheel({"damping.mass=0"}).dt(), 1.993297e-5, 1e-6 * 1.993297e-5);
}

/// Contact stops a node as deep in the ground as it came in its last step. With the ground as deep
/// under each node, statics has the height of the run; with flat ground, the other program's.
TEST(WheelUnderLoad, SettlesWhereStaticsHasIt) {
  test::DiskCase of_statics;
  of_statics.disk.radial = 12;
  of_statics.disk.circumferential = 180;
  const test::Built body = test::build(of_statics);
  const double flat = test::load_wheel(body, 1e5, 0.0).height;
  EXPECT_NEAR(flat, 0.29382877, 5e-9);
  for (const test::Column column : {test::Column::full, test::Column::half}) {
    test::Wheel wheel(
        test::with(test::resolution(column),
                   {"motion.speed=0", "motion.angular_velocity=0", "rim.free=[\"height\"]",
                    "ground.friction=0", "rim.force_y=[[0, 0], [0.01, -1e5]]"}));
    {
      const test::FloatingPointTraps traps;
      wheel.look(0.0, 0.25, [](const dynamics::StepReport&) {});
    }
    const dynamics::StepReport& last = wheel.run().report();
    EXPECT_NEAR(last.contact.impulse.y, 1e5 * wheel.dt(), 1e-6 * 1e5 * wheel.dt());  // at rest
    std::vector<double> sunk(body.mesh.boundary.size());
    for (const dynamics::ActiveContact& contact : wheel.run().state().active)
      sunk[contact.candidate] = -contact.gap;
    const double height = last.frame.center.y;
    RecordProperty(test::column_name(column), fmt::format("{:.8f}", height));
    EXPECT_NEAR(height, test::load_wheel(body, 1e5, 0.0, sunk).height, 1e-8);
    EXPECT_LT(std::abs(height - flat), last.contact.penetration);
  }
}

/// The braked wheel's height and spin, held, give its forces and its brake back.
TEST(WheelUnderLoad, ItsMotionHeldGivesItsForcesBack) {
  const test::FloatingPointTraps traps;
  test::Wheel braked({"rim.brake=[[0, 0], [0.05, 0], [0.1, 1e4]]"});
  const test::WheelMeans given = braked.means(0.2, 0.3);
  test::Wheel held({"rim.free=[]", "rim.force_y=0", "rim.support.y.damping=0",
                    fmt::format("motion.height=[[0, 0.3], [0.03, {:.17g}]]", given.height),
                    fmt::format("motion.angular_velocity={:.17g}", given.spin)});
  const test::WheelMeans found = held.means(0.2, 0.3);
  RecordProperty("force_x", fmt::format("{:.3f}", found.force.x));
  RecordProperty("force_y", fmt::format("{:.3f}", found.force.y));
  RecordProperty("torque", fmt::format("{:.3f}", found.hub_torque));
  // The other program's: -34,221, 149,994, 9,998.5 where it had been given -34,227, 150,000,
  // 10,000. A held height does not swing with the pitch of the nodes as a free one does, 1e-4 of
  // the load.
  EXPECT_NEAR(found.force.x, given.force.x, 1e-4 * 1.5e5);
  EXPECT_NEAR(found.force.y, given.force.y, 1e-4 * 1.5e5);
  EXPECT_NEAR(found.hub_torque, -1e4, 1e-4 * 1.5e5 * 0.3);
  EXPECT_NEAR(found.hub_force.x, -found.force.x, 1e-4 * 1.5e5);
  EXPECT_NEAR(found.hub_force.y, -found.force.y, 1e-4 * 1.5e5);
}

}  // namespace v22_wheel
