// SPDX-License-Identifier: BSD-3-Clause
// Pressure on boundary curves (docs/theory.md, 9.8).
#include "rondo/model/pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rondo/core/complex.hpp"
#include "rondo/mesh/disk.hpp"
#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::dynamics::pressure_test {
namespace {

const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};

struct Sum {
  Vec2 force;
  double moment = 0.0, size = 0.0;
};
Sum sum_of(const Model& model, const std::vector<Vec2>& u, const std::vector<Vec2>& force) {
  Sum s;
  for (std::size_t k = 0; k < u.size(); ++k) {
    s.force += force[k];
    s.moment += cross(model.reference[k] + u[k], force[k]);
    s.size += norm(force[k]);
  }
  return s;
}

TEST(Pressure, OnAClosedCurveOfAFreeBodyHasNeitherForceNorMoment) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {2.0, 1.0}, .columns = 3, .rows = 4});
  Model model = test::body_model(mesh, rubber, 0.0, 0.0, 0.8);
  model.pressures.push_back({mesh.contact_edges, Table(2.0e4)});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-0.05, 0.05);
  std::vector<Vec2> u(model.n_nodes()), force(model.n_nodes());
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] =
        rotation(1.0) * model.reference[k] - model.reference[k] + Vec2{draw(random), draw(random)};
  pressure_forces(model, u, 0.0, force);
  const Sum s = sum_of(model, u, force);
  EXPECT_GT(s.size, 2.0e4);
  EXPECT_LT(norm(s.force), 1e-14 * s.size);
  EXPECT_LT(std::abs(s.moment), 1e-14 * s.size * 3.0);  // about the origin, some metres away
}

TEST(Pressure, PushesAgainstTheOutwardNormal) {
  mesh::Mesh mesh;
  test::add_block(mesh, {});
  Model model = test::body_model(mesh, rubber, 0.0, 0.0, 0.8);
  model.pressures.push_back({{mesh.contact_edges[0]}, Table({{0.0, 0.0}, {1.0, 100.0}})});
  std::vector<Vec2> force(model.n_nodes());
  pressure_forces(model, std::vector<Vec2>(model.n_nodes()), 0.5, force);
  // 50 Pa on the lower edge, 1 m: upwards, 25 N/m at each end.
  EXPECT_EQ(force[0], (Vec2{0.0, 25.0}));
  EXPECT_EQ(force[1], (Vec2{0.0, 25.0}));
  EXPECT_EQ(force[2], Vec2{});
}

/// Under a pressure p all round, plane strain: ε = -p (1 + ν)(1 - 2ν)/E, and the ledger has its
/// work.
TEST(Pressure, SqueezesABlockAsTheClosedFormSays) {
  mesh::Mesh mesh;
  test::add_block(mesh, {.corner = {}, .columns = 4, .rows = 4});
  Model model = test::body_model(mesh, rubber, 0.0, 1e-3, 0.8);
  const double p = 1.0e3;
  model.pressures.push_back({mesh.contact_edges, Table({{0.0, 0.0}, {1.0, p}})});
  test::Stepping stepping(
      model, start(model, std::vector<Vec2>(model.n_nodes()), std::vector<Vec2>(model.n_nodes())));
  stepping.advance_to(3.0);
  const double strain = -p * 1.3 * 0.4 / 1.0e6;
  const auto& u = stepping.state().u;
  // The edges lie as the body is squeezed: the load is smaller by the strain, 5e-4.
  EXPECT_NEAR(u.plane()[4].x - u.plane()[0].x, strain, 2e-3 * std::abs(strain));
  EXPECT_NEAR(u.plane()[20].y - u.plane()[0].y, strain, 2e-3 * std::abs(strain));
  const Balance& b = stepping.balance();
  EXPECT_NEAR(b.works.load, p * std::abs(strain), 5e-3 * p * std::abs(strain));  // ½ p (2 |ε|)
  EXPECT_LT(b.relative, 1e-12) << "it does not turn";
}

/// A held ring under inner pressure: linear, in the turning frame, the ledger to round-off.
TEST(Pressure, OnAHeldBodyTheLedgerClosesToRoundOff) {
  test::Built b = test::build(test::rolling_disk(2, 24));
  mesh::Mesh& mesh = b.mesh;
  b.model.body = mesh::find_bodies(mesh).of_node;
  b.model.pressures.push_back({mesh.contact_edges, Table({{0.0, 0.0}, {0.01, 1.0e5}})});
  test::Stepping stepping(b.model, test::start_at_rest(b.model));
  stepping.advance(2000);
  EXPECT_GT(std::abs(stepping.balance().works.load), 1.0);
  EXPECT_LT(stepping.balance().relative, 1e-13);
}

}  // namespace
}  // namespace rondo::dynamics::pressure_test
