// SPDX-License-Identifier: BSD-3-Clause
/// Elements of rubber in the sparse step: the readable step to round-off, the same bits for any
/// number of threads and after a restart (docs/rubber.md, section 4).
#include <gtest/gtest.h>

#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/general/wheel_integrator.hpp"
#include "rondo/integrators/integrator.hpp"
#include "support/rubber.hpp"
#include "support/stepping.hpp"

namespace rondo::dynamics::rubber_fused_test {
namespace {

using test::Built;

fem::Rubber rubber_of(fem::RubberLaw law) {
  fem::Rubber r;
  r.law = law;
  r.bulk_modulus = 4.0e7;
  r.c10 = 1.0e6;
  if (law == fem::RubberLaw::mooney_rivlin) r.c01 = 2.0e5;
  if (law == fem::RubberLaw::yeoh) r.c20 = -5.0e4, r.c30 = 1.0e4;
  if (law == fem::RubberLaw::ogden) r.terms = {{1.2e6, 1.3}, {2.0e5, 5.0}};
  return r;
}

struct Rolling {
  fem::Rubber rubber = rubber_of(fem::RubberLaw::neo_hooke);
  double beta = 0.0;
  bool belt = false;  ///< the second layer from outside is linear, and stiff
  bool sharp = false;
  bool rim = false;
  double pressure = 0.0;  ///< on the tread [Pa]
};

/// A ring of 5 × 60, pressed in by 10 mm, on to a ledge.
Built rolling(const Rolling& of) {
  test::DiskCase c = test::rolling_disk(5, 60);
  c.material = test::rubber_material(of.rubber);
  c.alpha = 20.0;
  c.beta = of.beta;
  c.safety = 0.5;
  Built b = test::build(c);
  if (of.belt) {
    b.materials.push_back({1.0e8, 0.3, 1500.0});
    b.mesh.region_names = {"rubber", "belt"};
    b.mesh.region.assign(b.mesh.cells.size(), 0);
    for (std::size_t e = 0; e < b.mesh.cells.size(); ++e)
      if (norm(b.mesh.coordinates[static_cast<std::size_t>(b.mesh.cells[e][0])]) > 0.25 &&
          norm(b.mesh.coordinates[static_cast<std::size_t>(b.mesh.cells[e][0])]) < 0.275)
        b.mesh.region[e] = 1;
    b.model.mass = fem::lumped_mass(b.mesh, b.materials);
    test::set_stiffness(b, c);
  }
  test::add_ground(
      b,
      of.sharp ? contact::GroundShape{.profile = {{-1, 0}, {-0.28, 0}, {-0.28, -0.1}, {9, -0.1}}}
               : contact::GroundShape{.profile = {{-1, 0}, {9, 0}}},
      {0.4, 0.0});
  b.model.contact->edges = b.mesh.contact_edges;
  if (of.rim) {
    dynamics::RimBody rim;
    rim.mass = 20.0;
    rim.free_y = true;
    rim.force_y = Table(-2.0e4);
    test::set_rim(b, rim);
  }
  if (of.pressure != 0.0) b.model.pressures.push_back({b.mesh.contact_edges, Table(of.pressure)});
  test::set_rubber(b);
  return b;
}

struct Ran {
  State state;
  StepReport last;
  double ledger = 0.0;
  int touches = 0;  ///< steps with contacts
};

Ran run(const Built& b, Integrator& integrator, int steps) {
  Ran ran{State(b.model), {}, 0.0, 0};
  std::vector<StepReport> reports(static_cast<std::size_t>(steps));
  integrator.advance(reports, &ran.state);
  ran.last = reports.back();
  ran.ledger = ran.last.balance.relative;
  for (const StepReport& report : reports) ran.touches += report.contact.nodes > 0 ? 1 : 0;
  return ran;
}

void expect_near(const Ran& a, const Ran& b) {
  double u = 0.0, du = 0.0, v = 0.0, dv = 0.0;
  for (std::size_t k = 0; k < a.state.u.size(); ++k) {
    u = std::max(u, norm(a.state.u.plane()[k]));
    v = std::max(v, norm(a.state.v.plane()[k]));
    du = std::max(du, norm(a.state.u.plane()[k] - b.state.u.plane()[k]));
    dv = std::max(dv, norm(a.state.v.plane()[k] - b.state.v.plane()[k]));
  }
  EXPECT_LT(du, 1e-11 * u);
  EXPECT_LT(dv, 1e-10 * v);
  const MaterialReport &m = a.last.material, &n = b.last.material;
  EXPECT_NEAR(m.internal_work, n.internal_work, 1e-11 * n.internal_work);
  EXPECT_NEAR(m.stored_energy, n.stored_energy, 1e-11 * n.stored_energy);
  EXPECT_NEAR(m.dissipation_viscous, n.dissipation_viscous, 1e-11 * n.internal_work);
  EXPECT_NEAR(m.least_volume, n.least_volume, 1e-11);
  EXPECT_NEAR(a.last.balance.strain, b.last.balance.strain, 1e-11 * b.last.balance.strain);
  EXPECT_LT(a.ledger, 1e-12);
  EXPECT_LT(b.ledger, 1e-12);
}

void expect_as_readable(const Rolling& of) {
  const Built b = rolling(of);
  const State start = test::start_at_rest(b.model);
  const auto readable = of.rim ? std::unique_ptr<Integrator>(new WheelIntegrator(b.model, start))
                               : std::unique_ptr<Integrator>(new GeneralIntegrator(b.model, start));
  const Ran expected = run(b, *readable, 300);
  EXPECT_GT(expected.touches, 100);
  EXPECT_GT(expected.last.material.stored_energy, 1.0);
  for (const kernels::Table* table : kernel_tables()) {
    SCOPED_TRACE(table->name);
    SparseIntegrator fused(b.model, start, *table);
    expect_near(run(b, fused, 300), expected);
  }
}

const std::vector<fem::ViscousBranch> two_branches{{0.3, 1.0e-3}, {0.2, 3.0e-4}};

}  // namespace

TEST(RubberFused, IsTheReadableStepByAllLaws) {
  for (const fem::RubberLaw law : {fem::RubberLaw::neo_hooke, fem::RubberLaw::mooney_rivlin,
                                   fem::RubberLaw::yeoh, fem::RubberLaw::ogden})
    for (const bool one_point : {false, true}) {
      SCOPED_TRACE(static_cast<int>(law));
      Rolling of{.rubber = rubber_of(law)};
      of.rubber.one_point = one_point;
      expect_as_readable(of);
    }
}

TEST(RubberFused, IsTheReadableStepWithBranchesAndDamping) {
  Rolling of{.beta = 1.0e-6};
  of.rubber.branches = two_branches;
  expect_as_readable(of);
}

TEST(RubberFused, IsTheReadableStepWithABelt) {
  expect_as_readable({.belt = true});
}

TEST(RubberFused, IsTheReadableStepUnderAPressureThatFollowsTheBoundary) {
  expect_as_readable({.pressure = 1.0e5});
}

TEST(RubberFused, IsTheReadableStepAtASharpCorner) {
  Rolling of{.sharp = true};
  of.rubber.branches = two_branches;
  expect_as_readable(of);
}

TEST(RubberFused, IsTheReadableStepOnALoadedRim) {
  Rolling of{.rim = true};
  of.rubber.branches = two_branches;
  expect_as_readable(of);
}

TEST(RubberFused, HasTheSameBitsOnAnyNumberOfThreads) {
  Rolling of{.belt = true};
  of.rubber.branches = two_branches;
  Built b = rolling(of);
  const State start = test::start_at_rest(b.model);
  const Ran one = run(b, *make_integrator(b.model, start), 200);
  for (const int threads : {2, 3}) {
    b.model.threads = threads;
    const Ran many = run(b, *make_integrator(b.model, start), 200);
    EXPECT_EQ(many.state.u, one.state.u);
    EXPECT_EQ(many.state.v, one.state.v);
    EXPECT_EQ(many.last.material.stored_energy, one.last.material.stored_energy);
  }
}

TEST(RubberFused, GoesOnToTheSameBits) {
  for (const bool rim : {false, true}) {
    Rolling of{.rim = rim};
    of.rubber.branches = two_branches;
    const Built b = rolling(of);
    const State start = test::start_at_rest(b.model);
    const auto whole = make_integrator(b.model, start), first = make_integrator(b.model, start),
               second = make_integrator(b.model, start);
    const Ran expected = run(b, *whole, 300);
    run(b, *first, 130);
    second->resumable()->restore(first->resumable()->save());
    const Ran found = run(b, *second, 170);
    EXPECT_EQ(found.state.u, expected.state.u);
    EXPECT_EQ(found.state.v, expected.state.v);
    EXPECT_EQ(found.last.material.internal_work, expected.last.material.internal_work);
    EXPECT_EQ(found.last.material.dissipation_viscous, expected.last.material.dissipation_viscous);
  }
}

}  // namespace rondo::dynamics::rubber_fused_test
