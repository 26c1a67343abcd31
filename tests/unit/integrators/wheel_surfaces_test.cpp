// SPDX-License-Identifier: BSD-3-Clause
/// A body that touches itself on a loaded rim: the general step takes it. Grooves of its tread that
/// close open no ledger and give no momentum; where none closes it is as the fused steps have it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "rondo/mesh/edges.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/stepping.hpp"
#include "support/wheel_momenta.hpp"

namespace wheel_surfaces_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr int pitches = 60, columns = 3;  // of a pitch, one of them the groove

test::RollingCase treaded_wheel() {
  const mesh::Tread tread{pitches, 0.02, columns - 1, 1, 2};
  return test::on_rim(test::everything("treaded", 3, tread), true, true, true);
}

/// Candidates are walls and bottoms of the grooves too.
Model touching_itself(const test::Built& b) {
  Model model = test::model_with(b, StiffnessOperator::sparse);
  const std::vector<char> clamped = mesh::clamped_flags(b.mesh);
  SurfaceContact s{{}, {}, {}, true, {0.4, 0.0}};
  std::vector<double> length(b.mesh.n_nodes());
  for (const mesh::Edge e : mesh::boundary_edges(mesh::EdgeTable(b.mesh))) {
    const auto from = static_cast<std::size_t>(e[0]), to = static_cast<std::size_t>(e[1]);
    if (clamped[from] != 0 || clamped[to] != 0) continue;
    s.edges.push_back(e);
    const double half = 0.5 * norm(b.mesh.coordinates[to] - b.mesh.coordinates[from]);
    length[from] += half;
    length[to] += half;
  }
  for (std::size_t k = 0; k < length.size(); ++k) {
    if (length[k] == 0.0) continue;
    s.nodes.push_back(static_cast<int>(k));
    s.tributary.push_back(length[k]);
  }
  if (model.contact)
    model.contact.emplace(
        ContactModel{model.contact->ground, model.contact->law, s.nodes, s.tributary, s.edges});
  model.surfaces.emplace(s);
  return model;
}

/// Lands swing about their feet, each other one to the other side, by `speed` at their tops.
std::vector<Vec2> swinging_lands(const test::Built& b, double speed) {
  std::vector<Vec2> v(b.model.n_nodes());
  for_free_nodes(b.model, [&](std::size_t k) {
    const Vec2 x = b.model.reference[k];
    const double radius = norm(x), above = std::max(0.0, radius - 0.28) / 0.02;
    const double turns = (std::atan2(x.y, x.x) / (2.0 * 3.141592653589793) + 1.25) * pitches;
    const bool even = static_cast<int>(std::floor(turns + 0.01)) % 2 == 0;
    v[k] = (even ? speed : -speed) * above / radius * turn90(x);
  });
  return v;
}

}  // namespace

TEST(WheelSurfaces, GroovesThatCloseOpenNoLedger) {
  const test::Built b = test::build(treaded_wheel());
  const Model model = touching_itself(b);
  ASSERT_EQ(step_of(model), StepKind::wheel);
  test::Stepping run(model,
                     start(model, std::vector<Vec2>(model.n_nodes()), swinging_lands(b, 80.0)));
  int between = 0, ground = 0;
  run.advance(1500, [&](const StepReport& r) {
    between = std::max(between, r.contact.between_bodies);
    ground += r.contact.nodes - r.contact.between_bodies;
  });
  EXPECT_GE(between, 10);
  EXPECT_GT(ground, 0);
  EXPECT_GT(run.balance().works.dissipation_friction, 0.0);
  EXPECT_LT(run.balance().relative, 1e-12);
}

/// In the air: what touches is all inside.
TEST(WheelSurfaces, GroovesThatCloseGiveNoMomentum) {
  test::RollingCase c = treaded_wheel();
  c.ground.reset();
  c.disk.motion.gravity = Table(0.0);
  RimBody& rim = *c.rim;
  rim.force_x = rim.force_y = rim.torque = rim.brake = Table(0.0);
  rim.support_x = rim.support_y = {};
  const test::Built b = test::build(c);
  const Model model = touching_itself(b);
  test::Stepping run(model,
                     start(model, std::vector<Vec2>(model.n_nodes()), swinging_lands(b, 80.0)));
  run.advance(1);
  const test::WheelMomenta before = test::wheel_momenta(model, run.state());
  int between = 0;
  run.advance(1500,
              [&](const StepReport& r) { between = std::max(between, r.contact.between_bodies); });
  const test::WheelMomenta after = test::wheel_momenta(model, run.state());
  EXPECT_GE(between, 10);
  EXPECT_LT(norm(after.linear - before.linear), 1e-12 * norm(before.linear));
  EXPECT_LT(std::abs(after.angular - before.angular), 1e-12 * std::abs(before.angular));
}

TEST(WheelSurfaces, WhereNothingTouchesItIsTheFusedStep) {
  const test::Built b = test::build(treaded_wheel());
  const Model model = touching_itself(b);
  Model fused = model;  // the same candidates
  fused.surfaces.reset();
  ASSERT_EQ(step_of(fused), StepKind::sparse);
  const std::vector<Vec2> u = test::some_displacement(b), v = test::some_velocity(b);
  test::Stepping general_run(model, start(model, u, v)), fused_run(fused, start(fused, u, v));
  test::Comparison comparison(test::Comparison::Contacts::by_node);
  int nodes = 0;
  for (int n = 0; n < 500; ++n) {
    nodes += general_run.advance().nodes;
    ASSERT_EQ(general_run.report().contact.between_bodies, 0);
    fused_run.advance();
    comparison.see(general_run.report(), fused_run.report());
    comparison.see(general_run.state(), fused_run.state());
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(nodes, 0);
  comparison.expect_within(1e-10);
}

/// On the edges as they lie, those of the rim among them: all round the tread, and in a cavity that
/// the rim closes on one side. With edges of the reference a body that is wound up would be turned.
TEST(WheelPressures, OnClosedCurvesGiveNoMomentum) {
  test::RollingCase c = test::everything("flying", 4, 61);
  c.ground.reset();
  c.disk.motion.gravity = Table(0.0);
  RimBody rim;
  rim.free_x = rim.free_y = rim.free_spin = true;
  rim.mass = 5.0;
  rim.inertia = 0.05;
  c.rim = rim;
  test::Built b = test::build(c);
  const mesh::Cell& cell = b.mesh.cells.front();
  std::vector<mesh::Edge> cavity;
  for (std::size_t k = 0; k < 4; ++k) cavity.push_back({cell[k], cell[(k + 1) % 4]});
  const std::vector<char> clamped = mesh::clamped_flags(b.mesh);
  const auto is_clamped = [&](int node) { return clamped[static_cast<std::size_t>(node)] != 0; };
  ASSERT_EQ(std::count_if(cell.begin(), cell.end(), is_clamped), 2);
  b.model.pressures = {{b.mesh.contact_edges, Table({{0.0, 0.0}, {0.002, 3.0e5}})},
                       {cavity, Table(4.0e5)}};
  ASSERT_EQ(step_of(b.model), StepKind::wheel);
  const Model model = test::model_with(b, StiffnessOperator::sparse);
  std::vector<Vec2> wound(b.model.n_nodes());
  for_free_nodes(b.model, [&](std::size_t k) {
    const Vec2 x = b.model.reference[k];
    wound[k] = 0.05 * (norm(x) - 0.15) / 0.15 * turn90(x);
  });
  State state = start(model, wound, std::vector<Vec2>(b.model.n_nodes()));
  const auto steps = make_integrator(model, state);
  StepReport report;
  steps->advance({&report, 1}, &state);
  const test::WheelMomenta first = test::wheel_momenta(model, state);
  double turned = 0.0;
  for (int n = 0; n < 1000; ++n) {
    steps->advance({&report, 1}, &state);
    turned = std::max(turned, std::abs(report.rim.spin - 30.0));
  }
  const test::WheelMomenta last = test::wheel_momenta(model, state);
  EXPECT_GT(turned, 1.0);  // rim and body swing against each other
  EXPECT_LT(norm(last.linear - first.linear), 1e-12 * norm(first.linear));
  EXPECT_NEAR(last.angular, first.angular, 1e-12 * std::abs(first.angular));
  EXPECT_LT(report.balance.relative, 1e-12);
  EXPECT_NE(report.balance.works.load, 0.0);
}

}  // namespace wheel_surfaces_test
