// SPDX-License-Identifier: BSD-3-Clause
/// The readable step, which the fused ones are held to.
#include "rondo/integrators/general/general_integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/models.hpp"
#include "support/traps.hpp"

namespace general_step_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// One particle without stiffness, held by nothing.
Model particle(const Motion& motion, Vec2 place, double dt) {
  Model m;
  m.reference = {place};
  m.mass = {2.0};
  m.free = {0};
  m.stiffness.row_start = {0, 0};
  m.motion = motion;
  m.dt = dt;
  return m;
}

double distance_after(const Motion& motion, double end, int steps) {
  const Vec2 place{0.3, -0.1};
  const Model model = particle(motion, place, end / steps);
  const std::vector<Vec2> u0{{0.01, 0.02}}, v0{{0.5, -0.3}};
  test::Reference run(model, start(model, u0, v0));
  const State& state = run.state;
  for (int n = 0; n < steps; ++n) run.step();
  // In the fixed frame: a parabola, whatever the frame does.
  const FrameStep f = frame_step(motion, 0, model.dt);
  const Vec2 x0 = f.center.plane() + place + u0[0];
  const Vec2 speed = f.advance.plane() / model.dt;
  const Vec2 v = Vec2{motion.speed.at(0.0), speed.y} + turn90(f.spin * (place + u0[0])) + v0[0];
  const Vec2 expected = x0 + end * v + 0.5 * end * end * Vec2{0.0, -motion.gravity.at(0.0)};
  return norm(position(model, state, 0) - expected);
}

}  // namespace

/// Centrifugal, Coriolis, Euler and translation terms and gravity in one, knots of the tables
/// included: second order in Δt.
TEST(GeneralStep, AFreeParticleFallsOnAParabolaInAnyFrame) {
  Motion motion;
  motion.angular_velocity = Table({{0.0, 3.0}, {0.333, 20.0}, {1.0, 9.0}});
  motion.speed = Table({{0.0, 2.0}, {0.417, 5.0}, {1.0, -3.0}});
  motion.height = Table({{0.0, 1.0}, {1.0, 0.4}});
  motion.gravity = Table(9.81);
  const double coarse = distance_after(motion, 0.8, 8000),
               fine = distance_after(motion, 0.8, 16000);
  EXPECT_LT(coarse, 1e-4);  // of some 3 m, at up to 20 rad/s
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

TEST(GeneralStep, MassDampingIsTheMidpointDecay) {
  Model model = particle({}, {0.0, 0.0}, 1e-3);
  model.mass_damping = 50.0;
  const std::vector<Vec2> u0{{0.0, 0.0}}, v0{{1.0, 0.0}};
  test::Reference run(model, start(model, u0, v0));
  const State& state = run.state;
  for (int n = 0; n < 100; ++n) run.step();
  const double x = 0.5 * 1e-3 * 50.0;
  const double expected = (1 - x / 2) / (1 + x / 2) * std::pow((1 - x) / (1 + x), 100);
  EXPECT_NEAR(state.v_next.plane()[0].x, expected, 1e-15);
}

/// What the law sees is what the body does: w⁺ Δt is the increment of the position in the next
/// step.
TEST(GeneralStep, LawVelocityIsTheDiscreteMotion) {
  auto b = test::build(test::rolling_disk(4, 40));
  test::add_ground(b, test::ledge(), {0.3, 0.0});
  test::Reference run(b.model, test::start_at_rest(b.model));
  const State& state = run.state;
  const test::FloatingPointTraps traps;
  int seen = 0, stuck = 0;
  for (int n = 0; n < 600; ++n) {
    run.step();
    const auto active = state.active;
    std::vector<Vec2> before;
    for (const auto& c : active)
      before.push_back(
          position(b.model, state, static_cast<std::size_t>(b.model.contact->nodes[c.candidate])));
    run.step();
    for (std::size_t i = 0; i < active.size(); ++i) {
      const auto node = static_cast<std::size_t>(b.model.contact->nodes[active[i].candidate]);
      const Vec2 move = position(b.model, state, node) - before[i];
      // Two positions of about 0.5 m, each the sum of three products: some 16 roundings of 6e-17.
      ASSERT_LT(norm(to_frame(active[i].normal, move) - b.model.dt * active[i].after), 2e-15);
      ++seen;
      if (active[i].status != contact::Status::stick) continue;
      ASSERT_LT(norm(move), 2e-15);  // it sticks: it does not creep
      ++stuck;
    }
  }
  EXPECT_GT(seen, 500);
  EXPECT_GT(stuck, 100);
}

TEST(GeneralStep, ABallBouncesWithItsRestitution) {
  Motion motion;
  motion.gravity = Table(9.81);
  Model model = particle(motion, {0.0, 1.0}, 1e-5);
  model.contact.emplace(
      ContactModel{contact::Ground(contact::GroundShape{}), {0.0, 0.5}, {0}, {1.0}});
  const std::vector<Vec2> zero(1);
  test::Reference run(model, start(model, zero, zero));
  const State& state = run.state;
  double impact = 0.0, apex = 0.0;
  for (int n = 0; n < 90000; ++n) {
    const ContactReport r = run.step().contact;
    if (r.nodes > 0 && impact == 0.0) impact = state.frame.time;
    if (impact > 0.0 && state.frame.time < impact + 0.45)
      apex = std::max(apex, position(model, state, 0).y);
  }
  EXPECT_NEAR(impact, 0.451524, 2e-5);  // √(2h/g), seen at the next step
  EXPECT_NEAR(apex, 0.25, 1e-4);        // e² h; the impact is late by up to a step: v Δt
}

/// It leaves with 1 m/s, still inside, and is pulled back to -3 m/s within the step.
TEST(GeneralStep, ANodeThatLeavesAndIsPulledBackIsNotStopped) {
  Motion motion;
  motion.gravity = Table(4000.0);
  for (const auto& [law, after] : {std::pair{contact::Law{0.0, 0.25}, -0.25},
                                   {contact::Law{0.0, 0.25, contact::Impact::energy_safe}, -1.0},
                                   {contact::Law{}, 0.0}}) {
    Model model = particle(motion, {0.0, -0.5}, 1e-3);
    model.contact.emplace(ContactModel{contact::Ground(contact::GroundShape{}), law, {0}, {1.0}});
    const std::vector<Vec2> zero(1), leaves{{0.0, 3.0}};
    test::Reference run(model, start(model, zero, leaves));
    const ContactReport r = run.step().contact;
    EXPECT_NEAR(run.state.v_next.plane()[0].y, after, 1e-14);
    EXPECT_NEAR(r.impulse.y, 2.0 * (after + 3.0), 1e-13);
    EXPECT_NEAR(r.loss_impact, -r.impulse.y * 0.5 * (1.0 + after), 1e-13);
    EXPECT_LT(r.residual, 1e-14);
  }
}

/// Two facets at once, the foot of a wall: the bounce is that of both, with friction it stays.
TEST(GeneralStep, AConcaveCornerStopsByBothFacets) {
  const contact::GroundShape foot{.profile = {{-9, 0}, {0, 0}, {0, 1}, {9, 1}}, .fillet = 0.1};
  for (const contact::Law& law : {contact::Law{0.0, 0.5}, contact::Law{0.3, 0.0}}) {
    Model model = particle({}, {-0.199, 0.0995}, 1e-3);
    model.contact.emplace(ContactModel{contact::Ground(foot), law, {0}, {1.0}});
    const std::vector<Vec2> zero(1), v0{{2.0, -1.0}};
    test::Reference run(model, start(model, zero, v0));
    const State& state = run.state;
    int pairs = 0;
    for (int n = 0; n < 150; ++n) {
      const ContactReport r = run.step().contact;
      pairs += r.pairs;
      EXPECT_EQ(r.pairs_not_converged, 0);
      if (r.pairs == 0 || pairs > 1) continue;
      EXPECT_LT(norm(r.impulse - 2.0 * (1.0 + law.restitution) * Vec2{-2.0, 1.0}), 1e-14);
      EXPECT_LT(norm(state.v_next.plane()[0] + law.restitution * v0[0]), 1e-15);
    }
    EXPECT_GT(pairs, 0);
    EXPECT_LT(norm(state.v_next.plane()[0] + law.restitution * v0[0]), 1e-15);
    EXPECT_LT(run.last.balance.relative, 1e-14);
  }
}

/// What V1 asks of the operators: every term, contacts, both schemes.
TEST(GeneralStep, ClosesItsLedger) {
  for (const Scheme scheme : {Scheme::symplectic, Scheme::as_printed}) {
    test::RollingCase c = test::everything("", 3, 60);
    c.disk.scheme = scheme;
    const test::Built b = test::build(c);
    test::Reference run(b.model,
                        start(b.model, test::some_displacement(b), test::some_velocity(b)));
    const test::FloatingPointTraps traps;
    int contacts = 0;
    for (int n = 0; n < 1000; ++n) contacts += run.step().contact.nodes;
    const Works& w = run.last.balance.works;
    EXPECT_GT(contacts, 500);
    EXPECT_LT(run.last.balance.relative, 2e-14);  // √(1,000 × 20) roundings of 1e-16
    EXPECT_LT(std::abs(w.contact - (w.rim - w.dissipation_friction - w.loss_impact)),
              1e-12 * run.last.balance.exchanged);
    EXPECT_GT(w.dissipation_friction, 1.0);
    EXPECT_GT(w.dissipation_mass, 0.1);
    EXPECT_GT(w.dissipation_stiffness, 0.1);
    EXPECT_EQ(w.scheme == 0.0, scheme == Scheme::symplectic);
  }
}

/// A material of its own, twice as stiff, beside a stiffness that is.
TEST(GeneralStep, TakesTheInternalForceOfTheModel) {
  const test::Built b = test::build(test::everything("", 3, 40));
  Model stiffer = b.model;
  for (auto& block : stiffer.stiffness.values)
    for (double& k : block) k *= 2.0;
  Model own = b.model;
  own.internal_force = [&](const Model&, std::span<const Vec2> u0, std::span<const Pose> poses) {
    return make_internal_force(stiffer, u0, poses);
  };
  EXPECT_EQ(step_of(b.model), StepKind::sparse);
  EXPECT_EQ(step_of(own), StepKind::general);
  const std::vector<Vec2> u = test::some_displacement(b), v = test::some_velocity(b);
  const State at_start = start(stiffer, u, v), own_start = start(own, u, v);
  EXPECT_EQ(at_start.force, own_start.force);
  for (std::size_t k = 0; k < u.size(); ++k)  // its damping is of a difference
    EXPECT_LT(norm(at_start.v_next.plane()[k] - own_start.v_next.plane()[k]),
              1e-10 * (1.0 + norm(v[k])))
        << k;
  GeneralIntegrator expected(stiffer, at_start);
  const std::unique_ptr<Integrator> run = make_integrator(own, at_start);
  std::vector<StepReport> reports(200);
  State a = at_start, c = at_start;
  expected.advance(reports, &a);
  run->advance(reports, &c);
  EXPECT_EQ(a.u, c.u);
  EXPECT_EQ(a.v, c.v);
}

TEST(GeneralStep, ClampedNodesStayClamped) {
  auto b = test::build(test::rolling_disk(3, 30));
  test::add_ground(b, test::ledge(), {0.6, 0.0});
  const std::vector<Vec2> ones(b.model.n_nodes(), Vec2{1.0, 1.0});
  test::Reference run(b.model, start(b.model, std::vector<Vec2>(b.model.n_nodes()), ones));
  const State& state = run.state;
  for (int n = 0; n < 500; ++n) run.step();
  for (const int node : b.mesh.clamped) {
    EXPECT_EQ(state.u.plane()[static_cast<std::size_t>(node)], Vec2{});
    EXPECT_EQ(state.v_next.plane()[static_cast<std::size_t>(node)], Vec2{});
  }
}

}  // namespace general_step_test
