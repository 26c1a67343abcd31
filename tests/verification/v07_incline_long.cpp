// SPDX-License-Identifier: BSD-3-Clause
/// V7, long times: a block that sticks does not creep in a million steps.
#include <gtest/gtest.h>

#include <cmath>

#include "support/incline.hpp"
#include "support/traps.hpp"

namespace v07_incline_long {

using namespace rondo;

TEST(InclineLong, ABlockThatSticksDoesNotCreep) {
  for (const double angle : {15.0, 30.0}) {
    test::Incline incline{.angle = angle};
    incline.friction = 1.5 * std::tan(incline.radians());
    const test::FloatingPointTraps traps;
    const test::Stuck stuck = test::stick(incline, 1000000);
    EXPECT_EQ(stuck.sticking, 9) << angle;
    EXPECT_EQ(stuck.before, stuck.after) << angle;  // to the last bit
  }
}

}  // namespace v07_incline_long
