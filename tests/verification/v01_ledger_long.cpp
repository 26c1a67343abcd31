// SPDX-License-Identifier: BSD-3-Clause
/// V1 over a million steps: spinning, rolling, friction, damping. Bound 1e-12 of the exchanged
/// energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/models.hpp"
#include "support/traps.hpp"

using namespace rondo;
using namespace rondo::dynamics;

TEST(LedgerLong, RollingWithFrictionAndDampingOverAMillionSteps) {
  auto c = test::rolling_disk(3, 40);
  c.motion.height = Table(0.296);
  auto b = test::build(c);
  test::add_ground(b, {}, {0.3, 0.0});
  State state = test::start_at_rest(b.model);
  Ledger ledger;
  const test::FloatingPointTraps traps;
  long contacts = 0;
  for (int n = 0; n < 1000000; ++n) contacts += advance(b.model, state, ledger).nodes;
  EXPECT_GT(contacts, 1000000);
  EXPECT_GT(ledger.last().works.dissipation_friction, 0.0);
  RecordProperty("relative", fmt::format("{:.2g}", ledger.last().relative));
  EXPECT_LT(ledger.last().relative, 1e-12);
}

/// Ten million steps, on a mesh small enough for it: bound 1e-11.
TEST(LedgerLong, TenMillionSteps) {
  auto b = test::build(test::rubber_annulus(1, 8));
  State state = test::start_at_rest(b.model);
  Ledger ledger;
  const test::FloatingPointTraps traps;
  for (int n = 0; n < 10000000; ++n) static_cast<void>(advance(b.model, state, ledger));
  RecordProperty("relative", fmt::format("{:.2g}", ledger.last().relative));
  EXPECT_LT(ledger.last().relative, 1e-11);
}

TEST(LedgerLong, FreeSpinWithoutDampingOverAMillionSteps) {
  auto c = test::rubber_annulus(3, 24);
  auto b = test::build(c);
  State state = test::start_at_rest(b.model);
  Ledger ledger;
  const test::FloatingPointTraps traps;
  for (int n = 0; n < 1000000; ++n) static_cast<void>(advance(b.model, state, ledger));
  RecordProperty("relative", fmt::format("{:.2g}", ledger.last().relative));
  EXPECT_LT(ledger.last().relative, 1e-12);
}
