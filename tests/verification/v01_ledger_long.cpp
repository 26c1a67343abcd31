// SPDX-License-Identifier: BSD-3-Clause
/// V1 over a million steps: spinning, rolling, friction, damping. Bound 1e-12 of the exchanged
/// energy.
#include <gtest/gtest.h>

#include "support/models.hpp"

using namespace rondo;
using namespace rondo::dynamics;

TEST(LedgerLong, RollingWithFrictionAndDampingOverAMillionSteps) {
  auto c = test::rolling_disk(3, 40);
  c.motion.height = Table(0.296);
  auto b = test::build(c);
  test::add_ground(b, {}, {0.3, 0.0});
  State state = test::start_at_rest(b.model);
  Ledger ledger(b.model);
  long contacts = 0;
  for (int n = 0; n < 1000000; ++n) contacts += advance(b.model, state, ledger).nodes;
  EXPECT_GT(contacts, 1000000);
  EXPECT_GT(ledger.last().works.dissipation_friction, 0.0);
  EXPECT_LT(ledger.last().relative, 1e-12);
}

TEST(LedgerLong, FreeSpinWithoutDampingOverAMillionSteps) {
  auto c = test::rubber_annulus(3, 24);
  auto b = test::build(c);
  State state = test::start_at_rest(b.model);
  Ledger ledger(b.model);
  for (int n = 0; n < 1000000; ++n) static_cast<void>(advance(b.model, state, ledger));
  EXPECT_LT(ledger.last().relative, 1e-12);
}
