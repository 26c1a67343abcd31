// SPDX-License-Identifier: BSD-3-Clause
// Contacts of general models: free blocks on the ground, corners, blocks against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/model/steps/step_table.hpp"
#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::dynamics::general_contact_test {
namespace {

const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};

std::vector<Vec2> velocities(const Model& model, const std::vector<Vec2>& of_body) {
  std::vector<Vec2> v(model.n_nodes());
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k] = of_body[static_cast<std::size_t>(model.free_body[k])];
  return v;
}

/// Largest figures of a run.
struct Extremes {
  double residual = 0.0, penetration = 0.0, length = 0.0;
  int nodes = 0, clusters = 0, not_converged = 0, largest = 0, iterations = 0, between = 0;

  void see(const StepReport& report) {
    const ContactReport& c = report.contact;
    if (c.free_velocity > 0.0) residual = std::max(residual, c.residual / c.free_velocity);
    penetration = std::max(penetration, c.penetration);
    length = std::max(length, c.length);
    nodes = std::max(nodes, c.nodes);
    clusters = std::max(clusters, c.clusters);
    not_converged += c.clusters_not_converged;
    largest = std::max(largest, c.cluster_largest);
    iterations = std::max(iterations, c.cluster_iterations);
    between = std::max(between, c.between_bodies);
  }
};

/// A block that comes straight down does not turn: followed in its rotation or not is the same.
TEST(GeneralContact, ABlockOnFlatGroundAsTheReferenceStepHasIt) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {0.0, 0.01}, .columns = 5, .rows = 4});
  Model model = test::body_model(mesh, rubber, 0.0, 1e-5, 0.8);
  test::add_ground(model, mesh, {}, {0.4, 0.2});
  Model held = model;  // u in a turning frame that does not turn
  held.free_bodies.clear();
  held.free_body.clear();
  ASSERT_EQ(step_of(model), StepKind::bodies);
  ASSERT_EQ(step_of(held), StepKind::sparse);
  const std::vector<Vec2> v(model.n_nodes(), Vec2{0.0, -2.0}), u(model.n_nodes());
  test::Stepping free(model, start(model, u, v)), reference(held, start(held, u, v));
  free.advance(200);
  reference.advance(200);
  // Round-off of a metre's place, over 200 steps.
  for (std::size_t k = 0; k < u.size(); ++k)
    EXPECT_LT(norm(free.state().u.plane()[k] - reference.state().u.plane()[k]), 1e-12);
  EXPECT_GT(reference.balance().works.dissipation_friction, 1.0);
  EXPECT_LT(free.balance().relative, 1e-12);
}

/// A block comes down on an edge between two of its nodes, sharp or rounded by less than the nodes
/// are apart, frictionless and with friction.
TEST(GeneralContact, ASharpCornerHoldsASegment) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {-0.5, 0.0}, .columns = 3, .rows = 3});
  for (const auto& [mu, fillet] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.05}, {0.5, 0.05}}) {
    Model model = test::body_model(mesh, rubber, 20.0, 2e-4, 0.8);
    model.motion.gravity = Table(9.81);
    // A roof whose ridge is under the middle of the middle edge, 0.01 m below it.
    const double ridge = fillet * (std::sqrt(2.0) - 1.0) - 0.01;
    test::add_ground(
        model, mesh,
        {.profile = {{-10, ridge - 10}, {0, ridge}, {10, ridge - 10}}, .fillet = fillet},
        {mu, 0.0});
    test::Stepping stepping(model, start(model, std::vector<Vec2>(model.n_nodes()),
                                         std::vector<Vec2>(model.n_nodes())));
    Extremes seen;
    stepping.advance_to(2.0, [&](const StepReport& r) { seen.see(r); });
    // At rest on the ridge: the corner carries the weight, 9.81 kN/m, and is no deeper than a
    // step's travel at the first touch, after a fall of 0.01 m.
    EXPECT_NEAR(stepping.report().contact.impulse.y / model.dt, 9810.0, 0.1) << mu;
    EXPECT_LT(seen.penetration, std::sqrt(2.0 * 9.81 * 0.011) * model.dt) << mu;
    EXPECT_LT(seen.residual, 1e-12) << mu;
    EXPECT_EQ(seen.not_converged, 0);
    EXPECT_LT(stepping.balance().relative, 1e-9) << fillet;
  }
}

struct TwoBlocks {
  mesh::Mesh mesh;
  Model model;
};
/// One above the other, the upper one shifted by a third of an element and a little turned.
TwoBlocks two_blocks(double mu, double alpha = 0.0) {
  TwoBlocks t;
  test::add_block(t.mesh, {.corner = {0.0, 0.0}, .columns = 5, .rows = 4});
  test::add_block(t.mesh, {.corner = {0.07, 1.01}, .columns = 6, .rows = 4, .turned = 0.004});
  t.model = test::body_model(t.mesh, rubber, alpha, 0.0, 0.8);
  test::add_surfaces(t.model, t.mesh, {mu, 0.0});
  return t;
}

TEST(GeneralContact, ACollisionKeepsMomentum) {
  for (const double mu : {0.0, 0.6}) {
    const TwoBlocks t = two_blocks(mu);
    test::Stepping stepping(t.model, start(t.model, std::vector<Vec2>(t.model.n_nodes()),
                                           velocities(t.model, {{0.5, 1.0}, {-0.5, -2.0}})));
    stepping.advance(1);
    const test::Momentum before = test::momentum(t.model, stepping.state());
    const double scale = 1000.0 * 2.0;  // mass of a block times its velocity
    Extremes seen;
    stepping.advance_to(0.3, [&](const StepReport& r) { seen.see(r); });
    const test::Momentum after = test::momentum(t.model, stepping.state());
    EXPECT_GE(seen.between, 6) << mu;
    EXPECT_EQ(stepping.report().contact.nodes, 0) << "they have parted";
    EXPECT_LT(norm(after.linear - before.linear), 1e-11 * scale) << mu;
    EXPECT_LT(std::abs(after.angular - before.angular), 1e-11 * scale) << mu;
    double upper = 0.0;
    for (const int node : t.model.free_bodies[1].nodes)
      upper += t.model.mass[static_cast<std::size_t>(node)] *
               stepping.state().v.plane()[static_cast<std::size_t>(node)].y /
               t.model.free_bodies[1].mass;
    EXPECT_GT(upper, 0.0) << "the upper block has bounced";
    EXPECT_LT(seen.residual, 1e-11) << mu;
    EXPECT_EQ(seen.not_converged, 0) << mu;
    EXPECT_LT(stepping.balance().relative, 1e-3) << mu;
    EXPECT_LT(std::abs(stepping.balance().works.rim), 1e-12 * stepping.balance().exchanged)
        << "nothing holds the bodies";
    if (mu == 0.0) {
      EXPECT_LT(std::abs(stepping.balance().works.dissipation_friction), 1e-12);
    } else {
      EXPECT_GT(stepping.balance().works.dissipation_friction, 0.1);
    }
  }
}

/// The ledger of a collision closes to second order: what is left is that of the turning bodies.
TEST(GeneralContact, TheLedgerOfACollisionClosesWithTheStep) {
  double before = 0.0;
  for (const double safety : {0.8, 0.4, 0.2}) {
    TwoBlocks t = two_blocks(0.3);
    t.model.dt *= safety / 0.8;
    test::Stepping stepping(t.model, start(t.model, std::vector<Vec2>(t.model.n_nodes()),
                                           velocities(t.model, {{0.5, 1.0}, {-0.5, -2.0}})));
    stepping.advance_to(0.1);
    const double relative = stepping.balance().relative;
    if (before > 0.0) {
      EXPECT_LT(relative, 0.35 * before) << safety;
    }
    before = relative;
  }
}

/// A stack: the lower block rests on the ground, the upper one on it, after damping.
TEST(GeneralContact, AStackComesToRest) {
  TwoBlocks t = two_blocks(0.5, 30.0);
  t.model.motion.gravity = Table(9.81);
  test::add_ground(t.model, t.mesh, {}, {0.5, 0.0});
  test::Stepping stepping(t.model, start(t.model, std::vector<Vec2>(t.model.n_nodes()),
                                         std::vector<Vec2>(t.model.n_nodes())));
  Extremes seen;
  stepping.advance_to(5.0, [&](const StepReport& r) { seen.see(r); });
  EXPECT_NEAR(stepping.report().contact.impulse.y / t.model.dt, 2 * 9810.0, 0.1);
  double fastest = 0.0;
  for (const Vec2 v : stepping.state().v.plane()) fastest = std::max(fastest, norm(v));
  EXPECT_LT(fastest, 1e-4);  // it falls by a third in a tenth of a second, and goes on
  EXPECT_LT(seen.residual, 1e-11);
  EXPECT_EQ(seen.not_converged, 0);
  EXPECT_LT(seen.penetration, 2e-3);
}

/// The ground's torque is about the body's center: none for a block that rests, wherever it is.
TEST(GeneralContact, ABlockAtRestFeelsNoTorque) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {5.0, 1e-4}, .columns = 4, .rows = 4});
  Model model = test::body_model(mesh, rubber, 30.0, 0.0, 0.8);
  model.motion.gravity = Table(9.81);
  test::add_ground(model, mesh, {}, {0.5, 0.0});
  test::Stepping stepping(
      model, start(model, std::vector<Vec2>(model.n_nodes()), std::vector<Vec2>(model.n_nodes())));
  stepping.advance_to(5.0);
  EXPECT_NEAR(stepping.report().contact.impulse.y / model.dt, 9810.0, 0.1);
  EXPECT_LT(std::abs(stepping.report().contact.angular_impulse / model.dt), 0.1);  // 5 m x 9810 N/m
}

/// A small block slides along the side of a large one that turns fast: it does not sink in.
TEST(GeneralContact, SlidingOnATurningSegmentDoesNotDrift) {
  std::array<double, 2> deepest{};
  for (std::size_t i = 0; i < 2; ++i) {
    mesh::Mesh mesh;
    test::add_block(mesh, {.corner = {-2.0, -1.0}, .width = 4.0, .columns = 1, .rows = 1});
    test::add_block(mesh, {.corner = {-0.9, 1e-5}, .width = 0.2, .height = 0.2});
    const fem::Material hard{1.0e9, 0.3, 1000.0, fem::Plane::strain};
    Model model = test::body_model(mesh, hard, 0.0, 0.0, i == 0 ? 0.8 : 0.4);
    test::add_surfaces(model, mesh, {0.0, 0.0});
    std::vector<Vec2> v(model.n_nodes());
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vec2 x = model.reference[k];
      v[k] = 20.0 * turn90(x - model.free_bodies[0].center);  // together, as one body
      if (model.free_body[k] == 1) v[k].x += 16.0;            // and along it
    }
    test::Stepping stepping(model, start(model, std::vector<Vec2>(model.n_nodes()), v));
    stepping.advance_to(0.03, [&](const StepReport& r) {
      deepest[i] = std::max(deepest[i], r.contact.penetration);
    });
  }
  // Without (4.8c) they are 5e-4 and 2e-4 m: the drift is w_t φ' Δt, 16 m/s times 20 rad/s.
  EXPECT_GT(deepest[0], 0.0);
  EXPECT_LT(deepest[0], 1e-4);
  EXPECT_LT(deepest[1], 0.7 * deepest[0]);
}

/// A U whose legs are driven together: the inner sides meet, momentum is kept.
TEST(GeneralContact, AGrooveCloses) {
  mesh::Mesh u;
  const int left = test::add_block(
      u, {.corner = {0.0, 0.0}, .width = 0.4, .height = 1.0, .columns = 4, .rows = 10});
  const int right = test::add_block(
      u, {.corner = {0.5, 0.0}, .width = 0.4, .height = 1.0, .columns = 4, .rows = 10});
  // The bottom that joins them: the two lowest rows, one column wide.
  for (int j = 0; j < 2; ++j)
    u.cells.push_back(
        {left + 5 * j + 4, right + 5 * j, right + 5 * (j + 1), left + 5 * (j + 1) + 4});
  std::erase_if(u.contact_edges, [&](const mesh::Edge& e) {
    const auto inner = [&](int node) {
      return (node <= left + 14 && (node - left) % 5 == 4) ||
             (node >= right && node <= right + 10 && (node - right) % 5 == 0);
    };
    return inner(e[0]) && inner(e[1]);
  });
  const Model base = test::body_model(u, rubber, 0.0, 0.0, 0.8);
  ASSERT_EQ(base.free_bodies.size(), 1U);
  for (const bool self : {true, false}) {
    Model model = base;
    test::add_surfaces(model, u, {0.4, 0.0}, self);
    std::vector<Vec2> v(model.n_nodes());
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vec2 x = model.reference[k];
      v[k] = {(x.x < 0.45 ? 6.0 : -5.0) * x.y, x.x < 0.45 ? 1.0 : 0.0};
    }
    test::Stepping stepping(model, start(model, std::vector<Vec2>(model.n_nodes()), v));
    stepping.advance(1);
    const test::Momentum before = test::momentum(model, stepping.state());
    Extremes seen;
    stepping.advance_to(0.1, [&](const StepReport& r) { seen.see(r); });
    const test::Momentum after = test::momentum(model, stepping.state());
    EXPECT_LT(norm(after.linear - before.linear), 1e-11 * 1000.0) << self;
    EXPECT_LT(std::abs(after.angular - before.angular), 1e-11 * 1000.0) << self;
    const double overlap =  // of the legs' tops
        position(model, stepping.state(), static_cast<std::size_t>(left + 54)).x -
        position(model, stepping.state(), static_cast<std::size_t>(right + 50)).x;
    if (self) {
      EXPECT_GE(seen.between, 4);
      EXPECT_LT(seen.residual, 1e-11);
      EXPECT_LT(overlap, 0.0);
    } else {
      EXPECT_EQ(seen.between, 0);
      EXPECT_GT(overlap, 0.0) << "they pass through each other";
    }
  }
}

/// Both sides of a thin ring are candidates: it does not touch itself across its wall.
TEST(GeneralContact, AThinWallDoesNotTouchItself) {
  mesh::Mesh mesh;
  test::add_block(mesh,
                  {.corner = {0.0, 0.0}, .width = 1.0, .height = 0.02, .columns = 10, .rows = 1});
  Model model = test::body_model(mesh, rubber, 0.0, 0.0, 0.8);
  test::add_surfaces(model, mesh, {0.5, 0.0}, true);
  std::vector<Vec2> v(model.n_nodes());
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k].y = model.reference[k].y > 0.01 ? 0.01 : -0.01;  // it breathes
  test::Stepping stepping(model, start(model, std::vector<Vec2>(model.n_nodes()), v));
  Extremes seen;
  stepping.advance(500, [&](const StepReport& r) { seen.see(r); });
  EXPECT_EQ(seen.between, 0);
}

/// Contact problems are kept where they took more iterations than asked, to be written to files.
TEST(GeneralContact, TellsWhatPressesACandidate) {
  TwoBlocks t = two_blocks(0.6);
  const std::vector<Vec2> none(t.model.n_nodes());
  const auto pressed = [&](const Model& model) {
    State state = start(model, none, velocities(model, {{0.0, -1.0}, {0.0, -4.0}}));
    const auto integrator = make_integrator(model, state);
    std::vector<StepReport> reports(12);
    integrator->advance(reports, &state);
    int by_ground = 0, by_body = 0;
    for (const ActiveContact& a : state.active) (a.on_ground ? by_ground : by_body) += 1;
    return std::pair(by_ground, by_body);
  };
  const auto [no_ground, bodies] = pressed(t.model);
  EXPECT_EQ(no_ground, 0);
  EXPECT_GT(bodies, 0);
  test::add_ground(t.model, t.mesh, {.profile = {{-10, -0.001}, {10, -0.001}}}, {0.4, 0.0});
  const auto [by_ground, by_body] = pressed(t.model);
  EXPECT_EQ(by_ground, 6) << "the lower edge";
  EXPECT_GT(by_body, 0);
}

/// What a run carries after some steps in contact, stopped and gone on with after every `cut`.
SavedState collided(const Model& model, std::size_t cut) {
  const std::vector<Vec2> v = velocities(model, {{0.5, -1.0}, {-0.5, -4.0}}), none(v.size());
  auto integrator = make_integrator(model, start(model, none, v));
  std::vector<StepReport> reports(cut);
  for (std::size_t done = 0; done < 12; done += cut) {
    integrator->advance(reports);
    const SavedState saved = integrator->resumable()->save();
    integrator = make_integrator(model, start(model, none, none));
    integrator->resumable()->restore(saved);
  }
  EXPECT_GT(reports.back().contact.nodes, 0);
  return integrator->resumable()->save();
}

TEST(GeneralContact, GoesOnFromASavedStateToTheSameBits) {
  TwoBlocks t = two_blocks(0.6, 3.0);
  t.model.stiffness_damping = 1e-6;
  test::add_ground(t.model, t.mesh, {.profile = {{-10, -0.001}, {10, -0.001}}}, {0.4, 0.0});
  const SavedState one = collided(t.model, 12);
  EXPECT_FALSE(one.impulses.empty());
  EXPECT_NE(one.poses[1].angle, 0.0);
  for (const std::size_t cut : {1U, 4U}) {
    const SavedState other = collided(t.model, cut);
    EXPECT_EQ(one.step, other.step);
    EXPECT_EQ(one.u, other.u);
    EXPECT_EQ(one.v, other.v);
    EXPECT_EQ(one.force, other.force);
    EXPECT_EQ(one.gradient, other.gradient);
    EXPECT_EQ(one.energy, other.energy);
    EXPECT_EQ(one.impulses, other.impulses);
    EXPECT_EQ(one.ledger, other.ledger);
    for (std::size_t b = 0; b < one.poses.size(); ++b)
      EXPECT_EQ(one.poses[b].angle, other.poses[b].angle);
  }
}

TEST(GeneralContact, KeepsDifficultProblems) {
  for (const int above : {0, 1}) {
    TwoBlocks t = two_blocks(0.6);
    t.model.coupled.dump_above = above;
    State state = start(t.model, std::vector<Vec2>(t.model.n_nodes()),
                        velocities(t.model, {{0.5, 1.0}, {-0.5, -2.0}}));
    const auto integrator = make_integrator(t.model, state);
    std::vector<StepReport> reports(60);
    integrator->advance(reports, nullptr);
    const auto kept = integrator->take_difficult();
    EXPECT_EQ(kept.empty(), above == 0);
    for (const contact::ProblemFile& file : kept) {
      EXPECT_GT(file.result.iterations, 1);
      EXPECT_LT(file.result.residual, 1e-12);
      EXPECT_EQ(file.impulse.size(), file.problem.size());
    }
    EXPECT_TRUE(integrator->take_difficult().empty());
  }
}

}  // namespace
}  // namespace rondo::dynamics::general_contact_test
