// SPDX-License-Identifier: BSD-3-Clause
/// V1: the energy balance closes to round-off at every step, in contact, with friction, damping,
/// spin tables and restitution, for both schemes and both operators.
#include <gtest/gtest.h>

#include <tuple>

#include "rondo/integrators/general/general_integrator.hpp"
#include "support/models.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace v01_ledger {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct Variant {
  const char* name;
  Scheme scheme;
  double friction, restitution;
  bool tables;
};

class Ledgers : public testing::TestWithParam<std::tuple<Variant, StiffnessOperator>> {};
class LedgersAgain : public testing::TestWithParam<StiffnessOperator> {};

}  // namespace

TEST_P(Ledgers, CloseToRoundOff) {
  const auto& [v, of] = GetParam();
  auto c = test::rolling_disk(4, 60);
  c.scheme = v.scheme;
  if (v.tables) {
    c.motion.angular_velocity = Table({{0.0, 20.0}, {0.05, 60.0}, {0.1, 10.0}});
    c.motion.speed = Table({{0.0, 12.0}, {0.1, 5.0}});
    c.motion.height = Table({{0.0, 0.295}, {0.03, 0.28}, {0.06, 0.31}});
    c.motion.gravity = Table(9.81);
  }
  auto b = test::build(c);
  test::add_ground(b, test::ledge(), {v.friction, v.restitution});
  test::Stepping run(b, of);
  const test::FloatingPointTraps traps;
  long contacts = 0;
  double split = 0.0;
  run.advance(4000, [&](const StepReport& step) {
    contacts += step.contact.nodes;
    const Works& w = step.balance.works;
    split = std::max(split, std::abs(w.contact - (w.rim - w.dissipation_friction - w.loss_impact)));
  });
  const Balance& last = run.balance();
  EXPECT_GT(contacts, 500);
  EXPECT_GT(last.exchanged, 10.0);
  // 4,000 steps of some 20 roundings each, random in sign: √(8e4) × 1e-16 = 3e-14 at worst.
  EXPECT_LT(last.relative, 3e-14);
  EXPECT_LT(split, 1e-12 * last.exchanged);
  // Each part has its sign or its place.
  EXPECT_GE(last.works.dissipation_friction, -1e-9 * last.exchanged);
  EXPECT_GT(last.works.dissipation_mass, 0.0);
  EXPECT_GT(last.works.dissipation_stiffness, 0.0);
  EXPECT_EQ(last.works.scheme == 0.0, v.scheme == Scheme::symplectic);
  if (v.friction > 0.0) {
    EXPECT_GT(last.works.dissipation_friction, 1.0);
  }
  if (v.restitution == 0.0) {
    EXPECT_GT(last.works.loss_impact, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Ledgers,
    testing::Combine(testing::Values(Variant{"plain", Scheme::symplectic, 0.0, 0.0, false},
                                     Variant{"friction", Scheme::symplectic, 0.6, 0.0, false},
                                     Variant{"tables", Scheme::symplectic, 0.3, 0.0, true},
                                     Variant{"restitution", Scheme::symplectic, 0.3, 0.5, true}),
                     testing::ValuesIn(test::both_operators)),
    [](const auto& p) { return test::name(std::get<0>(p.param).name, std::get<1>(p.param)); });
INSTANTIATE_TEST_SUITE_P(
    General, Ledgers,
    testing::Combine(testing::Values(Variant{"as_printed", Scheme::as_printed, 0.3, 0.0, true}),
                     testing::Values(StiffnessOperator::sparse)),
    [](const auto& p) { return test::name(std::get<0>(p.param).name, std::get<1>(p.param)); });

/// What it opens by does not grow with the steps (v01_ledger_long.cpp has a million and ten).
TEST_P(LedgersAgain, CloseAfterAHundredThousandSteps) {
  auto c = test::rolling_disk(3, 40);
  c.motion.height = Table(0.296);
  auto b = test::build(c);
  test::add_ground(b, {}, {0.3, 0.0});
  test::Stepping run(b, GetParam());
  const test::FloatingPointTraps traps;
  run.advance(100000);
  EXPECT_GT(run.balance().works.dissipation_friction, 0.0);
  EXPECT_LT(run.balance().relative, 1e-13);  // of the million: 1e-12
}

INSTANTIATE_TEST_SUITE_P(Both, LedgersAgain, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

/// The ledger is no tautology: a velocity changed behind its back opens it.
TEST(LedgerCheck, SeesAVelocityChangedBehindItsBack) {
  auto b = test::build(test::rolling_disk(4, 60));
  GeneralIntegrator run(b.model, test::start_at_rest(b.model));
  std::vector<StepReport> reports(200);
  run.advance(reports);
  EXPECT_LT(reports.back().balance.relative, 1e-14);
  SavedState state = run.save();
  state.v.plane()[41] += Vec2{1e-5, 0.0};
  run.restore(state);
  run.advance(std::span(reports).first(2));
  EXPECT_GT(reports[1].balance.relative, 1e-9);
}

}  // namespace v01_ledger
