// SPDX-License-Identifier: BSD-3-Clause
/// A wheel with friction that falls with the slip speed, against CONTACT (docs/validation.md, V44).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/falling_friction.hpp"

namespace v44_falling_friction {

using namespace rondo;
using contact::Status;

/// All digits that CONTACT prints.
TEST(FallingFriction, AWheelHasTheForceOfABranchOfContact) {
  const test::LineContact line;
  const statics::RollingProblem<2> problem = line.problem();
  const statics::RollingFriction law{test::falling_friction(), {line.element * line.length}};
  statics::RollingDrive drive = line.drive(-1e-3, 0.3);
  drive.law = &law;
  const statics::RollingState s = line.solved(problem, drive);
  const statics::RollingForces f = forces_of(problem, s.point);
  double pressure = 0.0;
  for (Eigen::Index j = 0; j < problem.size(); j += 2)
    pressure = std::max(pressure, s.point.force[j] / law.extent[0]);
  const auto count = [&](Status status) {
    return std::ranges::count(s.statuses, status, &statics::RollingStatus::status);
  };
  RecordProperty("force, pressure, stick, slip, steps, restarts, problems",
                 fmt::format("{:.5f} {:.2f} {} {} {} {} {}", f.heading / (0.3 * f.normal), pressure,
                             count(Status::stick), count(Status::slip), s.friction.steps,
                             s.friction.restarts, s.friction.problems));
  EXPECT_NEAR(pressure, 495.3, 0.05);
  EXPECT_EQ(count(Status::stick), 45);
  EXPECT_EQ(count(Status::slip), 36);
  EXPECT_EQ(s.friction.steps, 8);
  EXPECT_NEAR(std::abs(f.heading) / (0.3 * f.normal), 0.5941, 5e-5);
}

/// From the states of constant friction as it is in full sliding, and in between, at once.
TEST(FallingFriction, OtherBeginningsEndInTheSameState) {
  const test::LineContact line;
  const statics::RollingProblem<2> problem = line.problem();
  const statics::RollingFriction law{test::falling_friction(), {line.element * line.length}};
  for (const double factor : {0.6, 0.7, 0.8, 0.9}) {
    statics::RollingDrive drive = line.drive(-1e-3, 0.3);
    drive.pairs.assign(problem.pairs.size(), {.factor = factor});
    statics::RollingState s = line.solved(problem, drive);
    s.pairs = drive.pairs;
    drive.law = &law;
    solve_rolling(problem, drive, s);
    const statics::RollingForces f = forces_of(problem, s.point);
    EXPECT_EQ(s.friction.steps, 0);
    EXPECT_NEAR(std::abs(f.heading) / (0.3 * f.normal), 0.5941, 5e-5) << factor;
  }
}

}  // namespace v44_falling_friction
