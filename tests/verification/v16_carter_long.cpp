// SPDX-License-Identifier: BSD-3-Clause
/// V16 with 8 elements to the half width, and up to tractions where little of the contact sticks.
#include "support/steady_carter.hpp"

namespace v16_carter_long {

using namespace rondo;

/// Near full sliding the zone comes out wide, because full sliding has 0.99 μP (the nodes swing a
/// little): of the 0.15 μP spared there up to 0.01 μP lie in the slip zone, about 0.5 a from the
/// zone's middle, and add up to 0.017 a² to a variance of c²/4 = 0.04 a², 0.08 a to c = 0.4 a.
TEST(CarterLong, CreepAndStickZone) {
  test::expect_carter({16, 900}, {-0.012, 0.008}, 0.015, 0.025);
  test::expect_carter({16, 900}, {-0.0184, 0.0138}, 0.025, 0.065);
}

/// 8 elements in equal layers: without the thin layers' waves the zone is right to 0.01 a up to
/// tractions of 0.86 μP. Its middle and the creep are further off in braking, by what is said in
/// V16 of curvature.
TEST(CarterLong, EqualLayers) {
  for (const double creep : {-0.0184, -0.012, 0.008, 0.0138}) {
    const test::CarterMeans m =
        test::roll({.radial = 32, .columns = 900, .creep = creep, .grading = 1.0});
    EXPECT_NEAR(m.stick / m.half_width(), test::carter_stick(m.share()), 0.01) << creep;
    EXPECT_NEAR(m.ahead / m.half_width(), 1.0 - test::carter_stick(m.share()), 0.045) << creep;
  }
}

/// 124 elements to the half width: by half of them no creep moves by more than 0.004.
TEST(SteadyCarterLong, CreepAndStickZone) {
  test::SteadyCarter disk(192, 14400, statics::SlipDifference::upwind, test::finest_bounds);
  test::expect_carter(disk, 0.015, 0.017);
}

}  // namespace v16_carter_long
