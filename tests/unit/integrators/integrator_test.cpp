// SPDX-License-Identifier: BSD-3-Clause
/// Both operators do the step of the reference, over 1,000 steps of rolling with every option.
#include "rondo/integrators/integrator.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace integrator_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr int few = 10, many = 1000;  // steps

/// What is seen of a run: every step; the fields after few and after many of them.
struct Seen {
  std::vector<StepReport> reports;
  State early, late;
};

Seen by_reference(const test::Built& b) {
  Seen seen;
  test::Reference run(b.model, start(b.model, test::some_displacement(b), test::some_velocity(b)));
  for (int n = 1; n <= many; ++n) {
    seen.reports.push_back(run.step());
    if (n == few) seen.early = run.state;
  }
  seen.late = run.state;
  return seen;
}

Seen by_operator(const test::Built& b, StiffnessOperator of) {
  Seen seen;
  test::Stepping run(b, of, test::some_displacement(b), test::some_velocity(b));
  const auto look = [&](const StepReport& report) { seen.reports.push_back(report); };
  run.advance(few, look);
  seen.early = run.state();
  run.advance(many - few, look);
  seen.late = run.state();
  return seen;
}

/// After few steps the sums of a row in another order, 1e-16 each, are all: some 1e-14. Later the
/// largest part is the stiffness itself: the rounding of one element stands in all sectors of the
/// cyclic one, and slow waves see what is left when its terms cancel, by (N/2π)²: some 1e-13 of
/// their frequency squared, so 1e-11 of their phase. Impacts and slip make that ten times as large.
/// What is decided (touch, stick, slip) must not differ: nothing is that near to its edge.
void expect_agreement(const Seen& a, const Seen& b, bool moves_by_itself) {
  ASSERT_EQ(a.reports.size(), b.reports.size());
  test::Comparison early, all;
  for (std::size_t n = 0; n < a.reports.size(); ++n) {
    if (n < few) early.see(a.reports[n], b.reports[n]);
    all.see(a.reports[n], b.reports[n]);
    if (testing::Test::HasFatalFailure()) return;
  }
  early.see(a.early, b.early);
  all.see(a.early, b.early);  // what has died down by the end is measured by what it was
  all.see(a.late, b.late);
  early.expect_within(1e-13);
  all.expect_within(1e-10);
  if (!moves_by_itself) all.expect_the_same_frames();
}

/// Ten steps in which every node of the contact is solved with all others leave a little more.
void expect_massless_agreement(const Seen& a, const Seen& b) {
  ASSERT_EQ(a.reports.size(), b.reports.size());
  test::Comparison all;
  for (std::size_t n = 0; n < a.reports.size(); ++n) {
    all.see(a.reports[n], b.reports[n]);
    if (testing::Test::HasFatalFailure()) return;
  }
  all.see(a.early, b.early);
  all.see(a.late, b.late);
  all.expect_within(1e-10);
}

class Massless : public testing::TestWithParam<test::RollingCase> {};
class Operators : public testing::TestWithParam<test::RollingCase> {};

}  // namespace

TEST_P(Operators, DoTheStepOfTheReference) {
  const test::RollingCase& c = GetParam();
  const test::Built b = test::build(c);
  const test::FloatingPointTraps traps;
  const Seen reference = by_reference(b);
  int in_contact = 0;
  for (const StepReport& report : reference.reports) in_contact += report.contact.nodes > 0 ? 1 : 0;
  EXPECT_EQ(in_contact > many / 2, c.ground.has_value());
  std::vector<Seen> found;
  for (const StiffnessOperator of : test::both_operators) {
    SCOPED_TRACE(test::name(of));
    found.push_back(by_operator(b, of));
    expect_agreement(reference, found.back(), c.rim.has_value());
    EXPECT_LT(found.back().reports.back().balance.relative, 1e-12);
  }
  EXPECT_LT(reference.reports.back().balance.relative, 1e-12);
  SCOPED_TRACE("cyclic against sparse");
  expect_agreement(found[1], found[0], c.rim.has_value());
}

TEST_P(Massless, BothOperatorsDoTheStepOfTheReference) {
  const test::Built b = test::build(GetParam());
  const test::FloatingPointTraps traps;
  const Seen reference = by_reference(b);
  int pressed = 0;
  for (const StepReport& report : reference.reports) {
    pressed += report.contact.nodes > 0 ? 1 : 0;
    ASSERT_EQ(report.contact.clusters_not_converged, 0);
    ASSERT_LE(report.contact.penetration, 1e-14);
    ASSERT_FALSE(report.contact.two_facets);
  }
  EXPECT_GT(pressed, many / 2);
  EXPECT_LT(reference.reports.back().balance.relative, 1e-12);
  for (const StiffnessOperator of : test::both_operators) {
    SCOPED_TRACE(test::name(of));
    const Seen found = by_operator(b, of);
    expect_massless_agreement(reference, found);
    EXPECT_LT(found.reports.back().balance.relative, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Massless, testing::ValuesIn(test::massless_cases()),
                         [](const auto& p) { return p.param.name; });
INSTANTIATE_TEST_SUITE_P(All, Operators, testing::ValuesIn(test::rolling_cases()),
                         [](const auto& p) { return p.param.name; });
INSTANTIATE_TEST_SUITE_P(OnRim, Operators, testing::ValuesIn(test::wheel_cases()),
                         [](const auto& p) { return p.param.name; });

}  // namespace integrator_test
