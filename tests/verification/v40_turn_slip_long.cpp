// SPDX-License-Identifier: BSD-3-Clause
/// CONTACT's lateral creep and spin on finer elements (docs/validation.md, V40).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/turn_slip.hpp"

namespace v40_turn_slip_long {

using namespace rondo;
using statics::SlipDifference;

/// As many elements as CONTACT has.
TEST(TurnSlipLong, TwoHalfSpacesBearWhatContactHas) {
  const test::SpinForces found = test::spin_of_half_spaces(40);
  RecordProperty("40", fmt::format("{:.4f} {:.4f}", found.lateral, found.moment));
  EXPECT_NEAR(found.lateral, test::of_contact.lateral, 0.01 * 0.6074);
  EXPECT_NEAR(found.moment, test::of_contact.moment, 0.04 * 0.3464);
  EXPECT_NEAR(found.pressure, test::of_contact.pressure, 0.001 * 1223.0);
}

TEST(TurnSlipLong, AWheelCreepsAsKalkersLinearTheory) {
  const double c23 = test::at_poisson(0.45, 1.33, 1.47, 1.63);
  for (const SlipDifference slip : {SlipDifference::upwind, SlipDifference::bdf2}) {
    const test::SpinCreep found = test::creep_of_wheel(720, slip);
    RecordProperty(slip == SlipDifference::bdf2 ? "bdf2" : "upwind",
                   fmt::format("{:.3f} {:.3f}", found.c23, found.moment));
    EXPECT_NEAR(found.c23, c23, 0.06 * c23);
    EXPECT_NEAR(found.c23, found.moment, 0.02 * c23);
  }
}

/// Of the wheel, by 30 columns over the ellipse: the rim, the curvature of the tread and a
/// Poisson's ratio of 0.45 on rigid ground are in it.
TEST(TurnSlipLong, AWheelBearsNearlyWhatContactHas) {
  for (const int around : {720, 1080}) {
    const test::SpinForces found = test::spin_of_wheel(32, around, SlipDifference::bdf2);
    RecordProperty(fmt::format("wheel {}", around),
                   fmt::format("{:.4f} {:.4f}", found.lateral, found.moment));
    EXPECT_NEAR(found.lateral, test::of_contact.lateral, around == 720 ? 0.035 : 0.03) << around;
    EXPECT_NEAR(found.moment, test::of_contact.moment, 0.08) << around;
  }
}

}  // namespace v40_turn_slip_long
