// SPDX-License-Identifier: BSD-3-Clause
/// The sparse operator where the cyclic one cannot go: triangles among quadrilaterals, nodes
/// numbered by chance.
#include "rondo/integrators/fused/sparse_integrator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "comparison.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/numbering.hpp"
#include "rondo/integrators/start.hpp"
#include "support/models.hpp"
#include "support/traps.hpp"

namespace sparse_integrator_test {

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
  test::Built b = test::build(c, mixed(mesh::make_disk(c.disk)));
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

class Sparse : public testing::TestWithParam<bool> {};

}  // namespace

TEST_P(Sparse, TheStepOfTheReferenceOnTrianglesNumberedByChance) {
  const bool contact = GetParam();
  const Model model = mixed_model(rolling(5, 75), contact);
  EXPECT_NE(row_order(model.stiffness, model.free), model.free);  // an order of its own
  EXPECT_NE(model.free.size() % 8, 0);                            // and a pack that is not full
  const test::FloatingPointTraps traps;
  test::Reference reference(model, some_start(model));
  SparseIntegrator integrator(model, reference.state, kernel_table());
  State last(model);
  std::vector<StepReport> reports(100);
  int in_contact = 0;
  test::Comparison comparison;
  for (int call = 0; call < 3; ++call) {
    integrator.advance(reports, &last);
    for (const StepReport& report : reports) {
      const StepReport& expected = reference.step();
      comparison.see(expected, report);
      in_contact += expected.contact.nodes;
    }
    comparison.see(reference.state, last);
    if (HasFatalFailure()) return;
    EXPECT_LT(reports.back().balance.relative, 1e-13);
  }
  // The sum of a row in another order is all that differs: 1e-16 of it in a step.
  comparison.expect_within(1e-12);
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

/// What fills up the last pack is held by nothing: a mass damping that drives would fling it out,
/// which the stiffness damping keeps the body itself from.
TEST(SparsePadding, StaysWhereItIs) {
  test::DiskCase c = test::rolling_disk(1, 9);
  c.alpha = -40.0;
  c.beta = 1e-3;
  c.motion = {};
  c.motion.angular_velocity = Table(400.0);
  c.motion.gravity = Table(9.81);
  const Model model = mixed_model(c, false);
  EXPECT_NE(model.free.size() % 8, 0);
  SparseIntegrator integrator(model, test::start_at_rest(model), kernel_table());
  std::vector<StepReport> reports(1000);
  for (int call = 0; call < 1000; ++call) integrator.advance(reports, nullptr);
  EXPECT_TRUE(std::isfinite(reports.back().balance.kinetic));
  EXPECT_TRUE(std::isfinite(reports.back().balance.strain));
}

}  // namespace sparse_integrator_test
