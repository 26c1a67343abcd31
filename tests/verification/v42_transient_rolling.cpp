// SPDX-License-Identifier: BSD-3-Clause
/// Two spheres that begin to roll under a held force, against CONTACT (docs/validation.md, V42).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/start_of_rolling.hpp"

namespace v42_transient_rolling {

using namespace rondo;

TEST(TransientRolling, TwoSpheresCreepAsInContactUntilTheyRollSteadily) {
  const test::StartOfRolling found = test::start_of_rolling(15);
  RecordProperty("shift, pressure, steady",
                 fmt::format("{:.5f} {:.5f} {:.4f}", found.shift, found.pressure, found.steady));
  for (const test::CreepOfContact& c : test::creeps_of_contact)
    if (c.step <= found.creep.size())
      RecordProperty(fmt::format("{}", c.step), fmt::format("{:.4f}", found.creep[c.step - 1]));
  test::expect_creeps_of_contact(found);
}

}  // namespace v42_transient_rolling
