// SPDX-License-Identifier: BSD-3-Clause
/// The readable steps of a wheel in three dimensions: energy, momenta, restart, a loaded rim.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "rondo/integrators/solid/solid_integrator.hpp"
#include "rondo/integrators/solid/solid_wheel_integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "support/solid_wheel.hpp"

namespace rondo::dynamics::solid_step_test {
namespace {

using test::Cornering;

mesh::Mesh small_mesh() {
  return make_wheel(test::box_wheel(2, 3, 30));
}

State at_rest(const Model& model) {
  const Field rest(model.n_nodes(), 3);
  return start(model, rest, rest);
}

/// Slip angle, speed, height, spin and gravity change; camber, restitution, pressure.
Model with_everything(const mesh::Mesh& mesh) {
  Model m = test::cornering_model(mesh, {.camber = 0.05});
  m.motion.slip_angle = Table({{0.0, 0.02}, {0.01, 0.1}, {0.05, -0.05}});
  m.motion.speed = Table({{0.0, 10.0}, {0.02, 9.0}});
  m.motion.angular_velocity = Table({{0.0, 33.0}, {0.03, 36.0}});
  m.motion.height = Table({{0.0, 0.301}, {0.02, 0.292}});
  m.motion.gravity = Table(9.81);
  m.motion.slope = 0.1;
  m.contact->law.restitution = 0.5;
  const auto& tread = mesh.surfaces;
  for (const mesh::Surface& s : tread)
    if (s.name == "left")
      m.solid->pressures.push_back(
          {fem::sector_pressure(mesh, m.solid->sector, s.faces), Table({{0.0, 0.0}, {0.05, 2e5}})});
  return m;
}

RimBody loaded_rim() {
  RimBody rim;
  rim.free_y = rim.free_spin = true;
  rim.mass = 12.0;
  rim.inertia = 0.2;
  rim.force_y = Table(-8000.0);
  rim.support_y.damping = 2000.0;
  return rim;
}

std::unique_ptr<Integrator> integrator_of(const Model& m, const State& s) {
  if (m.rim) return std::make_unique<SolidWheelIntegrator>(m, s);
  return std::make_unique<SolidIntegrator>(m, s);
}

struct Seen {
  double ledger = 0.0, law = 0.0;
  int most_contacts = 0;
};

Seen run(Integrator& integrator, int steps, StepReport& last) {
  Seen seen;
  std::array<StepReport, 1> report;
  for (int n = 0; n < steps; ++n) {
    integrator.advance(report);
    seen.ledger = std::max(seen.ledger, report[0].balance.relative);
    seen.law = std::max(seen.law, report[0].contact.residual);
    seen.most_contacts = std::max(seen.most_contacts, report[0].contact.nodes);
  }
  last = report[0];
  return seen;
}

TEST(SolidStep, TheLedgerClosesWithEverythingOn) {
  const mesh::Mesh mesh = small_mesh();
  const Model m = with_everything(mesh);
  ASSERT_EQ(m.solid->pressures.size(), 1U);
  const State s = at_rest(m);
  StepReport last;
  SolidIntegrator integrator(m, s);
  const Seen seen = run(integrator, 1500, last);
  EXPECT_LT(seen.ledger, 1e-13);
  EXPECT_LT(seen.law, 1e-12);
  EXPECT_GT(seen.most_contacts, 5);
  const Works& w = last.balance.works;
  EXPECT_GT(w.dissipation_friction, 0.0);
  EXPECT_GT(w.loss_impact, 0.0);
  EXPECT_GT(w.dissipation_mass, 0.0);
  EXPECT_GT(w.dissipation_stiffness, 0.0);
  EXPECT_NE(w.load, 0.0);
}

TEST(SolidStep, TheLedgerClosesOnALoadedRim) {
  const mesh::Mesh mesh = small_mesh();
  Model m = with_everything(mesh);
  m.rim = loaded_rim();
  const State s = at_rest(m);
  StepReport last;
  SolidWheelIntegrator integrator(m, s);
  const Seen seen = run(integrator, 1500, last);
  EXPECT_LT(seen.ledger, 1e-12);
  EXPECT_LT(seen.law, 1e-12);
  EXPECT_GT(seen.most_contacts, 3);
}

/// The works by the forces on the ground alone: momenta along n and t2 of wheel and rim.
TEST(SolidStep, TheImpulsesOfTheGroundChangeTheMomentum) {
  const mesh::Mesh mesh = small_mesh();
  Model m = test::cornering_model(mesh, {.slip_angle = 0.05, .camber = 0.1});
  m.motion.height = Table(0.301);
  m.rim = loaded_rim();
  m.rim->free_x = true;
  m.rim->support_y.damping = 0.0;
  m.mass_damping = 0.0;
  const State s = at_rest(m);
  SolidWheelIntegrator integrator(m, s);
  const GroundFrame ground(m.motion.camber);
  const auto momentum = [&] {
    const SavedState saved = integrator.save();
    Vec3 sum;
    for_free_nodes(m, [&](std::size_t k) { sum += m.mass[k] * saved.v.space()[k]; });
    return ground.from_wheel(sum).plane() + m.rim->mass * Vec2{saved.rim[6], saved.rim[7]};
  };
  const Vec2 before = momentum();
  Vec2 impulse;
  std::array<StepReport, 1> report;
  for (int n = 0; n < 600; ++n) {
    integrator.advance(report);
    impulse += report[0].contact.impulse.plane() + m.dt * Vec2{0.0, -8000.0};
  }
  const Vec2 change = momentum() - before;
  EXPECT_GT(norm(impulse), 5.0);
  EXPECT_NEAR(change.x, impulse.x, 1e-10 * norm(before));
  EXPECT_NEAR(change.y, impulse.y, 1e-10 * norm(before));
}

TEST(SolidStep, GoesOnToTheSameBits) {
  const mesh::Mesh mesh = small_mesh();
  for (const bool rim : {false, true}) {
    Model m = with_everything(mesh);
    if (rim) m.rim = loaded_rim();
    const State s = at_rest(m);
    StepReport whole, part;
    const auto one = integrator_of(m, s), two = integrator_of(m, s);
    run(*one, 900, whole);
    run(*two, 400, part);
    const auto third = integrator_of(m, s);
    third->resumable()->restore(two->resumable()->save());
    run(*third, 500, part);
    const SavedState a = one->resumable()->save(), b = third->resumable()->save();
    EXPECT_EQ(a.u, b.u);
    EXPECT_EQ(a.v, b.v);
    EXPECT_EQ(a.rim, b.rim);
    EXPECT_EQ(a.ledger, b.ledger);
    EXPECT_EQ(whole.contact.impulse, part.contact.impulse);
  }
}

double some_law(const contact::SlidingState& s) {
  return 0.2 + 0.1 * std::sin(40.0 * s.place.x + 60.0 * s.place.z) - 0.01 * s.slip +
         1e-8 * s.pressure;
}

/// What the law gives at the contacts of a step; `pressure` (by candidate) of the step before.
void expect_the_law(const Model& m, const State& s, std::map<std::size_t, double>& pressure,
                    int& slid) {
  const GroundFrame ground(m.motion.camber);
  std::map<std::size_t, double> now;
  for (const ActiveContact& c : s.active) {
    const auto k = static_cast<std::size_t>(m.contact->nodes[c.candidate]);
    const Vec3 arm = Vec3(m.reference[k], m.solid->axial[k]) + s.u.space()[k];
    const Vec3 place = s.frame.center + ground.from_wheel(s.frame.rotation * arm);
    const double slip = std::hypot(c.before.y, c.before.z);
    const double expected = some_law({place, slip, pressure[c.candidate]});
    EXPECT_NEAR(c.friction, expected, 1e-12) << s.step << " " << c.candidate;
    now[c.candidate] = c.impulse.x / (m.dt * m.contact->tributary[c.candidate]);
    if (c.status != contact::Status::slip) continue;
    EXPECT_NEAR(std::hypot(c.impulse.y, c.impulse.z), expected * c.impulse.x, 1e-11 * c.impulse.x);
    slid += pressure[c.candidate] > 0.0 ? 1 : 0;
  }
  pressure = std::move(now);
}

/// At every contact: with place, slip and pressure as the step before has left them, also after a
/// restart.
TEST(SolidStep, AsksAFrictionLaw) {
  const mesh::Mesh mesh = small_mesh();
  for (const bool rim : {false, true}) {
    Model m = test::cornering_model(mesh, {.slip_angle = 0.1, .camber = 0.05});
    m.contact->law.friction = contact::Friction(some_law);
    if (rim) m.rim = loaded_rim();
    State state = at_rest(m);
    auto integrator = integrator_of(m, state);
    std::map<std::size_t, double> pressure;
    std::array<StepReport, 1> report;
    int slid = 0;
    for (int n = 0; n < 600; ++n) {
      if (n == 300) {
        auto other = integrator_of(m, at_rest(m));
        other->resumable()->restore(integrator->resumable()->save());
        integrator = std::move(other);
      }
      integrator->advance(report, &state);
      expect_the_law(m, state, pressure, slid);
      EXPECT_LT(report[0].contact.residual, 1e-11);
    }
    EXPECT_GT(slid, 200);
    EXPECT_LT(report[0].balance.relative, 1e-12);
  }
}

/// With all of it held, a loaded rim goes as the tables say, and the body with it.
TEST(SolidStep, AHeldRimIsTheRimThatFollowsItsTables) {
  const mesh::Mesh mesh = small_mesh();
  Model m = test::cornering_model(mesh, {.slip_angle = 0.05, .camber = 0.05});
  m.motion.height = Table({{0.0, 0.301}, {0.02, 0.295}});
  m.stiffness_damping = m.mass_damping = 0.0;
  const State s = at_rest(m);
  SolidIntegrator follows(m, s);
  Model held = m;
  held.rim = RimBody{};
  held.rim->mass = 10.0;
  held.rim->inertia = 0.1;
  const State t = at_rest(held);
  SolidWheelIntegrator loaded(held, t);
  double lateral[2] = {}, normal[2] = {};
  std::array<StepReport, 1> report;
  for (int n = 0; n < 800; ++n) {
    follows.advance(report);
    lateral[0] += report[0].contact.impulse.z, normal[0] += report[0].contact.impulse.y;
    loaded.advance(report);
    lateral[1] += report[0].contact.impulse.z, normal[1] += report[0].contact.impulse.y;
  }
  EXPECT_GT(normal[0], 50.0);
  EXPECT_NEAR(normal[1], normal[0], 2e-3 * normal[0]);
  EXPECT_NEAR(lateral[1], lateral[0], 2e-3 * normal[0]);
}

}  // namespace
}  // namespace rondo::dynamics::solid_step_test
