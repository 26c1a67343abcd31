// SPDX-License-Identifier: BSD-3-Clause
/// The step of several bodies in few passes, held against the readable one; the same bits for any
/// number of threads, stopped and gone on with.
#include "rondo/integrators/bodies/bodies_integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "support/blocks.hpp"
#include "support/models.hpp"
#include "support/thrown_disk.hpp"

namespace rondo::dynamics::bodies_test {
namespace {

const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};

struct Bodies {
  Model model;
  std::vector<Vec2> u, v;
};

std::vector<Vec2> none(const Model& model) {
  return std::vector<Vec2>(model.n_nodes());
}

/// A block that flies, spins and swings, with gravity and both dampings.
Bodies thrown(double alpha, double beta) {
  mesh::Mesh mesh;
  test::add_block(mesh,
                  {.corner = {0.3, -0.2}, .width = 1.0, .height = 0.5, .columns = 13, .rows = 7});
  Bodies b{test::body_model(mesh, rubber, alpha, beta, 0.8), {}, {}};
  b.model.motion.gravity = Table({{0.0, 9.81}, {0.01, 0.0}, {0.1, 30.0}});
  b.u = b.v = none(b.model);
  for (std::size_t k = 0; k < b.v.size(); ++k) {
    const Vec2 arm = b.model.reference[k] - b.model.free_bodies[0].center;
    b.u[k] = {0.02 * arm.x, -0.01 * arm.y};
    b.v[k] = Vec2{3.0, 4.0} + 20.0 * turn90(arm + b.u[k]);
  }
  return b;
}

/// Two blocks fly at each other above the ground, and fall on it. @param finer by which
Bodies falling_blocks(int finer = 1) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {0.0, 0.0}, .columns = 5 * finer, .rows = 4 * finer});
  test::add_block(
      mesh, {.corner = {0.07, 1.001}, .columns = 9 * finer, .rows = 7 * finer, .turned = 0.004});
  Bodies b{test::body_model(mesh, rubber, 1.0, 1e-5, 0.8), {}, {}};
  b.model.motion.gravity = Table(9.81);
  test::add_surfaces(b.model, mesh, {0.5, 0.1});
  test::add_ground(b.model, mesh, {.profile = {{-9, -0.001}, {9, -0.001}}}, {0.4, 0.2});
  b.u = b.v = none(b.model);
  for (std::size_t k = 0; k < b.v.size(); ++k)
    b.v[k] = b.model.free_body[k] == 0 ? Vec2{0.5, -0.5} : Vec2{-0.5, -2.0};
  return b;
}

/// A ring with pressure inside and outside, on a roof with a sharp ridge.
Bodies blown_up() {
  const mesh::Mesh mesh = test::free_disk({.radial = 5, .circumferential = 70, .tread = {}});
  Bodies b{test::body_model(mesh, rubber, 0.0, 1e-5, 0.8), {}, {}};
  test::add_ground(b.model, mesh, {.profile = {{-9, -9.3}, {0, -0.3}, {9, -9.3}}}, {0.4, 0.0});
  b.model.pressures.push_back({mesh.contact_edges, Table({{0.0, 0.0}, {0.01, 2e4}})});
  b.model.pressures.push_back(
      {{mesh.contact_edges.begin(), mesh.contact_edges.begin() + 9}, Table(1e4)});
  b.u = none(b.model);
  b.v.assign(b.model.n_nodes(), Vec2{0.3, -2.0});
  return b;
}

/// A driven disk beside a block that nothing holds, which it touches; the ground is below both.
Bodies disk_and_block() {
  test::RollingCase c = test::everything("", 4, 60);
  c.disk.motion.height = Table(0.299);
  c.ground = contact::GroundShape{};
  test::Built disk = test::build(c);
  mesh::Mesh mesh = disk.mesh;
  // The nodes of the disk are where they are about its center; the block where it is.
  test::add_block(mesh,
                  {.corner = {0.2495, 0.01}, .width = 0.2, .height = 0.4, .columns = 5, .rows = 9});
  mesh.sector.clear();
  mesh.n_sectors = 0;
  Bodies b{test::body_model(mesh, rubber, 2.0, 1e-5, 0.5), {}, {}};
  b.model.motion = disk.model.motion;
  test::add_surfaces(b.model, mesh, {0.5, 0.0});
  test::add_ground(b.model, mesh, {}, {0.4, 0.2});
  b.u = b.v = none(b.model);
  for (const int node : b.model.free_bodies[0].nodes)
    b.v[static_cast<std::size_t>(node)] = {-3.0, -1.0};
  return b;
}

/// What the runs have to show, so that the case is what it should be.
struct Seen {
  int nodes = 0, between = 0, clusters = 0;
};

Seen expect_the_same(const Bodies& b, int steps, double bound) {
  EXPECT_EQ(step_of(b.model), StepKind::bodies);
  const State at = start(b.model, b.u, b.v);
  GeneralIntegrator expected(b.model, at);
  const auto run = make_integrator(b.model, at);
  test::Comparison difference(test::Comparison::Contacts::by_node);
  std::vector<StepReport> of_a(10), of_b(10);
  State a = at, c = at;
  Seen seen;
  for (int n = 0; n < steps; n += 10) {
    expected.advance(of_a, &a);
    run->advance(of_b, &c);
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      difference.see(of_a[i], of_b[i]);
      seen.nodes = std::max(seen.nodes, of_b[i].contact.nodes);
      seen.between = std::max(seen.between, of_b[i].contact.between_bodies);
      seen.clusters = std::max(seen.clusters, of_b[i].contact.clusters);
    }
    difference.see(a, c);
    for (std::size_t p = 0; p < a.poses.size(); ++p) {
      EXPECT_LT(norm(a.poses[p].center - c.poses[p].center), bound);
      EXPECT_LT(std::abs(a.poses[p].angle - c.poses[p].angle), bound);
    }
    if (testing::Test::HasFailure()) break;
  }
  difference.expect_within(bound);
  State fields_a(b.model), fields_b(b.model);
  expected.fields(fields_a);
  run->fields(fields_b);
  for (std::size_t k = 0; k < b.u.size(); ++k)
    EXPECT_LT(norm(fields_a.u.plane()[k] - fields_b.u.plane()[k]), bound) << k;
  return seen;
}

/// All that comes out of a run, and goes into its checkpoint.
struct Numbers {
  std::vector<Vec2> fields;
  std::vector<double> numbers;

  bool operator==(const Numbers&) const = default;
};

void add(const State& s, Numbers& to) {
  for (const Field* field : {&s.u, &s.v, &s.v_next})
    for (const Vec2 x : field->plane()) to.fields.push_back(x);
  for (const ActiveContact& a : s.active)
    for (const Vec3 x : {Vec3(a.normal), a.before, a.free, a.after, a.impulse})
      to.fields.push_back(x.plane());
  for (const Pose& pose : s.poses) {
    to.fields.push_back(pose.center);
    to.numbers.insert(to.numbers.end(), {pose.rotation.re, pose.rotation.im, pose.angle});
  }
}

void add(const StepReport& r, Numbers& to) {
  const ContactReport& c = r.contact;
  const Balance& b = r.balance;
  to.fields.insert(to.fields.end(), {r.frame.center.plane(), c.impulse.plane()});
  to.numbers.insert(
      to.numbers.end(),
      {r.frame.time, c.work, c.dissipation_friction, c.angular_impulse, c.residual,
       static_cast<double>(c.nodes), b.kinetic, b.strain, b.residual, b.relative, b.works.frame,
       b.works.contact, b.works.dissipation_mass, b.works.dissipation_stiffness, b.works.load});
}

/// @param calls how many steps each of them makes
/// @param restarts another integrator goes on after each call
Numbers numbers_of(const Bodies& b, int threads, int calls, bool restarts) {
  Model model = b.model;
  model.threads = threads;
  State at = start(model, b.u, b.v);
  auto run = make_integrator(model, at);
  std::vector<StepReport> reports(240);
  Numbers out;
  for (std::size_t done = 0; done < reports.size(); done += static_cast<std::size_t>(calls)) {
    const bool last = done + static_cast<std::size_t>(calls) >= reports.size();
    run->advance(std::span(reports).subspan(done, static_cast<std::size_t>(calls)),
                 last ? &at : nullptr);
    if (!restarts) continue;
    const SavedState saved = run->resumable()->save();
    run = make_integrator(model, start(model, none(model), none(model)));
    run->resumable()->restore(saved);
  }
  add(at, out);
  int contacts = 0;
  for (const StepReport& report : reports) {
    add(report, out);
    contacts += report.contact.nodes;
  }
  EXPECT_GT(contacts, 0);
  State fields(model);
  run->fields(fields);
  add(fields, out);
  return out;
}

}  // namespace

TEST(Bodies, TheSameBitsForAnyNumberOfThreads) {
  const Bodies b = falling_blocks(6);
  const Numbers one = numbers_of(b, 1, 60, false);
  EXPECT_EQ(one, numbers_of(b, 2, 60, false));
  EXPECT_EQ(one, numbers_of(b, 3, 60, false));
}

TEST(Bodies, TheSameBitsHoweverCutAndAfterARestart) {
  for (const Bodies& b : {falling_blocks(3), blown_up(), disk_and_block()}) {
    const Numbers whole = numbers_of(b, 1, 240, false);
    EXPECT_EQ(whole, numbers_of(b, 1, 1, false));
    EXPECT_EQ(whole, numbers_of(b, 1, 12, true));
  }
}

TEST(Bodies, AThrownBlockAsTheReadableStepHasIt) {
  for (const double beta : {0.0, 2e-5}) expect_the_same(thrown(3.0, beta), 500, 1e-12);
}

TEST(Bodies, BlocksThatCollideAsTheReadableStepHasThem) {
  const Seen seen = expect_the_same(falling_blocks(), 400, 1e-12);
  EXPECT_GT(seen.between, 10);
  EXPECT_GT(seen.nodes, seen.between);
  EXPECT_GT(seen.clusters, 0);
}

TEST(Bodies, FrictionThatIsNoConstantAsTheReadableStepHasIt) {
  Bodies b = falling_blocks();
  const auto law = [](const contact::SlidingState& s) {
    return 0.3 + 0.05 * std::sin(9.0 * s.place.x) + 0.02 * s.slip + 1e-8 * s.pressure;
  };
  b.model.contact->law.friction = b.model.surfaces->law.friction = contact::Friction(law);
  const Seen seen = expect_the_same(b, 400, 1e-12);
  EXPECT_GT(seen.between, 10);
  EXPECT_GT(seen.clusters, 0);
}

TEST(Bodies, PressuresAndCornersAsTheReadableStepHasThem) {
  const Seen seen = expect_the_same(blown_up(), 100, 1e-12);
  EXPECT_GT(seen.nodes, 0);
}

TEST(Bodies, AHeldBodyBesideAFreeOneAsTheReadableStepHasThem) {
  const Seen seen = expect_the_same(disk_and_block(), 200, 1e-12);
  EXPECT_GT(seen.between, 0);
  EXPECT_GT(seen.nodes, seen.between);
}

}  // namespace rondo::dynamics::bodies_test
