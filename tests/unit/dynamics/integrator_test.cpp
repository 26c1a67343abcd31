// SPDX-License-Identifier: BSD-3-Clause
/// Both operators do the step of the reference, over 1,000 steps of rolling with every option.
#include "rondo/dynamics/integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "integrator_cases.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

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
  State state = start(b.model, test::some_displacement(b), test::some_velocity(b));
  Ledger ledger;
  for (int n = 1; n <= many; ++n) {
    StepReport& report = seen.reports.emplace_back();
    report.contact = advance(b.model, state, ledger);
    report.step = state.step;
    report.frame = state.frame;
    report.balance = ledger.last();
    if (n == few) seen.early = state;
  }
  seen.late = state;
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

/// The largest difference of quantities of a kind, and their largest size.
struct Difference {
  double error = 0.0, size = 0.0;

  void see(double a, double b) {
    size = std::max(size, std::abs(a));
    if (!(std::abs(a - b) <= error)) error = std::abs(a - b);  // NaN comes through
  }
  void see(Vec2 a, Vec2 b) {
    see(a.x, b.x);
    see(a.y, b.y);
  }
  void see(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) see(a[i], b[i]);
  }
};

/// Two runs: decisions are the same, quantities differ by round-off.
class Comparison {
 public:
  void see(const StepReport& a, const StepReport& b) {
    ASSERT_EQ(a.step, b.step);
    ASSERT_EQ(a.frame.time, b.frame.time);
    ASSERT_EQ(a.frame.rotation, b.frame.rotation);
    ASSERT_EQ(a.frame.center, b.frame.center);
    const ContactReport &c = a.contact, &d = b.contact;
    ASSERT_EQ(c.nodes, d.nodes) << "step " << a.step;
    ASSERT_EQ(c.sticking, d.sticking) << "step " << a.step;
    ASSERT_EQ(c.pairs, d.pairs) << "step " << a.step;
    ASSERT_EQ(c.pairs_not_converged, d.pairs_not_converged) << "step " << a.step;
    impulse_.see(c.impulse, d.impulse);
    impulse_.see(c.angular_impulse / radius, d.angular_impulse / radius);
    length_.see(c.length, d.length);
    gap_.see(c.penetration, d.penetration);
    slip_.see(c.free_velocity, d.free_velocity);
    work_.see(c.work, d.work);
    work_.see(c.dissipation_friction, d.dissipation_friction);
    work_.see(c.loss_impact, d.loss_impact);
    work_.see(c.work_rim, d.work_rim);
    see(a.balance, b.balance);
  }
  void see(const State& a, const State& b) {
    ASSERT_EQ(a.step, b.step);
    ASSERT_EQ(a.frame.angle, b.frame.angle);
    u_.see(a.u, b.u);
    v_.see(a.v, b.v);
    v_.see(a.v_next, b.v_next);
    ASSERT_EQ(a.active.size(), b.active.size());
    for (std::size_t i = 0; i < a.active.size(); ++i) see(a.active[i], b.active[i]);
  }
  void expect_within(double bound) const {
    for (const auto& [kind, d] : {std::pair{"displacement", u_},
                                  {"velocity", v_},
                                  {"impulse", impulse_},
                                  {"length in contact", length_},
                                  {"gap", gap_},
                                  {"normal", normal_},
                                  {"relative velocity", slip_},
                                  {"work of a step", work_},
                                  {"energy", energy_}})
      EXPECT_LE(d.error, bound * d.size) << kind;
  }

 private:
  static constexpr double radius = 0.3;  // of the disk [m]

  void see(const Balance& a, const Balance& b) {
    const Works &w = a.works, &x = b.works;
    for (const auto& [of_a, of_b] : {std::pair{a.kinetic, b.kinetic},
                                     {a.strain, b.strain},
                                     {w.frame, x.frame},
                                     {w.contact, x.contact},
                                     {w.dissipation_friction, x.dissipation_friction},
                                     {w.loss_impact, x.loss_impact},
                                     {w.rim, x.rim},
                                     {w.dissipation_mass, x.dissipation_mass},
                                     {w.dissipation_stiffness, x.dissipation_stiffness},
                                     {w.scheme, x.scheme},
                                     {a.exchanged, b.exchanged},
                                     {a.otherwise, b.otherwise},
                                     {a.residual, b.residual}})
      energy_.see(of_a, of_b);
  }
  void see(const ActiveContact& a, const ActiveContact& b) {
    ASSERT_EQ(a.candidate, b.candidate);
    ASSERT_EQ(a.status, b.status);
    normal_.see(a.normal, b.normal);
    gap_.see(a.gap, b.gap);
    slip_.see(a.before, b.before);
    slip_.see(a.free, b.free);
    slip_.see(a.after, b.after);
    slip_.see(a.bounce, b.bounce);
    impulse_.see(a.impulse, b.impulse);
  }

  Difference u_, v_, impulse_, length_, normal_, slip_, work_, energy_;
  Difference gap_{0.0, radius};  // a difference of positions of that size
};

/// After few steps the sums of a row in another order, 1e-16 each, are all: some 1e-14. Later the
/// largest part is the stiffness itself: the rounding of one element stands in all sectors of the
/// cyclic one, and slow waves see what is left when its terms cancel, by (N/2π)²: some 1e-13 of
/// their frequency squared, so 1e-11 of their phase. Impacts and slip make that ten times as large.
/// What is decided (touch, stick, slip) must not differ: nothing is that near to its edge.
void expect_agreement(const Seen& a, const Seen& b) {
  ASSERT_EQ(a.reports.size(), b.reports.size());
  Comparison early, all;
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
}

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
    expect_agreement(reference, found.back());
    EXPECT_LT(found.back().reports.back().balance.relative, 1e-12);
  }
  EXPECT_LT(reference.reports.back().balance.relative, 1e-12);
  SCOPED_TRACE("cyclic against sparse");
  expect_agreement(found[1], found[0]);
}

INSTANTIATE_TEST_SUITE_P(All, Operators, testing::ValuesIn(test::rolling_cases()),
                         [](const auto& p) { return p.param.name; });
