// SPDX-License-Identifier: BSD-3-Clause
/// Friction that is no constant, in the readable step: also on a loaded rim, with implicit elements
/// and with contact nodes without mass; wheels in three dimensions: solid_step_test.cpp. The fast
/// steps are held against it with tables of friction (integrator_test.cpp, bodies_test.cpp,
/// solid_fast_test.cpp). The laws are of this test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "rondo/contact/friction_table.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/implicit.hpp"

namespace friction_law_test {

using namespace rondo;
using namespace rondo::dynamics;
using contact::Friction;
using contact::SlidingState;

namespace {

constexpr double gravity = 9.81;

/// A particle of 2 kg/m that slides along flat ground at 3 m/s; it stands for 0.5 m of it.
Model sliding_particle(Friction friction, double dt) {
  Model m;
  m.reference = {{0.0, 0.0}};
  m.mass = {2.0};
  m.free = {0};
  m.stiffness.row_start = {0, 0};
  m.motion.gravity = Table(gravity);
  m.dt = dt;
  m.contact.emplace(ContactModel{
      contact::Ground(contact::GroundShape{}), {std::move(friction), 0.0}, {0}, {0.5}});
  return m;
}

/// Once the impact of the start is over, whose pressure is another.
struct Slide {
  test::Reference run;

  explicit Slide(const Model& model)
      : run(model, start(model, std::vector<Vec2>(1), std::vector<Vec2>{{3.0, 0.0}})) {
    for (int n = 0; n < 3; ++n) run.step();
  }
  [[nodiscard]] double velocity() const { return run.state.v_next.plane()[0].x; }
};

Friction falling() {
  return Friction([](const SlidingState& s) { return 0.5 - 0.1 * s.slip; });
}

/// v' = -g (0.5 - 0.1 v): v = 5 - (5 - v_0) exp(0.1 g t). @return the largest error     [m/s]
double largest_error(double dt) {
  const Model model = sliding_particle(falling(), dt);
  Slide slide(model);
  const double from = slide.velocity();
  double worst = 0.0;
  for (int n = 1; n * dt <= 0.4; ++n) {
    slide.run.step();
    const double exact = 5.0 - (5.0 - from) * std::exp(0.1 * gravity * n * dt);
    worst = std::max(worst, std::abs(slide.velocity() - exact));
  }
  EXPECT_GT(slide.velocity(), 1.0);  // it slides still
  EXPECT_LT(slide.velocity(), 2.2);
  return worst;
}

}  // namespace

/// v²/2g = ∫ μ dx, over what is left and behind the ice. The edges are met to a step: 3 m/s dt.
TEST(FrictionLaw, ANodeStopsBehindAPatchWhereItsEnergyEnds) {
  const double dt = 1e-6, dry = 0.5, ice = 0.1, from = 0.2, to = 0.5;
  const Model model = sliding_particle(
      contact::friction_of({.coefficient = dry,
                            .slip = {},
                            .patches = {{from, to, contact::Side::both, ice / dry}}}),
      dt);
  Slide slide(model);
  const double begins = slide.run.state.u.plane()[0].x;
  const double speed = slide.velocity() + 0.5 * dt * gravity * dry;  // half a step before
  while (slide.velocity() > 0.0 && slide.run.state.frame.time < 2.0) slide.run.step();
  const double energy = 0.5 * speed * speed / gravity;
  const double stops = to + (energy - dry * (from - begins) - ice * (to - from)) / dry;
  EXPECT_GT(stops, 1.1);
  EXPECT_NEAR(slide.run.state.u.plane()[0].x, stops, 3.0 * dt);
}

TEST(FrictionLaw, ANodeSlidesByTheClosedFormOfFallingFriction) {
  const double coarse = largest_error(1e-3), fine = largest_error(5e-4);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 2.0, 0.02);  // μ is that of the slip of the step before: first order
}

/// Step by step, to round-off, until it sticks.
TEST(FrictionLaw, TakesTheSlipOfTheStepBefore) {
  const double dt = 1e-3;
  const Model model = sliding_particle(falling(), dt);
  Slide slide(model);
  double v = slide.velocity(), exchanged = 0.0;
  for (int n = 0; n < 1200; ++n) {
    const StepReport& report = slide.run.step();
    v = std::max(v - dt * gravity * (0.5 - 0.1 * v), 0.0);
    ASSERT_NEAR(slide.velocity(), v, 1e-13) << n;
    EXPECT_LT(report.contact.residual, 1e-14);
    exchanged = report.balance.relative;
  }
  EXPECT_EQ(slide.velocity(), 0.0);
  EXPECT_LT(exchanged, 1e-13);
}

TEST(FrictionLaw, TakesThePressureOfTheStepBefore) {
  const double dt = 1e-3, pressure = 2.0 * gravity / 0.5;
  std::vector<double> seen;
  const Model model = sliding_particle(Friction([&](const SlidingState& s) {
                                         seen.push_back(s.pressure);
                                         return 0.1 + 2e-3 * s.pressure;
                                       }),
                                       dt);
  Slide slide(model);
  EXPECT_EQ(seen.front(), 0.0);  // it just touches
  const double from = slide.velocity();
  for (int n = 0; n < 100; ++n) slide.run.step();
  EXPECT_NEAR(seen.back(), pressure, 1e-12 * pressure);
  EXPECT_NEAR(slide.velocity(), from - 100 * dt * gravity * (0.1 + 2e-3 * pressure), 1e-12);
}

/// From μ = 0.4 to 0.1 at x = 0.5 m: v² = v_0² - 2 g Σ μ_i s_i.
TEST(FrictionLaw, TakesThePlaceOnTheGround) {
  const Model model = sliding_particle(
      Friction([](const SlidingState& s) { return s.place.x < 0.5 ? 0.4 : 0.1; }), 1e-4);
  Slide slide(model);
  const double from = slide.velocity(), begin = position(model, slide.run.state, 0).x;
  for (int n = 0; n < 4000; ++n) slide.run.step();
  const double end = position(model, slide.run.state, 0).x;
  ASSERT_GT(end, 0.9);
  const double squared = from * from - 2.0 * gravity * (0.4 * (0.5 - begin) + 0.1 * (end - 0.5));
  EXPECT_NEAR(slide.velocity(), std::sqrt(squared), 1e-3);  // two Δt g μ
}

namespace {

double some_law(const SlidingState& s) {
  return 0.2 + 0.1 * std::sin(40.0 * s.place.x) + 0.01 * s.slip + 2e-7 * s.pressure;
}

/// Every contact of a run has the μ that the law gives for what the step before has left.
int expect_the_law(const Model& model, State start, int steps) {
  test::Reference run(model, std::move(start));
  std::map<std::size_t, double> pressure;  // of candidates held by one facet
  int seen = 0;
  double residual = 0.0, fastest = 0.0;
  for (int n = 0; n < steps; ++n) {
    const ContactReport& report = run.step().contact;
    residual = std::max(residual, report.residual);
    fastest = std::max(fastest, report.free_velocity);
    std::map<std::size_t, std::vector<const ActiveContact*>> contacts;
    for (const ActiveContact& c : run.state.active) contacts[c.candidate].push_back(&c);
    std::map<std::size_t, double> next;
    for (const auto& [candidate, of] : contacts) {
      if (of.size() != 1) continue;
      const ActiveContact& c = *of[0];
      const auto node = static_cast<std::size_t>(model.contact->nodes[candidate]);
      next[candidate] = c.impulse.x / (model.dt * model.contact->tributary[candidate]);
      const auto before = pressure.find(candidate);
      if (before == pressure.end()) continue;
      const double expected =
          some_law({position(model, run.state, node), std::abs(c.before.y), before->second});
      EXPECT_NEAR(c.friction, expected, 1e-12) << n << " " << candidate;
      seen += before->second > 0.0 ? 1 : 0;
    }
    pressure = std::move(next);
  }
  EXPECT_LT(residual, 2e-12 * fastest);  // coupled contact is solved to 1e-12 of that
  EXPECT_LT(run.last.balance.relative, 1e-12);
  return seen;
}

/// A rolling disk on flat ground: no facet changes its number.
test::RollingCase rolling() {
  test::RollingCase c = test::everything("", 3, 60);
  c.ground = contact::GroundShape{};
  c.law = {Friction(some_law), 0.0};
  return c;
}

}  // namespace

TEST(FrictionLaw, IsAskedForEveryContactOfARollingDisk) {
  const test::Built b = test::build(rolling());
  EXPECT_EQ(step_of(b.model), StepKind::sparse);  // which integrator_test.cpp holds to this one
  EXPECT_GT(expect_the_law(b.model,
                           start(b.model, test::some_displacement(b), test::some_velocity(b)), 800),
            500);
}

TEST(FrictionLaw, IsAskedForEveryContactOfADiskOnALoadedRim) {
  const test::Built b = test::build(test::on_rim(rolling(), true, true, true));
  EXPECT_EQ(step_of(b.model), StepKind::sparse);
  EXPECT_GT(expect_the_law(b.model,
                           start(b.model, test::some_displacement(b), test::some_velocity(b)), 800),
            500);
}

TEST(FrictionLaw, IsAskedForEveryContactOfImplicitElements) {
  const test::RollingCase c = rolling();
  test::Built b = test::build(c);
  const std::vector<char> cells = test::cells_of_layers(b.mesh, {3});
  const double dt = b.model.dt;
  test::set_region(b, c.disk, cells, c.disk.material);
  b.model.implicit = test::implicit_part(b.mesh, b.materials, cells, b.prestress);
  b.model.dt = dt;
  EXPECT_EQ(step_of(b.model), StepKind::general);
  const std::vector<Vec2> rest(b.model.n_nodes());
  EXPECT_GT(expect_the_law(b.model, start(b.model, rest, rest), 800), 500);
}

/// The contacts at t_{n+1} were found in the step before, so that the law was asked for what was at
/// t_n: |r_t| = μ r_n of that where a node slides.
TEST(FrictionLaw, IsAskedForEveryContactOfNodesWithoutMass) {
  test::RollingCase c = test::massless(rolling());
  c.ground = contact::GroundShape{};
  const test::Built b = test::build(c);
  EXPECT_EQ(step_of(b.model), StepKind::general);
  test::Reference run(b.model, start(b.model, test::some_displacement(b), test::some_velocity(b)));
  std::map<std::size_t, SlidingState> before;
  int slid = 0, pressed = 0;
  for (int n = 0; n < 800; ++n) {
    const ContactReport& report = run.step().contact;
    EXPECT_EQ(report.clusters_not_converged, 0);
    std::map<std::size_t, SlidingState> now;
    for (const ActiveContact& a : run.state.active) {
      const auto node = static_cast<std::size_t>(b.model.contact->nodes[a.candidate]);
      now[a.candidate] = {position(b.model, run.state, node), std::abs(a.before.y),
                          a.impulse.x / (b.model.dt * b.model.contact->tributary[a.candidate])};
      const auto was = before.find(a.candidate);
      if (was == before.end() || a.status != contact::Status::slip) continue;
      EXPECT_NEAR(std::abs(a.impulse.y), some_law(was->second) * a.impulse.x, 1e-12 * a.impulse.x)
          << n << " " << a.candidate;
      ++slid;
      pressed += was->second.pressure > 0.0 ? 1 : 0;
    }
    before = std::move(now);
  }
  EXPECT_GT(slid, 200);
  EXPECT_GT(pressed, 100);
  EXPECT_LT(run.last.balance.relative, 1e-12);
}

/// What a checkpoint keeps is enough to ask the law again.
TEST(FrictionLaw, GoesOnToTheSameBits) {
  const test::Built b = test::build(rolling());
  const State at_start = start(b.model, test::some_displacement(b), test::some_velocity(b));
  GeneralIntegrator whole(b.model, at_start), other(b.model, at_start);
  std::vector<StepReport> reports(300);
  whole.advance(reports);
  other.restore(whole.save());
  State a = at_start, c = at_start;
  whole.advance(reports, &a);
  other.advance(reports, &c);
  EXPECT_EQ(a.u, c.u);
  EXPECT_EQ(a.v, c.v);
}

TEST(FrictionLaw, IsLeftToTheReadableStepWhereOthersSolveSomeOfTheContacts) {
  const auto kind = [](Features with) { return choose_step(has::friction_law | with)->kind; };
  EXPECT_EQ(kind(0), StepKind::cyclic);
  EXPECT_EQ(kind(has::assembled), StepKind::sparse);
  EXPECT_EQ(kind(has::loaded_rim), StepKind::cyclic);
  EXPECT_EQ(kind(has::three_dimensions), StepKind::solid_cyclic);
  EXPECT_EQ(kind(has::three_dimensions | has::loaded_rim), StepKind::solid_cyclic);
  EXPECT_EQ(kind(has::sharp_corners), StepKind::bodies);
  EXPECT_EQ(kind(has::sharp_corners | has::loaded_rim), StepKind::wheel);
  EXPECT_EQ(kind(has::sharp_corners | has::three_dimensions), StepKind::solid);
  EXPECT_EQ(kind(has::implicit), StepKind::general);
  EXPECT_EQ(kind(has::massless), StepKind::general);
  EXPECT_EQ(kind(has::friction_law | has::reduced), StepKind::reduced);
  EXPECT_EQ(choose_step(has::friction_law | has::hati | has::other_scheme), nullptr);
  test::RollingCase with_corner = test::sharp(test::everything("", 3, 60));
  with_corner.law = {Friction(some_law), 0.0};
  const test::Built b = test::build(with_corner);
  const State at_start = start(b.model, test::some_displacement(b), test::some_velocity(b));
  EXPECT_DEATH(SparseIntegrator(b.model, at_start, kernel_table()), "has_friction_law");
}

}  // namespace friction_law_test
