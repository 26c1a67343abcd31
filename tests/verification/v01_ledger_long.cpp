// SPDX-License-Identifier: BSD-3-Clause
/// V1 over a million steps, by both operators: spinning, rolling, friction, damping. Bound 1e-12 of
/// the exchanged energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/models.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace v01_ledger_long {

using namespace rondo;
using namespace rondo::dynamics;

namespace {
class LedgerLong : public testing::TestWithParam<StiffnessOperator> {};
}  // namespace

TEST_P(LedgerLong, RollingWithFrictionAndDampingOverAMillionSteps) {
  auto c = test::rolling_disk(3, 40);
  c.motion.height = Table(0.296);
  auto b = test::build(c);
  test::add_ground(b, {}, {0.3, 0.0});
  test::Stepping run(b, GetParam());
  const test::FloatingPointTraps traps;
  long contacts = 0;
  run.advance(1000000, [&](const StepReport& step) { contacts += step.contact.nodes; });
  EXPECT_GT(contacts, 1000000);
  EXPECT_GT(run.balance().works.dissipation_friction, 0.0);
  RecordProperty("relative", fmt::format("{:.2g}", run.balance().relative));
  EXPECT_LT(run.balance().relative, 1e-12);
}

/// Ten million steps, on a mesh small enough for it: bound 1e-11.
TEST_P(LedgerLong, TenMillionSteps) {
  const auto b = test::build(test::rubber_annulus(1, 8));
  test::Stepping run(b, GetParam());
  const test::FloatingPointTraps traps;
  run.advance(10000000);
  RecordProperty("relative", fmt::format("{:.2g}", run.balance().relative));
  EXPECT_LT(run.balance().relative, 1e-11);
}

TEST_P(LedgerLong, FreeSpinWithoutDampingOverAMillionSteps) {
  const auto b = test::build(test::rubber_annulus(3, 24));
  test::Stepping run(b, GetParam());
  const test::FloatingPointTraps traps;
  run.advance(1000000);
  RecordProperty("relative", fmt::format("{:.2g}", run.balance().relative));
  EXPECT_LT(run.balance().relative, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Both, LedgerLong, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace v01_ledger_long
