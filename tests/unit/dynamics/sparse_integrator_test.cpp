// SPDX-License-Identifier: BSD-3-Clause
/// The sparse operator where the cyclic one cannot go: triangles among quadrilaterals, nodes
/// numbered by chance.
#include "rondo/dynamics/sparse_integrator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "rondo/dynamics/dispatch.hpp"
#include "rondo/dynamics/numbering.hpp"
#include "rondo/dynamics/stepper.hpp"
#include "support/models.hpp"
#include "support/traps.hpp"

using namespace rondo;
using namespace rondo::dynamics;

namespace {

/// Every third quadrilateral cut in two, and the nodes numbered anew.
mesh::Mesh mixed(mesh::Mesh m) {
  std::vector<int> number(m.n_nodes());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(1));
  const auto renumber = [&](int node) { return number[static_cast<std::size_t>(node)]; };
  const mesh::Mesh old = m;
  m.cells.clear();
  for (std::size_t i = 0; i < old.cells.size(); ++i) {
    mesh::Cell c = old.cells[i];
    for (int& node : c) node = renumber(node);
    if (i % 3 == 0) {
      m.cells.push_back({c[0], c[1], c[2], -1});
      m.cells.push_back({c[0], c[2], c[3], -1});
    } else {
      m.cells.push_back(c);
    }
  }
  for (std::size_t i = 0; i < number.size(); ++i)
    m.coordinates[static_cast<std::size_t>(number[i])] = old.coordinates[i];
  for (int& node : m.clamped) node = renumber(node);
  std::sort(m.clamped.begin(), m.clamped.end());
  for (int& node : m.boundary) node = renumber(node);
  m.n_sectors = 0;
  m.sector.clear();
  m.sector_node.clear();
  return m;
}

Model mixed_model(const test::DiskCase& c, bool contact) {
  test::Built b;
  b.mesh = mixed(mesh::make_disk(c.disk));
  b.model.reference = b.mesh.coordinates;
  b.model.mass = fem::lumped_mass(b.mesh, {&c.material, 1});
  b.model.free = fem::free_nodes(b.mesh);
  b.model.stiffness = fem::assemble_stiffness(b.mesh, {&c.material, 1});
  b.model.mass_damping = c.alpha;
  b.model.stiffness_damping = c.beta;
  b.model.motion = c.motion;
  b.model.scheme = c.scheme;
  b.model.dt = c.safety * critical_step(b.model.stiffness, b.model.mass, b.model.free,
                                        {c.beta, test::lagged_mass(c)},
                                        fem::element_eigenvalue_bound(b.mesh, {&c.material, 1}))
                              .step;
  if (contact) test::add_ground(b, {}, {0.3, 0.0});
  return b.model;
}

/// Rolling on flat ground, with gravity.
test::DiskCase rolling(int radial, int circumferential) {
  test::DiskCase c = test::rolling_disk(radial, circumferential);
  c.motion.height = Table(0.298);
  c.motion.gravity = Table(9.81);
  return c;
}

State some_start(const Model& model) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> x(-1.0, 1.0);
  std::vector<Vec2> u(model.n_nodes()), v(model.n_nodes());
  for (Vec2& a : u) a = {2e-5 * x(random), 2e-5 * x(random)};
  for (Vec2& a : v) a = {0.2 * x(random), 0.2 * x(random)};
  return start(model, u, v);
}

double size(const std::vector<Vec2>& a) {
  double largest = 0.0;
  for (const Vec2 x : a) largest = std::max(largest, norm(x));
  return largest;
}
double difference(std::vector<Vec2> a, const std::vector<Vec2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return size(a);
}

/// The sum of a row in another order is all that differs: 1e-16 of it in a step.
void expect_near(const State& a, const State& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_LE(difference(a.u, b.u), 1e-12 * size(a.u));
  EXPECT_LE(difference(a.v, b.v), 1e-12 * size(a.v));
  EXPECT_LE(difference(a.v_next, b.v_next), 1e-12 * size(a.v));
  ASSERT_EQ(a.active.size(), b.active.size());
  for (std::size_t i = 0; i < a.active.size(); ++i) {
    EXPECT_EQ(a.active[i].candidate, b.active[i].candidate);
    EXPECT_EQ(a.active[i].status, b.active[i].status);
    EXPECT_NEAR(a.active[i].gap, b.active[i].gap, 1e-12 * size(a.u));
    EXPECT_LE(norm(a.active[i].impulse - b.active[i].impulse),
              1e-10 * norm(a.active[i].impulse) + 1e-15);
  }
}

void expect_near(const Balance& a, const Balance& b) {
  const double bound = 1e-12 * a.exchanged;
  EXPECT_NEAR(a.kinetic, b.kinetic, bound);
  EXPECT_NEAR(a.strain, b.strain, bound);
  EXPECT_NEAR(a.works.frame, b.works.frame, bound);
  EXPECT_NEAR(a.works.contact, b.works.contact, bound);
  EXPECT_NEAR(a.works.dissipation_friction, b.works.dissipation_friction, bound);
  EXPECT_NEAR(a.works.dissipation_mass, b.works.dissipation_mass, bound);
  EXPECT_NEAR(a.works.dissipation_stiffness, b.works.dissipation_stiffness, bound);
  EXPECT_NEAR(a.works.scheme, b.works.scheme, bound);
  EXPECT_LT(b.relative, 1e-13);
}

class Sparse : public testing::TestWithParam<bool> {};

}  // namespace

TEST_P(Sparse, TheStepOfTheReferenceOnTrianglesNumberedByChance) {
  const bool contact = GetParam();
  const Model model = mixed_model(rolling(5, 75), contact);
  EXPECT_NE(row_order(model.stiffness, model.free), model.free);  // an order of its own
  EXPECT_NE(model.free.size() % 8, 0);                            // and a pack that is not full
  const test::FloatingPointTraps traps;
  State reference = some_start(model);
  Ledger ledger;
  SparseIntegrator integrator(model, reference, kernel_table());
  State last(model);
  std::vector<StepReport> reports(100);
  int in_contact = 0;
  for (int call = 0; call < 3; ++call) {
    integrator.advance(reports, &last);
    for (const StepReport& report : reports) {
      const ContactReport expected = advance(model, reference, ledger);
      EXPECT_EQ(report.contact.nodes, expected.nodes);
      EXPECT_EQ(report.contact.sticking, expected.sticking);
      in_contact += expected.nodes;
    }
    expect_near(reference, last);
    expect_near(ledger.last(), reports.back().balance);
  }
  EXPECT_EQ(in_contact > 0, contact);
}

TEST_P(Sparse, SameBitsForAnyNumberOfThreads) {
  Model model = mixed_model(rolling(8, 240), GetParam());
  const State start = some_start(model);
  State one(model), many(model);
  std::vector<StepReport> reports(50), others(50);
  SparseIntegrator(model, start, kernel_table()).advance(reports, &one);
  for (const int threads : {2, 3, 7}) {
    model.threads = threads;
    SparseIntegrator(model, start, kernel_table()).advance(others, &many);
    EXPECT_EQ(one.u, many.u);
    EXPECT_EQ(one.v, many.v);
    EXPECT_EQ(one.v_next, many.v_next);
    EXPECT_EQ(one.active.size(), many.active.size());
    EXPECT_EQ(reports.back().balance.kinetic, others.back().balance.kinetic);
    EXPECT_EQ(reports.back().balance.strain, others.back().balance.strain);
    EXPECT_EQ(reports.back().balance.residual, others.back().balance.residual);
    EXPECT_EQ(reports.back().contact.work, others.back().contact.work);
  }
}

INSTANTIATE_TEST_SUITE_P(, Sparse, testing::Bool(),
                         [](const auto& p) { return p.param ? "rolling" : "free"; });

/// What fills up the last pack is held by nothing: with this spin the scheme as printed would fling
/// it out by a factor of 1.03 in a step, which the stiffness damping keeps the body itself from.
TEST(SparsePadding, StaysWhereItIs) {
  test::DiskCase c = test::rolling_disk(1, 9);
  c.scheme = Scheme::as_printed;
  c.alpha = 0.0;
  c.beta = 1e-3;
  c.motion = {};
  c.motion.angular_velocity = Table(400.0);
  c.motion.gravity = Table(9.81);
  const Model model = mixed_model(c, false);
  EXPECT_NE(model.free.size() % 8, 0);
  SparseIntegrator integrator(model, test::start_at_rest(model), kernel_table());
  std::vector<StepReport> reports(1000);
  for (int call = 0; call < 50; ++call) integrator.advance(reports, nullptr);
  EXPECT_TRUE(std::isfinite(reports.back().balance.kinetic));
  EXPECT_TRUE(std::isfinite(reports.back().balance.strain));
}
