// SPDX-License-Identifier: BSD-3-Clause
/// V14 on a mesh with 20 elements to the half width.
#include "support/hertz.hpp"

namespace v14_hertz_long {

using namespace rondo;

TEST(HertzLong, HalfWidthAndPressure) {
  const auto finest = test::deviation_from_hertz(0.05, 80, 3200);
  EXPECT_LT(std::abs(finest.half_width), 2e-3);  // (a/R)² = 0.15 % of it
  EXPECT_LT(std::abs(finest.pressure), 1.5e-3);
  EXPECT_LT(finest.misfit, 3e-3);  // 4.9e-3 at half as many
}

TEST(HertzLong, NearlyIncompressibleByBBar) {
  const auto finest = test::deviation_from_hertz(0.05, 80, 3200, test::nearly_incompressible);
  EXPECT_LT(std::abs(finest.half_width), 4e-3);
  EXPECT_LT(std::abs(finest.pressure), 1.5e-3);
  EXPECT_LT(finest.misfit, 2e-3);  // 5.4e-3 at half as many
}

}  // namespace v14_hertz_long
