// SPDX-License-Identifier: BSD-3-Clause
/// The speed of a wheel after a step of the slip ratio.
#include "rondo/analysis/steady/step_speed.hpp"

#include <gtest/gtest.h>

#include "rondo/model/motion.hpp"

namespace step_speed_test {

using namespace rondo;

/// The slip ratio at the speed is the one that was asked for, forwards and backwards.
TEST(StepSpeed, HasItsSlipRatio) {
  for (const double rim : {10.0, -10.0})
    for (const double ratio : {-0.9, -0.1, -0.003, 0.0, 0.003, 0.1, 0.9}) {
      const double speed = study::speed_of_slip(ratio, rim);
      EXPECT_NEAR(dynamics::slip_ratio(rim, speed), ratio, 1e-15) << rim;
      EXPECT_GT(speed * rim, 0.0);
    }
}

}  // namespace step_speed_test
