// SPDX-License-Identifier: BSD-3-Clause
// Bodies that nothing holds, in large rotation (docs/theory.md, section 9).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "rondo/core/complex.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/model/corotated.hpp"
#include "support/blocks.hpp"
#include "support/stepping.hpp"

namespace rondo::dynamics::free_body_test {
namespace {

const fem::Material rubber{1.0e6, 0.3, 1000.0, fem::Plane::strain};

mesh::Mesh one_block() {
  mesh::Mesh mesh;
  test::add_block(mesh,
                  {.corner = {0.3, -0.2}, .width = 1.0, .height = 0.5, .columns = 4, .rows = 3});
  return mesh;
}

std::vector<Vec2> noise(std::size_t n, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-size, size);
  std::vector<Vec2> field(n);
  for (Vec2& x : field) x = {draw(random), draw(random)};
  return field;
}

/// Rigid motion of all nodes, plus a deformation.
std::vector<Vec2> moved(const Model& model, double angle, Vec2 shift, std::vector<Vec2> extra) {
  const Complex turn = rotation(angle);
  for (std::size_t k = 0; k < extra.size(); ++k)
    extra[k] += turn * model.reference[k] + shift - model.reference[k];
  return extra;
}

struct Elastic {
  std::vector<Vec2> displacement, gradient;
  double energy = 0.0;
};

Elastic elastic_of(const Model& model, const std::vector<Vec2>& u) {
  std::vector<Pose> poses{{model.free_bodies[0].center}};
  Elastic e{std::vector<Vec2>(u.size()), std::vector<Vec2>(u.size())};
  std::vector<Vec2> product(u.size());
  update_poses(model, u, poses);
  elastic_displacements(model, u, poses, e.displacement);
  apply(model.stiffness, e.displacement, product, 1);
  to_gradient(model, e.displacement, product, poses, e.gradient);
  for (std::size_t k = 0; k < u.size(); ++k) e.energy += 0.5 * dot(e.displacement[k], product[k]);
  return e;
}

TEST(FreeBody, ARigidMotionStrainsNothing) {
  const Model model = test::body_model(one_block(), rubber, 0.0, 0.0, 0.8);
  for (const double angle : {0.0, 1e-9, 0.7, 2.5, std::numbers::pi, -3.0}) {
    const auto u = moved(model, angle, {3.0, -2.0}, std::vector<Vec2>(model.n_nodes()));
    const Elastic e = elastic_of(model, u);
    // Round-off of places of some metres; forces that times the stiffness, 1e6 Pa.
    for (const Vec2 d : e.displacement) EXPECT_LT(norm(d), 4e-15) << angle;
    for (const Vec2 f : e.gradient) EXPECT_LT(norm(f), 4e-8) << angle;
  }
}

TEST(FreeBody, ForcesAreTheDerivativeOfTheEnergy) {
  const Model model = test::body_model(one_block(), rubber, 0.0, 0.0, 0.8);
  auto u = moved(model, 1.1, {0.2, 0.4}, noise(model.n_nodes(), 0.03, 1));
  const Elastic e = elastic_of(model, u);
  double largest = 0.0;
  for (const Vec2 f : e.gradient) largest = std::max(largest, norm(f));
  const double h = 1e-6;  // central differences: h² and round-off of the energy over h, both 1e-9
  for (std::size_t k = 0; k < u.size(); ++k)
    for (double Vec2::*component : {&Vec2::x, &Vec2::y}) {
      const double at = u[k].*component;
      u[k].*component = at + h;
      const double above = elastic_of(model, u).energy;
      u[k].*component = at - h;
      const double below = elastic_of(model, u).energy;
      u[k].*component = at;
      EXPECT_NEAR((above - below) / (2.0 * h), e.gradient[k].*component, 1e-7 * largest);
    }
}

TEST(FreeBody, ForcesHaveNeitherResultantNorMoment) {
  const Model model = test::body_model(one_block(), rubber, 0.0, 0.0, 0.8);
  const auto u = moved(model, -2.2, {5.0, 1.0}, noise(model.n_nodes(), 0.05, 2));
  const Elastic e = elastic_of(model, u);
  Vec2 sum;
  double moment = 0.0, size = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    sum += e.gradient[k];
    moment += cross(model.reference[k] + u[k], e.gradient[k]);
    size += norm(e.gradient[k]);
  }
  EXPECT_LT(norm(sum), 1e-13 * size);
  EXPECT_LT(std::abs(moment), 1e-12 * size);  // about the origin, some metres away
}

TEST(FreeBody, WholeTurnsAreCounted) {
  const Model model = test::body_model(one_block(), rubber, 0.0, 0.0, 0.8);
  const std::vector<Vec2> none(model.n_nodes());
  Pose pose{model.free_bodies[0].center};
  for (int i = 1; i <= 20; ++i)
    pose = mean_pose(model, model.free_bodies[0], moved(model, 0.5 * i, {}, none), pose);
  EXPECT_NEAR(pose.angle, 10.0, 1e-13);
}

/// Spins at 20 rad/s and flies, started deformed.
struct Thrown {
  Model model;
  State state;
};
Thrown thrown(double safety, double alpha, double beta) {
  const mesh::Mesh mesh = one_block();
  Thrown t{test::body_model(mesh, rubber, alpha, beta, safety), {}};
  std::vector<Vec2> v(t.model.n_nodes()), u(t.model.n_nodes());
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vec2 arm = t.model.reference[k] - t.model.free_bodies[0].center;
    u[k] = {0.02 * arm.x, -0.01 * arm.y};
    v[k] = Vec2{3.0, 4.0} + 20.0 * turn90(arm + u[k]);
  }
  t.state = start(t.model, u, v);
  return t;
}

TEST(FreeBody, MomentumIsKeptToRoundOff) {
  for (const double beta : {0.0, 1e-5}) {
    Thrown t = thrown(0.8, 0.0, beta);
    test::Stepping stepping(t.model, t.state);
    stepping.advance(1);
    const test::Momentum before = test::momentum(t.model, stepping.state());
    stepping.advance(20000);  // some ten turns
    const test::Momentum after = test::momentum(t.model, stepping.state());
    EXPECT_GT(std::abs(stepping.state().poses[0].angle), 10.0);
    EXPECT_LT(norm(after.linear - before.linear), 1e-12 * norm(before.linear)) << beta;
    // About the origin, which the body leaves by some metres.
    EXPECT_LT(std::abs(after.angular - before.angular), 1e-11 * std::abs(before.angular)) << beta;
  }
}

/// Residual of the ledger over the energy exchanged, of a spin of a turn.
double ledger_after_a_turn(double safety) {
  Thrown t = thrown(safety, 0.0, 0.0);
  test::Stepping stepping(t.model, t.state);
  stepping.advance(std::llround(0.3 / t.model.dt));
  return stepping.report().balance.relative;
}

TEST(FreeBody, TheLedgerClosesToSecondOrder) {
  const double coarse = ledger_after_a_turn(0.8), half = ledger_after_a_turn(0.4),
               quarter = ledger_after_a_turn(0.2);
  EXPECT_LT(coarse, 5e-3);  // ten times the pulsation's share would be seen
  EXPECT_NEAR(std::log2(coarse / half), 2.0, 0.3);
  EXPECT_NEAR(std::log2(half / quarter), 2.0, 0.3);
}

TEST(FreeBody, WithoutRotationTheLedgerClosesToRoundOff) {
  const mesh::Mesh mesh = one_block();
  Model model = test::body_model(mesh, rubber, 5.0, 1e-5, 0.8);
  model.motion.gravity = Table(9.81);
  std::vector<Vec2> u(model.n_nodes()), v(model.n_nodes(), Vec2{1.0, 2.0});
  // Symmetric about the block's upright middle: its mean rotation stays zero.
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Vec2 arm = model.reference[k] - model.free_bodies[0].center;
    u[k] = {0.02 * arm.x, 0.03 * arm.x * arm.x};
  }
  test::Stepping stepping(model, start(model, u, v));
  stepping.advance(5000);
  EXPECT_LT(stepping.report().balance.relative, 1e-13);
}

TEST(FreeBody, FallsAsAParabola) {
  const mesh::Mesh mesh = one_block();
  Model model = test::body_model(mesh, rubber, 0.0, 0.0, 0.8);
  model.motion.gravity = Table(9.81);
  test::Stepping stepping(model, start(model, std::vector<Vec2>(model.n_nodes()),
                                       std::vector<Vec2>(model.n_nodes(), Vec2{2.0, 0.0})));
  stepping.advance(1000);
  const double t = 1000 * model.dt;
  for (const Vec2 u : stepping.state().u.plane()) {
    EXPECT_NEAR(u.x, 2.0 * t, 1e-12);
    EXPECT_NEAR(u.y, -0.5 * 9.81 * t * t, 1e-12);
  }
}

}  // namespace
}  // namespace rondo::dynamics::free_body_test
