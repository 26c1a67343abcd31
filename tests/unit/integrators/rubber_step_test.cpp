// SPDX-License-Identifier: BSD-3-Clause
/// Rubber at finite strain in the general step: momenta, energies, bits (docs/rubber.md, section
/// 3).
#include <gtest/gtest.h>

#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/model/hyperelastic.hpp"
#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::dynamics::rubber_step_test {
namespace {

using test::Built;

fem::Material rubber(std::vector<fem::ViscousBranch> branches = {},
                     fem::RubberLaw law = fem::RubberLaw::neo_hooke) {
  fem::Rubber r;
  r.law = law;
  r.c10 = 1.0e6;
  if (law == fem::RubberLaw::yeoh) r.c20 = -5.0e4, r.c30 = 1.0e4;
  r.bulk_modulus = 4.0e7;
  r.branches = std::move(branches);
  const double mu = 2.0e6, k = r.bulk_modulus;
  fem::Material m;
  m.youngs_modulus = 9.0 * k * mu / (3.0 * k + mu);
  m.poissons_ratio = (3.0 * k - 2.0 * mu) / (2.0 * (3.0 * k + mu));
  m.density = 1100.0;
  m.integration = fem::Integration::b_bar;
  m.rubber = r;
  return m;
}

void set_rubber(const mesh::Mesh& mesh, const std::vector<fem::Material>& materials, Model& model) {
  model.internal_force =
      hyperelastic_maker(std::make_shared<const fem::Hyperelasticity>(mesh, materials));
}

/// Flies, turns and vibrates.
struct Flight {
  explicit Flight(double safety, std::vector<fem::ViscousBranch> branches = {}) {
    test::add_block(mesh,
                    {.corner = {0.3, -0.2}, .width = 0.2, .height = 0.1, .columns = 6, .rows = 3});
    const fem::Material material = rubber(std::move(branches));
    model = test::body_model(mesh, material, 0.0, 0.0, safety);
    set_rubber(mesh, {material}, model);
  }
  [[nodiscard]] State start() const {
    std::vector<Vec2> u, v;
    for (const Vec2 x : mesh.coordinates) {
      const Vec2 arm = x - model.free_bodies[0].center;
      u.push_back({0.1 * arm.x, arm.y / 1.1 - arm.y});
      v.push_back(Vec2{3.0, 1.0} + 60.0 * turn90(arm + u.back()));
    }
    return dynamics::start(model, u, v);
  }

  mesh::Mesh mesh;
  Model model;
};

double kinetic_at_start(const Model& model, const State& start) {
  double sum = 0.0;
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    sum += 0.5 * model.mass[k] * dot(start.v.plane()[k], start.v.plane()[k]);
  return sum;
}

/// Root mean square of A - U - D over a time, over the kinetic energy of the start.
double integration_error(double safety, std::vector<fem::ViscousBranch> branches) {
  const Flight flight(safety, std::move(branches));
  const State start = flight.start();
  const double kinetic = kinetic_at_start(flight.model, start);
  test::Stepping run(flight.model, flight.start());
  double squares = 0.0, n = 0.0;
  run.advance_to(0.05, [&](const StepReport& report) {
    squares += std::pow(report.material.integration(), 2);
    ++n;
  });
  EXPECT_LT(run.balance().relative, 1e-12);
  return std::sqrt(squares / n) / kinetic;
}

Built rolling(std::vector<fem::ViscousBranch> branches, double beta = 0.0) {
  test::DiskCase c = test::rolling_disk(4, 60);
  c.material = rubber(std::move(branches), fem::RubberLaw::yeoh);
  c.alpha = 20.0;
  c.beta = beta;
  c.safety = 0.6;
  Built b = test::build(c);
  test::add_ground(b, test::ledge(), {0.4, 0.0});
  set_rubber(b.mesh, b.materials, b.model);
  return b;
}

const std::vector<fem::ViscousBranch> two_branches{{0.3, 1.0e-3}, {0.2, 3.0e-4}};

void expect_same(const State& a, const State& b) {
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
}

}  // namespace

TEST(RubberStep, AFlightKeepsItsMomenta) {
  for (const auto& branches : {std::vector<fem::ViscousBranch>{}, two_branches}) {
    const Flight flight(0.7, branches);
    test::Stepping run(flight.model, flight.start());
    run.advance(1);
    const test::Momentum before = test::momentum(flight.model, run.state());
    run.advance(3000);
    const test::Momentum after = test::momentum(flight.model, run.state());
    EXPECT_LT(norm(after.linear - before.linear), 1e-13 * norm(before.linear));
    EXPECT_NEAR(after.angular, before.angular, 1e-13 * std::abs(before.angular));
    EXPECT_LT(run.balance().relative, 1e-12);
    EXPECT_GT(std::abs(run.state().poses[0].angle), 1.0);
  }
}

/// The error of the energy is of second order in the step.
TEST(RubberStep, WorkIsWhatIsStoredAndLost) {
  const double coarse = integration_error(0.2, {}), fine = integration_error(0.1, {});
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

TEST(RubberStep, WorkIsWhatIsStoredAndLostWithBranches) {
  const double coarse = integration_error(0.2, two_branches),
               fine = integration_error(0.1, two_branches);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

TEST(RubberStep, TheLedgerClosesWhileItRolls) {
  for (const double beta : {0.0, 1e-6}) {
    const Built b = rolling(two_branches, beta);
    test::Stepping run(b.model, test::start_at_rest(b.model));
    int touches = 0;
    double last = 0.0;
    run.advance(800, [&](const StepReport& report) {
      touches += report.contact.nodes > 0 ? 1 : 0;
      EXPECT_GE(report.material.dissipation_viscous, last);
      last = report.material.dissipation_viscous;
    });
    EXPECT_GT(touches, 100);
    EXPECT_LT(run.balance().relative, 1e-12);
    EXPECT_GT(last, 0.0);
    EXPECT_GT(run.report().material.least_volume, 0.5);
    EXPECT_LT(std::abs(run.report().material.integration()), 1e-2 * run.balance().exchanged);
    EXPECT_EQ(run.balance().works.dissipation_stiffness > 0.0, beta > 0.0);
  }
}

TEST(RubberStep, GoesOnToTheSameBitsOnAnyNumberOfThreads) {
  const Built b = rolling(two_branches);
  const State start = test::start_at_rest(b.model);
  GeneralIntegrator whole(b.model, start);
  std::vector<StepReport> reports(150);
  State one(b.model), other(b.model);
  whole.advance(reports, &one);
  GeneralIntegrator first(b.model, start);
  first.advance(std::span(reports).first(70));
  Model threads = b.model;
  threads.threads = 3;
  GeneralIntegrator second(threads, start);
  second.restore(first.save());
  second.advance(std::span(reports).first(80), &other);
  expect_same(one, other);
  EXPECT_EQ(whole.save().internal_work, second.save().internal_work);
  EXPECT_EQ(whole.save().branches, second.save().branches);
  EXPECT_EQ(whole.save().ledger, second.save().ledger);
}

TEST(RubberStep, GoesOnToTheSameBitsOnALoadedRim) {
  Built b = rolling(two_branches);
  RimBody rim;
  rim.free_y = true;
  rim.mass = 100.0;
  rim.inertia = 1.0;
  test::set_rim(b, rim);
  const State start = test::start_at_rest(b.model);
  WheelIntegrator whole(b.model, start), first(b.model, start), second(b.model, start);
  std::vector<StepReport> reports(150);
  State one(b.model), other(b.model);
  whole.advance(reports, &one);
  EXPECT_LT(reports.back().balance.relative, 1e-12);
  EXPECT_NE(reports.back().material.stored_energy, 0.0);
  first.advance(std::span(reports).first(70));
  second.restore(first.save());
  second.advance(std::span(reports).first(80), &other);
  expect_same(one, other);
  EXPECT_EQ(whole.save().internal_work, second.save().internal_work);
}

/// Small motions are those of the stiffness of small strain.
TEST(RubberStep, SmallMotionsAreLinear) {
  test::DiskCase c = test::rolling_disk(3, 30);
  c.material = rubber();
  c.motion = {};
  c.alpha = c.beta = 0.0;
  Built b = test::build(c);
  std::vector<Vec2> u(b.model.n_nodes());
  for (const int node : b.mesh.boundary) u[static_cast<std::size_t>(node)] = {1e-8, -2e-8};
  Model finite = b.model;
  set_rubber(b.mesh, b.materials, finite);
  test::Stepping linear(b.model, dynamics::start(b.model, u, std::vector<Vec2>(u.size()))),
      rubber(finite, dynamics::start(finite, u, std::vector<Vec2>(u.size())));
  linear.advance(100);
  rubber.advance(100);
  double error = 0.0, size = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    error = std::max(error, norm(linear.state().u.plane()[k] - rubber.state().u.plane()[k]));
    size = std::max(size, norm(linear.state().u.plane()[k]));
  }
  EXPECT_LT(error, 1e-5 * size);
}

}  // namespace rondo::dynamics::rubber_step_test
