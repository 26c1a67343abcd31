// SPDX-License-Identifier: BSD-3-Clause
/// V16 by steady rolling: every traction from braking to driving against Carter.
#include "support/steady_carter.hpp"

namespace v16_carter_steady {

using namespace rondo;
using statics::SlipDifference;

/// 62 elements to the half width. What is left is the disk's: curvature and wall
/// (docs/validation.md).
TEST(SteadyCarter, CreepAndStickZone) {
  test::SteadyCarter disk(96, 7200, SlipDifference::upwind, test::finest_bounds);
  test::expect_carter(disk, 0.02, 0.02);
}

TEST(SteadyCarter, FullSlidingHasAllOfTheFriction) {
  test::SteadyCarter disk(16, 900, SlipDifference::bdf2);
  for (const double creep : {-0.06, 0.06}) {
    const test::CarterMeans m = disk.means(disk.at_creep(creep));
    EXPECT_NEAR(m.share(), std::copysign(1.0, creep), 1e-13);
    EXPECT_LT(m.largest, 1.0 + 1e-13);
  }
}

/// Traction at the creep of Q = 0.64 μP. An open program of half spaces (CONTACT) has 0.648 with 50
/// cells; here braking and driving have it between them.
TEST(SteadyCarter, TractionOfACreep) {
  test::SteadyCarter disk(48, 3600, SlipDifference::upwind);
  const double scale = disk.means(disk.at(0.64)).scale();
  const double drives = disk.means(disk.at_creep(0.4 * scale)).share();
  const double brakes = -disk.means(disk.at_creep(-0.4 * scale)).share();
  EXPECT_NEAR(drives, 0.64, 0.01);
  EXPECT_NEAR(brakes, 0.64, 0.01);
  testing::Test::RecordProperty("shares", fmt::format("{:.4f} {:.4f}", drives, brakes));
}

}  // namespace v16_carter_steady
