// SPDX-License-Identifier: BSD-3-Clause
/// What an integrator gives to the last bit: for any number of threads, however the steps are cut
/// into calls, stopped and gone on with. What it does with clamped nodes, and with numbers that are
/// none.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "integrator_cases.hpp"
#include "support/implicit.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace integrator_bits_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

void append(std::vector<double>& out, std::initializer_list<double> values) {
  out.insert(out.end(), values);
}
void append(std::vector<double>& out, std::span<const Vec2> field) {
  for (const Vec2 v : field) append(out, {v.x, v.y});
}

std::vector<double> numbers(const StepReport& s) {
  const FrameStep& f = s.frame;
  const ContactReport& c = s.contact;
  const Balance& b = s.balance;
  const Works& w = b.works;
  std::vector<double> out{static_cast<double>(s.step)};
  append(out, {f.time, f.spin, f.spin_rate, f.angle, f.turn, f.turn_before});
  append(out, {f.rotation.re, f.rotation.im});
  for (const Vec3 a : {f.center, f.advance, f.advance_before, f.pull, c.impulse})
    append(out, {a.x, a.y});
  for (const int count :
       {c.nodes, c.sticking, c.pairs, c.pairs_not_converged, c.clusters, c.clusters_not_converged,
        c.cluster_largest, c.cluster_iterations, c.extensions})
    out.push_back(static_cast<double>(count));
  append(out, {c.angular_impulse, c.length, c.penetration, c.free_velocity, c.residual});
  append(out, {c.work, c.dissipation_friction, c.loss_impact, c.work_rim});
  append(out, {w.frame, w.contact, w.dissipation_friction, w.loss_impact, w.rim});
  append(out, {w.dissipation_mass, w.dissipation_stiffness, w.scheme, w.load});
  append(out, {w.gravity, w.rim_load, w.torque, w.held, w.dissipation_brake});
  append(out, {w.dissipation_support, b.kinetic_rim, b.support, s.rim.spin, s.rim.torque});
  append(out, std::array{s.rim.velocity, s.rim.force});
  append(out, {b.kinetic, b.strain, b.residual, b.exchanged, b.otherwise, b.relative});
  return out;
}

std::vector<double> numbers(const State& s) {
  std::vector<double> out{static_cast<double>(s.step), s.frame.time};
  for (const Field* field : {&s.u, &s.v, &s.v_next}) append(out, field->plane());
  for (const ActiveContact& a : s.active) {
    append(out, {static_cast<double>(a.candidate), static_cast<double>(a.status), a.gap, a.bounce});
    for (const Vec3 x : {Vec3(a.normal), a.before, a.free, a.after, a.impulse})
      append(out, {x.x, x.y});
  }
  return out;
}

/// A run's numbers: of each step, and of the states that were asked for.
struct Record {
  std::vector<std::vector<double>> reports;
  std::map<long long, std::vector<double>> states;
  std::vector<double> fields;
};

struct Way {
  int threads = 1;
  std::size_t steps_a_call = 64;
  bool last_of_each_call = false;  ///< or of the last call only
  int threads_after_restart = 0;   ///< another integrator goes on after each call; 0: the same
};

Record run(const test::Built& b, StiffnessOperator of, std::size_t steps, Way way) {
  Model model = test::model_with(b, of);
  model.threads = way.threads;
  State state = start(model, test::some_displacement(b), test::some_velocity(b));
  Model other = model;
  other.threads = way.threads_after_restart;
  const std::vector<Vec2> rest(b.model.n_nodes());
  std::unique_ptr<Integrator> integrator = make_integrator(model, state);
  std::vector<StepReport> reports(steps);
  Record out;
  for (std::size_t done = 0; done < steps;) {
    const std::size_t n = std::min(way.steps_a_call, steps - done);
    done += n;
    const bool seen = way.last_of_each_call || done == steps;
    integrator->advance(std::span(reports).subspan(done - n, n), seen ? &state : nullptr);
    if (seen) out.states[state.step] = numbers(state);
    if (way.threads_after_restart == 0) continue;
    const SavedState saved = integrator->resumable()->save();
    integrator = make_integrator(other, start(other, rest, rest));
    integrator->resumable()->restore(saved);
  }
  int contacts = 0;
  for (const StepReport& report : reports) {
    out.reports.push_back(numbers(report));
    contacts += report.contact.nodes;
  }
  EXPECT_GT(contacts, 0);
  State fields(model);
  integrator->fields(fields);
  append(out.fields, fields.u);
  append(out.fields, fields.v_next);
  EXPECT_EQ(fields.v_next, state.v_next);
  return out;
}

testing::AssertionResult same(const std::vector<double>& a, const std::vector<double>& b) {
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (x == a.end() && y == b.end()) return testing::AssertionSuccess();
  if (x == a.end() || y == b.end()) return testing::AssertionFailure() << "not as many numbers";
  return testing::AssertionFailure()
         << "number " << x - a.begin() << ": " << *x << " and " << *y << " differ by " << *x - *y;
}

void assert_same_bits(const Record& a, const Record& b) {
  ASSERT_EQ(a.reports.size(), b.reports.size());
  for (std::size_t n = 0; n < a.reports.size(); ++n)
    ASSERT_TRUE(same(a.reports[n], b.reports[n])) << "report of step " << n + 1;
  int compared = 0;
  for (const auto& [step, state] : a.states) {
    if (!b.states.contains(step)) continue;
    ASSERT_TRUE(same(state, b.states.at(step))) << "state of step " << step;
    ++compared;
  }
  EXPECT_GT(compared, 0);
  ASSERT_TRUE(same(a.fields, b.fields));
}

/// With layers of it implicit, all of the same material.
test::Built implicit(const test::RollingCase& c, const std::vector<int>& layers) {
  test::Built b = test::build(c);
  const std::vector<char> cells = test::cells_of_layers(b.mesh, layers);
  b.model.implicit = test::implicit_part(b.mesh, b.materials, cells);
  return b;
}

/// Down to the fewest sectors there can be; on a sharp ledge; with implicit layers inside, and at
/// the ground.
std::vector<test::Built> disks() {
  test::RollingCase ledge = test::sharp(test::everything("", 4, 61));
  ledge.disk.motion.start_x = -0.02;
  std::vector<test::Built> all = {
      test::build(test::everything("", 4, 61)),
      test::build(test::everything("", 3, mesh::Tread{20, 0.02, 3, 1, 2})),
      test::build(test::everything("", 3, mesh::Tread{3, 0.02, 20, 10, 2})),
      test::build(ledge),
      test::build(test::on_rim(test::everything("", 4, 61), true, true, true)),
      test::build(test::on_rim(ledge, false, true, true)),
      test::build(
          test::on_rim(test::everything("", 3, mesh::Tread{20, 0.02, 3, 1, 2}), false, true, true)),
      test::build(test::rubbing(test::everything("", 4, 61))),
      test::build(test::on_rim(test::rubbing(test::everything("", 4, 61)), true, true, true)),
      implicit(test::everything("", 4, 61), {2}),
      implicit(test::everything("", 4, 61), {4})};
  for (const test::RollingCase& c : test::massless_cases()) all.push_back(test::build(c));
  return all;
}

class Integrators : public testing::TestWithParam<StiffnessOperator> {};

}  // namespace

/// Few steps: where others work on the machine too, threads that wait for each other take long.
TEST_P(Integrators, SameBitsForAnyNumberOfThreadsAndFromRunToRun) {
  std::vector<test::Built> all = disks();
  all.push_back(test::build(test::everything("", 6, 240)));  // work for every thread
  all.push_back(test::build(test::rubbing(test::everything("", 6, 240))));
  for (test::Built& b : all)
    if (!b.model.rim && !has_massless_contact(b.model)) test::add_pressures(b);
  for (const test::Built& b : all) {
    const Record one = run(b, GetParam(), 100, {});
    for (const Way way : {Way{1, 64}, Way{2, 7}, Way{3, 64}, Way{7, 64}}) {
      SCOPED_TRACE(way.threads);
      ASSERT_NO_FATAL_FAILURE(assert_same_bits(one, run(b, GetParam(), 100, way)));
    }
  }
}

TEST_P(Integrators, SameBitsHoweverTheStepsAreCutIntoCalls) {
  for (const test::Built& b : disks()) {
    const Record one = run(b, GetParam(), 1000, {.steps_a_call = 1, .last_of_each_call = true});
    EXPECT_EQ(one.states.size(), 1000);
    for (const Way way : {Way{1, 1, false}, Way{1, 7, true}, Way{1, 7, false}, Way{1, 64, true},
                          Way{1, 64, false}, Way{1, 1000, false}}) {
      SCOPED_TRACE(way.steps_a_call);
      ASSERT_NO_FATAL_FAILURE(assert_same_bits(one, run(b, GetParam(), 1000, way)));
    }
  }
}

/// What a row of the history takes: displacements of the candidates, contacts, nothing else.
TEST_P(Integrators, AStateWithoutVelocitiesHasTheBitsOfTheWholeOneAtTheCandidates) {
  for (const test::Built& b : disks()) {
    const Model model = test::model_with(b, GetParam());
    State whole = start(model, test::some_displacement(b), test::some_velocity(b));
    const auto one = make_integrator(model, whole), other = make_integrator(model, whole);
    State boundary = boundary_state(model);
    std::vector<StepReport> reports(17), of_other(17);
    int contacts = 0;
    for (int call = 0; call < 20; ++call) {
      one->advance(reports, &whole);
      other->advance(of_other, &boundary);
      ASSERT_TRUE(same(numbers(reports.back()), numbers(of_other.back())));
      for (const int node : model.contact->nodes) {
        const auto n = static_cast<std::size_t>(node);
        ASSERT_EQ(boundary.u.plane()[n], whole.u.plane()[n]) << "node " << node;
      }
      State expected = whole;
      expected.u = expected.v = expected.v_next = Field();
      State found = boundary;
      found.u = Field();
      ASSERT_TRUE(same(numbers(expected), numbers(found)));
      contacts += static_cast<int>(whole.active.size());
    }
    EXPECT_GT(contacts, 0);
    EXPECT_TRUE(boundary.v.empty());
  }
}

TEST_P(Integrators, SameBitsFromASavedStateAndOtherThreads) {
  std::vector<test::Built> all = disks();
  test::RollingCase undamped = test::everything("", 4, 61);
  undamped.disk.beta = 0.0;
  all.push_back(test::build(undamped));
  test::add_pressures(all.back());
  all.push_back(test::build(test::everything("", 6, 240)));
  for (const test::Built& b : all) {
    const Record one = run(b, GetParam(), 100, {});
    for (const Way way : {Way{1, 33, false, 1}, Way{1, 7, true, 3}, Way{3, 50, false, 1}}) {
      SCOPED_TRACE(way.steps_a_call);
      ASSERT_NO_FATAL_FAILURE(assert_same_bits(one, run(b, GetParam(), 100, way)));
    }
  }
}

TEST_P(Integrators, ClampedNodesStayClamped) {
  auto b = test::build(test::everything("", 3, 30));
  const std::vector<Vec2> u0(b.model.n_nodes(), Vec2{1e-5, 1e-5}),
      v0(b.model.n_nodes(), Vec2{1.0, 1.0});
  test::Stepping run(b, GetParam(), u0, v0);
  run.advance(500);
  State fields = run.state();
  run.integrator().fields(fields);
  for (const int node : b.mesh.clamped) {
    const auto k = static_cast<std::size_t>(node);
    EXPECT_EQ(run.state().u.plane()[k], Vec2{});
    EXPECT_EQ(run.state().v.plane()[k], Vec2{});
    EXPECT_EQ(run.state().v_next.plane()[k], Vec2{});
    EXPECT_EQ(fields.u.plane()[k], Vec2{});
    EXPECT_EQ(fields.v_next.plane()[k], Vec2{});
  }
}

/// A run stops by the balance: it must not stay finite where a field is not, in no component, at
/// no node, with and without contact.
TEST_P(Integrators, NumbersThatAreNoneReachTheBalance) {
  const test::NoStepTraps no_traps;
  const auto none = {std::numeric_limits<double>::quiet_NaN(),
                     std::numeric_limits<double>::infinity()};
  for (const bool contact : {true, false}) {
    test::RollingCase c = test::everything("", 3, 21);
    if (!contact) c.ground.reset();
    const test::Built b = test::build(c);
    const Model model = test::model_with(b, GetParam());
    for (const int node : model.free)
      for (const auto field : {&State::u, &State::v_next})
        for (const auto component : {&Vec2::x, &Vec2::y})
          for (const double value : none) {
            State state = test::start_at_rest(model);
            (state.*field).plane()[static_cast<std::size_t>(node)].*component = value;
            const auto integrator = make_integrator(model, state);
            std::array<StepReport, 3> reports;
            integrator->advance(reports);
            for (const StepReport& report : reports)
              ASSERT_FALSE(std::isfinite(report.balance.kinetic + report.balance.strain)) << node;
            integrator->fields(state);
            const Vec2 u = state.u.plane()[static_cast<std::size_t>(node)];
            ASSERT_FALSE(std::isfinite(u.x + u.y)) << node;
          }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Integrators, testing::ValuesIn(test::both_operators),
                         [](const auto& p) { return test::name(p.param); });

}  // namespace integrator_bits_test
